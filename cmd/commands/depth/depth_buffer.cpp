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
/// A float's step below a depth is at most this share of the depth.
constexpr double kLargestFloatShare = 0x1p-23;

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

  /// The inverse, for a depth between near's and far's. Infinite at infinity's depth.
  double distance(double depth) const {
    const auto at = depthFraction<DoubleDouble>(depth, {mapping.atNear, mapping.atFar});
    if (mapping.orthographic) return orthographicDistance(near, far, at).hi;
    const DoubleDouble divisor = nearOverDistance(near, far, at);
    return divisor.hi > 0 ? (DoubleDouble(near) / divisor).hi : kInfiniteFar;
  }

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

/// How far the nearer of two surfaces a gap apart may be while they differ by a step: the solution of
///   rate (1/v - 1/(v + gap)) = step.
double nearerResolved(const Scaled& s, double gap, double step) {
  if (s.mapping.orthographic) return s.rate * gap >= step ? kInfiniteFar : -kInfiniteFar;
  const double product = gap * (s.rate / step);
  return product / (gap / 2 + std::hypot(gap / 2, std::sqrt(product)));
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

double resolvedUpTo(const DepthMapping& m, const DepthFormat& format, double gap) noexcept {
  const Scaled s(m);
  const double apart = std::ldexp(gap, s.exponent);
  const double last = s.far - apart;  // the nearer surface of the last pair
  const auto upTo = [&](double nearer) {
    if (!(nearer > s.near)) return m.near;
    return nearer < last ? s.unscaled(nearer + apart) : m.far;
  };
  if (!(s.near < last)) return m.far;
  if (format.step > 0) return upTo(nearerResolved(s, apart, format.step));
  // From near to far through the powers of two that the larger depth passes.
  const double first = s.reversed ? s.near : s.near + apart;
  const double end = s.reversed ? last : s.far;
  const int from = binadeBelow(s.depth(first));
  const DoubleDouble farthest = std::isinf(end) ? DoubleDouble(m.atFar) : s.depth(end);
  const int to = binadeBelow(farthest);
  const int by = s.reversed ? -1 : 1;
  double begin = s.near;  // of the binade, for the nearer surface
  for (int k = from; k != to + by; k += by) {
    const double resolved = nearerResolved(s, apart, floatStep(k));
    double binadeEnd = last;
    if (k != to) binadeEnd = s.reversed ? s.distance(std::ldexp(1.0, k)) : s.distance(std::ldexp(1.0, k + 1)) - apart;
    if (resolved < binadeEnd) return upTo(std::max(begin, resolved));
    begin = binadeEnd;
  }
  return m.far;
}

double nearToResolve(const DepthMapping& m, const DepthFormat& format, double gap, double distance) noexcept {
  // The change of depth over the gap must be a step: rate * lever >= step, with lever = 1/v - 1/distance or gap.
  const double span = std::fabs(m.atNear - m.atFar);
  const double nearer = distance - gap;
  const double scale = m.orthographic ? 1 : distance;  // makes distances in perspective shares of this one
  const double lever = m.orthographic ? gap : gap / nearer;
  const double inverseFar = std::isinf(m.far) ? 0 : scale / m.far;
  // rate = span / (1/near - 1/far) in perspective, span / (far - near) in orthographic
  const auto nearForRate = [&](double rate) {
    if (rate == 0) return m.orthographic ? -kInfiniteFar : 0;
    const double near = m.orthographic ? m.far - span / rate : scale / (inverseFar + span / rate);
    return near <= nearer ? near : kNaN;
  };
  if (format.step > 0) return nearForRate(format.step / lever);
  const double byLargest = nearForRate(floatStep(binadeBelow(largestDepth(m))) / lever);
  // The step is also at most a share of the larger depth, which is atFar + rate * beyond:
  //   rate * lever >= share (atFar + rate * beyond)
  const bool reversed = m.atFar < m.atNear;
  const double larger = reversed ? nearer : distance;
  const double beyond = (reversed ? 1 : -1) * (m.orthographic ? m.far - larger : scale / larger - inverseFar);
  const double factor = lever - kLargestFloatShare * beyond;
  const double byShare = factor > 0 ? nearForRate(kLargestFloatShare * m.atFar / factor) : kNaN;
  return std::fmin(byLargest, byShare);
}

}  // namespace viewproj::cmd
