#include "output/plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "output/svg.hpp"
#include "text/format_number.hpp"

namespace viewproj::cmd {
namespace {

using namespace svg;

constexpr double kLeft = 76, kRight = 622, kTop = 84, kBottom = 402;
constexpr double kDot = 5, kTick = 8;
constexpr const char* kColours[] = {"#1b5faa", "#b8501c"};

bool isDrawn(const PlotDot& dot) { return dot.pixels.has_value(); }
bool isPositive(double value) { return value > 0 && std::isfinite(value); }

/// Nanoseconds to x.
class CostAxis {
 public:
  explicit CostAxis(const std::vector<PlotDot>& dots) {
    double least = INFINITY, most = 0;
    for (const PlotDot& dot : dots) {
      if (!isDrawn(dot)) continue;
      least = std::min(least, dot.nanoseconds);
      most = std::max(most, dot.nanoseconds);
    }
    if (!(most > 0)) least = most = 1;
    // A decade at the least, and room for labels on both sides.
    const double middle = (std::log10(least) + std::log10(most)) / 2;
    const double half = std::max((std::log10(most) - std::log10(least)) * 0.62, 0.5);
    low_ = middle - half;
    high_ = middle + half;
  }

  double operator()(double nanoseconds) const {
    return kLeft + (std::log10(nanoseconds) - low_) / (high_ - low_) * (kRight - kLeft);
  }

  std::string grid() const {
    std::string out;
    const bool fine = high_ - low_ < 3.2;
    for (int exponent = static_cast<int>(std::floor(low_)); exponent <= high_; ++exponent)
      for (double step : {1.0, 2.0, 5.0}) {
        const double value = step * std::pow(10, exponent);
        if (std::log10(value) < low_ || std::log10(value) > high_ || (step != 1 && !fine)) continue;
        const double x = (*this)(value);
        out += line(x, kTop, x, kBottom, step == 1 ? "class=\"decade\"" : "class=\"grid\"");
        const std::string label = step == 1 ? decade(exponent) : formatNumber(std::round(value * 1e6) / 1e6);
        out += text(x, kBottom + 20, label, "text-anchor=\"middle\"");
      }
    return out + text((kLeft + kRight) / 2, kBottom + 44, "time, ns per point or ray", "text-anchor=\"middle\"");
  }

 private:
  double low_, high_;
};

/// Pixels to y: decades, with a line for 0 below them and one for what is not finite above.
class ErrorAxis {
 public:
  explicit ErrorAxis(const std::vector<PlotDot>& dots) {
    double least = INFINITY, most = 0;
    for (const PlotDot& dot : dots) {
      if (!isDrawn(dot)) continue;
      hasZero_ |= *dot.pixels == 0;
      hasNone_ |= !std::isfinite(*dot.pixels);
      for (double value : {*dot.pixels, dot.bound.value_or(0)})
        if (isPositive(value)) {
          least = std::min(least, value);
          most = std::max(most, value);
        }
    }
    if (!(most > 0)) least = most = 1;
    low_ = static_cast<int>(std::floor(std::log10(least)));
    high_ = std::max(static_cast<int>(std::ceil(std::log10(most))), low_ + 1);
    bottom_ = kBottom - (hasZero_ ? kLine : 8);
    top_ = kTop + (hasNone_ ? kLine : 8);
  }

  double operator()(double pixels) const {
    if (!std::isfinite(pixels)) return kTop + 14;
    if (pixels == 0) return kBottom - 14;
    return bottom_ - (std::log10(pixels) - low_) / (high_ - low_) * (bottom_ - top_);
  }

  std::string grid() const {
    std::string out;
    int step = 1;
    for (int wider : {2, 3, 5, 10, 20, 50, 100})
      if ((high_ - low_) / step > 8) step = wider;
    const auto label = [&](double y, const std::string& words) {
      out +=
          line(kLeft, y, kRight, y, "class=\"decade\"") + text(kLeft - 8, y + kText / 3, words, "text-anchor=\"end\"");
    };
    for (int exponent = low_; exponent <= high_; ++exponent)
      if ((exponent - high_) % step == 0) label((*this)(std::pow(10, exponent)), decade(exponent));
    if (hasZero_) label((*this)(0), "0");
    if (hasNone_) label((*this)(INFINITY), "NaN, inf");
    return out +
           text(0, 0, "largest error, px",
                "text-anchor=\"middle\" transform=\"translate(18 " + at((kTop + kBottom) / 2) + ") rotate(-90)\"");
  }

 private:
  static constexpr double kLine = 38;
  int low_ = 0, high_ = 1;
  bool hasZero_ = false, hasNone_ = false;
  double bottom_ = kBottom, top_ = kTop;
};

std::string marker(double x, double y, std::size_t series) {
  const std::string colour = std::string("fill=\"") + kColours[series] + "\"";
  if (series == 0) return "<circle cx=\"" + at(x) + "\" cy=\"" + at(y) + "\" r=\"5\" " + colour + "/>";
  return "<path d=\"M" + at(x) + " " + at(y - 6.5) + "l6.5 6.5l-6.5 6.5l-6.5 -6.5z\" " + colour + "/>";
}

std::string boundTick(double x, double y, std::size_t series) {
  return line(x - kTick, y, x + kTick, y, std::string("stroke=\"") + kColours[series] + "\" stroke-width=\"2.5\"");
}

/// Puts each label beside its dot where it hides nothing, or the least.
class Labels {
 public:
  void avoid(const Box& box) { taken_.push_back(box); }

  std::string place(double x, double y, const std::string& words) {
    // Wider than any usual sans-serif face.
    const double half = 0.29 * kText * static_cast<double>(words.size()), side = kDot + 4 + half;
    const double up = kText * 0.5 + kDot + 3;
    const std::array<std::array<double, 2>, 10> tries = {{{side, 0},
                                                          {-side, 0},
                                                          {0, -up},
                                                          {0, up},
                                                          {side, -up},
                                                          {-side, -up},
                                                          {side, up},
                                                          {-side, up},
                                                          {0, -2 * up},
                                                          {0, 2 * up}}};
    Box best{};
    double bestSide = 0;
    double least = INFINITY;
    for (const auto& [dx, dy] : tries) {
      const Box box = around(x + dx, y + dy, half, kText * 0.5);
      double hidden = 0;
      for (const Box& other : taken_) hidden += overlap(box, other);
      const double area = (box.right - box.left) * (box.bottom - box.top);
      hidden += 4 * (area - overlap(box, {kLeft, kTop, kRight, kBottom}));
      if (hidden < least) {
        least = hidden;
        best = box;
        bestSide = dx;
      }
    }
    taken_.push_back(best);
    // The box is a guess at the text's width: the end next to the dot is where it is certain.
    const double baseline = (best.top + best.bottom) / 2 + kText / 3;
    if (bestSide > 0) return text(best.left, baseline, words, "class=\"label\"");
    if (bestSide < 0) return text(best.right, baseline, words, "text-anchor=\"end\" class=\"label\"");
    return text((best.left + best.right) / 2, baseline, words, "text-anchor=\"middle\" class=\"label\"");
  }

 private:
  std::vector<Box> taken_;
};

std::string legend(const CostPlot& plot) {
  std::string out;
  double x = 22;
  const double y = 64;
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    out += marker(x, y - 4, i) + "\n" + text(x + 12, y, plot.series[i], "class=\"small\"");
    x += 40 + 0.52 * kSmallText * static_cast<double>(plot.series[i].size());
  }
  return out + line(x - 6, y - 4, x + 10, y - 4, "stroke=\"#444\" stroke-width=\"2.5\"") +
         text(x + 17, y, "proven bound", "class=\"small\"");
}

}  // namespace

std::string costPlotSvg(const CostPlot& plot) {
  const CostAxis x(plot.dots);
  const ErrorAxis y(plot.dots);
  std::string out = beginPicture(plot.title, plot.caption) + legend(plot) + x.grid() + y.grid() +
                    frame({kLeft, kTop, kRight, kBottom});
  Labels labels;
  std::string dots, words;
  for (const PlotDot& dot : plot.dots) {
    if (!isDrawn(dot)) continue;
    const double px = x(dot.nanoseconds), py = y(*dot.pixels);
    labels.avoid(around(px, py, kDot + 2, kDot + 2));
    if (dot.bound && isPositive(*dot.bound)) {
      const double pb = y(*dot.bound);
      dots += line(px, py, px, pb,
                   std::string("stroke=\"") + kColours[dot.series] + "\" stroke-dasharray=\"2 3\" opacity=\"0.7\"");
      dots += boundTick(px, pb, dot.series);
      labels.avoid(around(px, pb, kTick, 3));
      labels.avoid({px - 1, std::min(py, pb), px + 1, std::max(py, pb)});
    }
    dots += marker(px, py, dot.series) + "\n";
  }
  for (const PlotDot& dot : plot.dots)
    if (isDrawn(dot)) words += labels.place(x(dot.nanoseconds), y(*dot.pixels), dot.label);
  if (dots.empty())
    words = text((kLeft + kRight) / 2, (kTop + kBottom) / 2, "no errors to show", "text-anchor=\"middle\"");
  return out + dots + words + "</svg>\n";
}

}  // namespace viewproj::cmd
