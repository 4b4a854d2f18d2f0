// A clip or view matrix taken apart, with what the rounding of its entries leaves of its depth. Internal.
#pragma once

#include <optional>

#include "input/readings/estimate.hpp"
#include "numbers/vectors.hpp"

namespace viewproj::cmd {

/// Ends in double-double; an end may be infinite.
struct Interval {
  detail::DoubleDouble low, high;
};

/// The value, and the most by which the entries' rounding moves it, to first order.
struct Uncertain {
  detail::DoubleDouble value;
  double error = 0;

  Interval interval() const noexcept {
    return {value - detail::DoubleDouble(error), value + detail::DoubleDouble(error)};
  }
};

/// With X, Y, W the distances of a point along right, ndcUp, forward from the eye (orthographic: from the origin), in
/// perspective
///   clip = (scaleX X + offsetX W, scaleY Y + offsetY W, depthOffset W + depthScale, W)
/// and in orthographic
///   clip = (scaleX X + offsetX, scaleY Y + offsetY, depthOffset + depthScale W, 1)
/// all times scale. ndcUp is where NDC y grows. Scales of x and y, and in orthographic that of depth, are positive.
struct ClipParts {
  bool orthographic = false;
  double scale = 1;
  detail::DoubleDouble scaleX, offsetX, scaleY, offsetY;
  Uncertain depthOffset, depthScale;
  detail::DDVec3 right, ndcUp, forward, eye;
  double residual = 0;       ///< of the right angles, and of the z row's from the w row
  double residualError = 0;  ///< the most by which the residual is moved
};

/// A matrix that acts on column vectors. Nothing where x or y does not change across the picture, as far as the entries
/// tell.
std::optional<ClipParts> perspectiveParts(const Mat4& matrix, const EntryErrors& errors) noexcept;
std::optional<ClipParts> orthographicParts(const Mat4& matrix, const EntryErrors& errors) noexcept;

/// The eye of a view matrix.
detail::DDVec3 eyeOfView(const Mat4& matrix) noexcept;

/// The most by which a number is off downwards and upwards: half the distances to its neighbours, or further.
struct HalfSteps {
  double down, up;
};
HalfSteps halfSteps(double value, EntryPrecision precision, double within = 0) noexcept;

/// a / b for b above 0 or reaching down to it.
Interval quotient(Interval a, Interval b) noexcept;
detail::DoubleDouble quotient(detail::DoubleDouble a, detail::DoubleDouble b) noexcept;

/// Rounded outwards.
Estimate estimate(detail::DoubleDouble value, Interval interval) noexcept;

}  // namespace viewproj::cmd
