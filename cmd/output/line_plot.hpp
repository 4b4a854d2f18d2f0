// Curves over a distance as a self-contained SVG.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace viewproj::cmd {

struct PlotCurve {
  std::string label;                              ///< at its right end; empty: none
  std::vector<std::pair<double, double>> points;  ///< x ascending, y > 0
  std::size_t colour = 0;                         ///< 0 to 3
  bool dashed = false;
  bool wide = false;  ///< shows at the sides of one drawn over it
};

/// A horizontal line at a value of y.
struct PlotLevel {
  std::string label;
  double y = 1;
};

struct LinePlot {
  std::string title, caption, xTitle, yTitle;
  bool logarithmicX = true;
  std::vector<PlotCurve> curves;
  std::vector<PlotLevel> levels;
};

/// y is logarithmic.
std::string linePlotSvg(const LinePlot& plot);

}  // namespace viewproj::cmd
