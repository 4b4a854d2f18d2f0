// A plot of error over cost as a self-contained SVG: no scripts, no fonts of its own, any width.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace viewproj::cmd {

struct PlotDot {
  std::string label;
  double nanoseconds = 0;        ///< per point, > 0
  std::optional<double> pixels;  ///< the error; no value: not drawn; not finite: on a line of its own above the others
  std::optional<double> bound;   ///< a tick above the dot where it is finite
  std::size_t series = 0;        ///< 0 or 1
};

struct CostPlot {
  std::string title, caption;
  std::vector<std::string> series;  ///< names, for the legend
  std::vector<PlotDot> dots;
};

/// Both axes are logarithmic; an error of 0 lies on a line of its own below the others.
std::string costPlotSvg(const CostPlot& plot);

}  // namespace viewproj::cmd
