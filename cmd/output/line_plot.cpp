#include "output/line_plot.hpp"

#include <algorithm>
#include <cmath>

#include "output/axis.hpp"

namespace viewproj::cmd {
namespace {

using namespace svg;

constexpr Box kArea{82, 62, 516, 402};
constexpr const char* kColours[] = {"#b8501c", "#2c8a45", "#1b5faa", "#7d2a8c"};
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
  for (const PlotLevel& at : plot.levels) ys.add(at.y);
  const Axis x(plot.logarithmicX, xs.least, xs.most, kArea.left, kArea.right);
  const Axis y(true, std::pow(10, std::floor(std::log10(ys.least))), std::pow(10, std::ceil(std::log10(ys.most))),
               kArea.bottom, kArea.top);
  std::string out = beginPicture(plot.title, plot.caption);
  for (const Tick& tick : x.ticks()) out += upright(kArea, x(tick.value), tick);
  for (const Tick& tick : y.ticks()) out += level(kArea, y(tick.value), tick);
  out += frameWithTitles(kArea, plot.xTitle, plot.yTitle);
  for (const PlotLevel& at : plot.levels)
    out += line(kArea.left, y(at.y), kArea.right, y(at.y), "stroke=\"#444\" stroke-dasharray=\"2 3\"") +
           text(kArea.left + 6, y(at.y) - 4, at.label, "class=\"small label\"");
  for (const PlotCurve& curve : plot.curves) out += path(curve, x, y);
  return out + endLabels(plot, y) + "</svg>\n";
}

}  // namespace viewproj::cmd
