#include "commands/measure/errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace viewproj::cmd {
namespace {

/// std::max would lose a NaN.
bool below(double a, double b) { return !std::isnan(a) && (std::isnan(b) || a < b); }

double larger(double a, double b) { return below(a, b) ? b : a; }

double ulps(double result, double exact) {
  if (result == exact) return 0;
  const double size = std::fabs(exact);
  // The gap above 0 is no measure of anything.
  if (size == 0) return std::isnan(result) ? result : std::numeric_limits<double>::infinity();
  return std::fabs(result - exact) / (std::nextafter(size, std::numeric_limits<double>::infinity()) - size);
}

}  // namespace

void ErrorTally::add(double error) {
  errors_.push_back(error);
  if (!std::isfinite(error)) ++missing_;
}

double ErrorTally::largest() const {
  return errors_.empty() ? 0 : *std::max_element(errors_.begin(), errors_.end(), below);
}

double ErrorTally::percentile99() {
  if (errors_.empty()) return 0;
  const std::size_t rank = errors_.size() - 1 - errors_.size() / 100;
  const auto at = errors_.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(errors_.begin(), at, errors_.end(), below);
  return *at;
}

double errorInPixels(const Vec2& result, const Vec2& exact) {
  return larger(std::fabs(result.x - exact.x), std::fabs(result.y - exact.y));
}

double errorInUlps(const Vec2& result, const Vec2& exact) {
  return larger(ulps(result.x, exact.x), ulps(result.y, exact.y));
}

double angleBetween(const Vec3& a, const Vec3& b) {
  const Vec3 d{a.x - b.x, a.y - b.y, a.z - b.z};
  const double chord = std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
  // Two unit vectors are at most 2 apart, but for their rounding.
  return chord > 2 ? std::asin(1.0) * 2 : 2 * std::asin(chord / 2);
}

}  // namespace viewproj::cmd
