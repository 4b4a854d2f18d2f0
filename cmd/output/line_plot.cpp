#include "output/line_plot.hpp"

#include <algorithm>
#include <cmath>

#include "output/svg.hpp"
#include "text/format_number.hpp"

namespace viewproj::cmd {
namespace {

using namespace svg;

constexpr Box kArea{82, 62, 516, 402};
constexpr const char* kColours[] = {"#b8501c", "#2c8a45", "#1b5faa", "#7d2a8c"};
constexpr int kMostDecades = 9;  // labelled on an axis

/// A value to a place between low and high of the picture.
class Axis {
 public:
  Axis(bool logarithmic, double least, double most, double low, double high)
      : logarithmic_(logarithmic), least_(place(least)), most_(place(most)), low_(low), high_(high) {
    if (!(most_ > least_)) most_ = least_ + 1;
  }

  double operator()(double value) const { return low_ + (place(value) - least_) / (most_ - least_) * (high_ - low_); }

  /// Values with a label each: decades, or round numbers.
  std::vector<std::pair<double, std::string>> ticks() const {
    std::vector<std::pair<double, std::string>> result;
    if (logarithmic_) {
      const int first = static_cast<int>(std::ceil(least_ - 1e-9)), last = static_cast<int>(std::floor(most_ + 1e-9));
      int step = 1;
      for (int wider : {2, 3, 5, 10, 20, 50, 100})
        if ((last - first) / step > kMostDecades) step = wider;
      for (int exponent = first; exponent <= last; ++exponent)
        if (exponent % step == 0) result.emplace_back(std::pow(10, exponent), decade(exponent));
      return result;
    }
    const double span = most_ - least_;
    double step = std::pow(10, std::floor(std::log10(span)));
    for (double finer : {0.5, 0.2})
      if (span / step < 4) step *= finer == 0.5 ? 0.5 : 0.4;
    for (double value = std::ceil(least_ / step) * step; value <= most_ + step * 1e-9; value += step)
      result.emplace_back(value, formatDigits(std::fabs(value) < step * 1e-9 ? 0 : value, 4));
    return result;
  }

 private:
  double place(double value) const { return logarithmic_ ? std::log10(value) : value; }

  bool logarithmic_;
  double least_, most_, low_, high_;
};

struct Extent {
  double least = INFINITY, most = -INFINITY;
  void add(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
};

std::string path(const PlotCurve& curve, const Axis& x, const Axis& y) {
  std::string d;
  for (const auto& [atX, atY] : curve.points) d += (d.empty() ? "M" : "L") + at(x(atX)) + " " + at(y(atY));
  return "<path d=\"" + d + "\" fill=\"none\" stroke=\"" + kColours[curve.colour] + "\" stroke-width=\"" +
         (curve.dashed ? "1.5\" stroke-dasharray=\"5 4"
          : curve.wide ? "5\" opacity=\"0.6"
                       : "2") +
         "\" stroke-linejoin=\"round\"/>\n";
}

/// Beside the ends of their curves, moved apart where they would overlap.
std::string endLabels(const LinePlot& plot, const Axis& y) {
  std::vector<std::pair<double, const PlotCurve*>> labels;
  for (const PlotCurve& curve : plot.curves)
    if (!curve.label.empty() && !curve.points.empty()) labels.emplace_back(y(curve.points.back().second), &curve);
  std::sort(labels.begin(), labels.end());
  const double apart = kText + 3;
  for (std::size_t i = 1; i < labels.size(); ++i)
    labels[i].first = std::max(labels[i].first, labels[i - 1].first + apart);
  double lowest = kArea.bottom;
  for (std::size_t i = labels.size(); i-- > 0; lowest = labels[i].first - apart)
    labels[i].first = std::min(labels[i].first, lowest);
  std::string out;
  for (const auto& [place, curve] : labels)
    out += text(kArea.right + 8, place + kText / 3, curve->label,
                std::string("style=\"fill:") + kColours[curve->colour] + "\"");
  return out;
}

}  // namespace

std::string linePlotSvg(const LinePlot& plot) {
  Extent xs, ys;
  for (const PlotCurve& curve : plot.curves)
    for (const auto& [atX, atY] : curve.points) {
      xs.add(atX);
      ys.add(atY);
    }
  for (const PlotLevel& level : plot.levels) ys.add(level.y);
  const Axis x(plot.logarithmicX, xs.least, xs.most, kArea.left, kArea.right);
  const Axis y(true, std::pow(10, std::floor(std::log10(ys.least))), std::pow(10, std::ceil(std::log10(ys.most))),
               kArea.bottom, kArea.top);
  std::string out = beginPicture(plot.title, plot.caption);
  for (const auto& [value, label] : x.ticks())
    out += line(x(value), kArea.top, x(value), kArea.bottom, "class=\"decade\"") +
           text(x(value), kArea.bottom + 20, label, "text-anchor=\"middle\"");
  for (const auto& [value, label] : y.ticks())
    out += line(kArea.left, y(value), kArea.right, y(value), "class=\"decade\"") +
           text(kArea.left - 8, y(value) + kText / 3, label, "text-anchor=\"end\"");
  const double middle = (kArea.left + kArea.right) / 2;
  out += text(middle, kArea.bottom + 44, plot.xTitle, "text-anchor=\"middle\"") +
         text(0, 0, plot.yTitle,
              "text-anchor=\"middle\" transform=\"translate(18 " + at((kArea.top + kArea.bottom) / 2) +
                  ") rotate(-90)\"") +
         frame(kArea);
  for (const PlotLevel& level : plot.levels)
    out += line(kArea.left, y(level.y), kArea.right, y(level.y), "stroke=\"#444\" stroke-dasharray=\"2 3\"") +
           text(kArea.left + 6, y(level.y) - 4, level.label, "class=\"small label\"");
  for (const PlotCurve& curve : plot.curves) out += path(curve, x, y);
  return out + endLabels(plot, y) + "</svg>\n";
}

}  // namespace viewproj::cmd
