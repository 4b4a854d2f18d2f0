#include "commands/depth/depth_buffer.hpp"

#include <algorithm>
#include <cmath>

#include "camera/depth.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kLargestRatio = 0x1p900;
constexpr double kSmallestSize = 0x1p-800;
constexpr int kFloatDigits = 24;
constexpr double kSmallestFloat = 0x1p-149;
constexpr int kSmallestFloatExponent = -126;

/// Each end of the depth range by its share, so that the depth keeps its digits next to 0.
Wide depthAt(const DepthMapping& m, const Wide& distance) {
  const auto shares = depthShares<Wide>(m.orthographic, m.near, m.far, distance, 1);
  const Wide depth = Wide(m.atNear) * shares.ofNear + Wide(m.atFar) * shares.ofFar;
  return m.orthographic ? depth : depth / distance;
}

/// The mapping with distances times a power of two: the near plane of a perspective lies between 1 and 2, so that no
/// product of distances leaves the range of doubles.
struct Scaled {
  explicit Scaled(const DepthMapping& m) : mapping(m) {
    if (!m.orthographic)
      exponent = -std::ilogb(m.near);
    else if (const double size = std::max(std::fabs(m.near), std::fabs(m.far)); size > kLargestRatio)
      exponent = -200;
    else if (size < kSmallestSize)
      exponent = 500;
    near = std::ldexp(m.near, exponent);
    far = std::ldexp(m.far, exponent);
    if (!m.orthographic && far > kLargestRatio) far = kInfiniteFar;
    if (std::isfinite(far)) range = twoDiff(far, near);
    const double step = std::fabs(m.atNear - m.atFar);
    //   perspective: |depth change| = rate |1/v - 1/w|, orthographic: rate |w - v|
    if (m.orthographic)
      rate = (DoubleDouble(step) / range).hi;
    else
      rate = (DoubleDouble(step) * DoubleDouble(near) * farOverRange()).hi;
    reversed = m.atFar < m.atNear;
  }

  double scaled(double distance) const {
    const double d = std::ldexp(distance, exponent);
    return mapping.orthographic ? d : std::clamp(d, 1 / kLargestRatio, kLargestRatio);
  }
  double unscaled(double distance) const { return std::ldexp(distance, -exponent); }
  DoubleDouble farOverRange() const { return std::isinf(far) ? DoubleDouble(1) : DoubleDouble(far) / range; }

  DoubleDouble depth(double w) const { return toDoubleDouble(depthAt(mapping, {w, -exponent})); }

  DepthMapping mapping;
  int exponent = 0;
  double near, far;
  DoubleDouble range;  ///< far - near, where far is finite
  double rate;
  bool reversed;
};

/// The k for which depth lies in (2^k, 2^(k+1)]; everything up to the smallest normal float counts as one.
int binadeBelow(DoubleDouble depth) {
  if (!(depth.hi > 0)) return kSmallestFloatExponent - 1;
  int exponent;
  const double fraction = std::frexp(depth.hi, &exponent);
  const bool atOrBelowPower = fraction == 0.5 && depth.lo <= 0;
  return std::max(exponent - (atOrBelowPower ? 2 : 1), kSmallestFloatExponent - 1);
}

/// The step of floats in (2^k, 2^(k+1)].
double floatStep(int k) { return std::max(std::ldexp(1.0, k - (kFloatDigits - 1)), kSmallestFloat); }

double largestDepth(const DepthMapping& m) { return std::max(m.atNear, m.atFar); }

/// The larger depth of a pair of surfaces decides the step of floats: the farther one's, or with reversed depth the
/// nearer one's, which is a step above.
double stepAt(const Scaled& s, const DepthFormat& format, double w) {
  if (format.step > 0) return format.step;
  const DoubleDouble depth = s.depth(w);
  double step = floatStep(binadeBelow(depth));
  if (s.reversed) {
    // The next float may be in the next binade.
    step = floatStep(binadeBelow(depth + DoubleDouble(step)));
    step = std::min(step, floatStep(binadeBelow(largestDepth(s.mapping))));
  }
  return step;
}

}  // namespace

DepthMapping depthMapping(const ProjectionParts& p, double depthFirst, double depthSecond, bool reverseZ) noexcept {
  if (reverseZ) std::swap(depthFirst, depthSecond);
  return {p.orthographic, p.near, p.far, depthFirst, depthSecond};
}

double depthAtDistance(const DepthMapping& m, double distance) noexcept { return nearestDouble(depthAt(m, distance)); }

double distanceAtDepth(const DepthMapping& m, double depth) noexcept {
  if (!std::isfinite(depth)) return kNaN;
  const auto at = depthFraction<Wide>(depth, {m.atNear, m.atFar});
  if (m.orthographic) return double(orthographicDistance(m.near, m.far, at));
  const Wide share = nearOverDistance(m.near, m.far, at);
  if (share.sign() < 0) return kNaN;
  return share.sign() == 0 ? kInfiniteFar : double(Wide(m.near) / share);
}

double depthSlope(const DepthMapping& m, double distance) noexcept {
  const Wide n = m.near, w = distance;
  Wide slope = Wide(m.atFar) - Wide(m.atNear);
  if (std::isfinite(m.far)) slope = slope / (Wide(m.far) - n);
  if (m.orthographic) return nearestDouble(slope);
  if (std::isfinite(m.far)) slope = slope * Wide(m.far);
  return nearestDouble(slope * n / w / w);
}

double depthStep(const DepthMapping& m, const DepthFormat& format, double distance) noexcept {
  const Scaled s(m);
  return stepAt(s, format, s.scaled(distance));
}

double resolvedGap(const DepthMapping& m, const DepthFormat& format, double distance) noexcept {
  const Scaled s(m);
  const double w = s.scaled(distance);
  const double step = stepAt(s, format, w);
  if (m.orthographic) return s.unscaled(step / s.rate);
  // w^2 step / (rate + w step)
  return distance / (1 + s.rate / w / step);
}

}  // namespace viewproj::cmd
