#include "output/cost_plot.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "output/axis.hpp"
#include "output/labels.hpp"

namespace viewproj::cmd {
namespace {

using namespace svg;

constexpr Box kArea{76, 84, 622, 402};
constexpr double kDot = 5, kTick = 8;
constexpr const char* kLabel = "class=\"label\"";
constexpr const char* kColours[] = {"#1b5faa", "#b8501c"};

bool isDrawn(const PlotDot& dot) { return dot.pixels.has_value(); }
bool isPositive(double value) { return value > 0 && std::isfinite(value); }

/// The least and the most of what is above 0; 1 where nothing is.
struct Extent {
  double least = INFINITY, most = 0;
  void add(double value) {
    if (!isPositive(value)) return;
    least = std::min(least, value);
    most = std::max(most, value);
  }
  double low() const { return most > 0 ? least : 1; }
  double high() const { return most > 0 ? most : 1; }
};

/// Nanoseconds to x: a decade at the least, and room for labels on both sides.
Axis costAxis(const std::vector<PlotDot>& dots) {
  Extent extent;
  for (const PlotDot& dot : dots)
    if (isDrawn(dot)) extent.add(dot.nanoseconds);
  const double middle = (std::log10(extent.low()) + std::log10(extent.high())) / 2;
  const double half = std::max((std::log10(extent.high()) - std::log10(extent.low())) * 0.62, 0.5);
  return {true, std::pow(10, middle - half), std::pow(10, middle + half), kArea.left, kArea.right};
}

/// Pixels to y: decades, with a line for 0 below them and one for what is not finite above.
class ErrorAxis {
 public:
  explicit ErrorAxis(const std::vector<PlotDot>& dots) : decades_(decadesOf(dots)) {}

  double operator()(double pixels) const {
    if (!std::isfinite(pixels)) return kArea.top + 14;
    if (pixels == 0) return kArea.bottom - 14;
    return decades_(pixels);
  }

  std::string grid() const {
    std::string out;
    for (const Tick& tick : decades_.ticks()) out += level(kArea, decades_(tick.value), tick);
    if (hasZero_) out += level(kArea, (*this)(0), {0, "0"});
    if (hasNone_) out += level(kArea, (*this)(INFINITY), {INFINITY, "NaN, inf"});
    return out;
  }

 private:
  Axis decadesOf(const std::vector<PlotDot>& dots) {
    Extent extent;
    for (const PlotDot& dot : dots) {
      if (!isDrawn(dot)) continue;
      hasZero_ |= *dot.pixels == 0;
      hasNone_ |= !std::isfinite(*dot.pixels);
      for (double value : {*dot.pixels, dot.bound.value_or(0)}) extent.add(value);
    }
    const double low = std::floor(std::log10(extent.low()));
    const double high = std::max(std::ceil(std::log10(extent.high())), low + 1);
    constexpr double kRoom = 38, kEdge = 8;
    return {true, std::pow(10, low), std::pow(10, high), kArea.bottom - (hasZero_ ? kRoom : kEdge),
            kArea.top + (hasNone_ ? kRoom : kEdge)};
  }

  bool hasZero_ = false, hasNone_ = false;
  Axis decades_;
};

std::string marker(double x, double y, std::size_t series) {
  const std::string colour = std::string("fill=\"") + kColours[series] + "\"";
  if (series == 0) return "<circle cx=\"" + at(x) + "\" cy=\"" + at(y) + "\" r=\"5\" " + colour + "/>";
  return "<path d=\"M" + at(x) + " " + at(y - 6.5) + "l6.5 6.5l-6.5 6.5l-6.5 -6.5z\" " + colour + "/>";
}

std::string boundTick(double x, double y, std::size_t series) {
  return line(x - kTick, y, x + kTick, y, std::string("stroke=\"") + kColours[series] + "\" stroke-width=\"2.5\"");
}

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
  const Axis x = costAxis(plot.dots);
  const ErrorAxis y(plot.dots);
  std::string out = beginPicture(plot.title, plot.caption) + legend(plot);
  for (const Tick& tick : x.ticks(true)) out += upright(kArea, x(tick.value), tick);
  out += y.grid() + frameWithTitles(kArea, "time, ns per point or ray", "largest error, px");
  Labels labels(kArea, kText, true);
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
      labels.avoidLine(px, py, px, pb);
    }
    dots += marker(px, py, dot.series) + "\n";
  }
  for (const PlotDot& dot : plot.dots) {
    if (!isDrawn(dot)) continue;
    const double px = x(dot.nanoseconds), py = y(*dot.pixels);
    const auto label = labels.place(around(px, py, kDot, kDot), dot.label, kLabel);
    words += label.value_or(text(px + kDot + 3, py + kText / 3, dot.label, kLabel));  // in a crowd, over the others
  }
  if (dots.empty())
    words = text((kArea.left + kArea.right) / 2, (kArea.top + kArea.bottom) / 2, "no errors to show",
                 "text-anchor=\"middle\"");
  return out + dots + words + "</svg>\n";
}

}  // namespace viewproj::cmd
