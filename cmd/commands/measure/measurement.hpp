// Speed and error of every way to project points, and to cast rays, on one scene.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "viewproj/screen.hpp"

namespace viewproj::cmd {

/// Below this many points the cost of a call counts beside the cost of its points.

/// One way to project, or to cast. Numbers that do not exist are absent; errors may be infinite or NaN, where a result
/// is.
struct ModeRow {
  explicit ModeRow(std::string name, std::optional<Precision> arithmetic = std::nullopt)
      : mode(std::move(name)), precision(arithmetic) {}

  std::string mode;
  std::optional<Precision> precision;  ///< none: the textbook
  double nsPerPoint = 0;               ///< of the fastest round
  double spread = 1;                   ///< the median round over the fastest
  std::optional<double> maxErrorPx, p99ErrorPx, maxErrorUlp;
  std::optional<double> maxErrorRadians, p99ErrorRadians;  ///< rays
  std::optional<double> boundPx;                           ///< proven; infinite where nothing can be
  std::optional<double> escalated, uncertain;              ///< shares of the points, see BatchCounts
  std::optional<std::size_t> missing;                      ///< points in the picture whose result is not finite
};

struct Measurement {
  std::size_t points = 0;
  std::size_t visible = 0;  ///< those in the picture, whose errors count and whose pixels the rays go through
  std::string kernel;
  std::vector<ModeRow> projecting;
  std::vector<ModeRow> casting;  ///< empty where no point is in the picture
};

Measurement measure(const Camera& camera, std::span<const Vec3> points);

std::string_view precisionName(Precision precision);

}  // namespace viewproj::cmd
