// A lens's numbers, and where it sees.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "camera/access.hpp"
#include "numbers/arctangent.hpp"
#include "viewproj/lens.hpp"

namespace viewproj::detail {

/// Brown's polynomials are evaluated and proven at radii below this.
inline constexpr double kLargestRadius = 0x1p60;

/// A direction, or a point, along the camera's axes: right, down and forward, times any length.
template <class Number>
struct Sight {
  Number right, down, forward;
};

/// On the plane that a lens maps to, right and down of the axis.
template <class Number>
struct PlanePoint {
  Number x, y;
};

/// Every lens is one of two maps, from X, Y, Z to the plane, with R = hypot(X, Y):
///   sphere map  d1 = |X, Y, Z|,  k = Z + xi d1,  D = alpha sqrt(beta R^2 + k^2) + (1 - alpha) k
///               (x, y) = (X, Y) / D, then Brown's polynomials
///   angle map   t = atan2(across R, Z),  (x, y) = (X, Y) / R t (1 + k1 t^2 + k2 t^4 + ...)
/// and the picture is this times `scale`, which makes the slope on the axis 1: near the axis every lens agrees with its
/// pinhole.
struct LensParts {
  LensModel model = LensModel::brown;
  bool isAngle = false;  ///< angle map
  double xi = 0, alpha = 0, beta = 1;
  double omega = 0;  ///< of fov
  std::array<double, 6> k{};
  std::array<double, 2> p{};
  double statedRadius = std::numeric_limits<double>::infinity(), statedDegrees = 180;  ///< the calibration's limit

  // Derived from these.
  DoubleDouble oneLessAlpha = 1, across = 1, scale = 1;
  bool isScaled = false;
  std::size_t numeratorTerms = 0, denominatorTerms = 0;  ///< without zeros at the end; of an angle map only the first
  double tangential = 0;                                 ///< hypot(p1, p2), rounded up
  bool isBrown = false;                                  ///< the sphere map is followed by Brown's polynomials

  /// Directions from here on have no pixel: the sine and cosine of the angle to the axis. (0, -1) for none. Below it
  /// the lens is proven one-to-one.
  DoubleDouble limitSine = 0, limitCosine = -1;
  double limitDegrees = std::numeric_limits<double>::infinity();
  LimitCause cause = LimitCause::none;

  /// Largest radius before Brown's polynomials, and the one that these have a proof for; largest angle t.
  double planeEnd = std::numeric_limits<double>::infinity(), brownEnd = kLargestRadius, angleEnd = kHalfTurn.hi;
  /// No direction is put farther from the axis, before `scale`.
  double edge = std::numeric_limits<double>::infinity();
  /// Up to this radius, or angle, the curvature of the map and the size of its terms are below kGentle.
  double gentleEnd = 0;

  /// k1, k2, ...
  std::span<const double> numerator() const noexcept { return {k.data(), numeratorTerms}; }
  /// k4, k5, ...
  std::span<const double> denominator() const noexcept { return {k.data() + 3, denominatorTerms}; }
  bool isRational() const noexcept { return denominatorTerms > 0; }
};

inline constexpr double kGentle = 0x1p20;

inline const LensParts& parts(const Lens& lens) noexcept { return *Access::shared(lens); }

/// The lens is a pinhole.
bool isPinhole(const LensParts& lens) noexcept;

/// The slope of the calibration's plane on the axis: a pinhole of focal length f times this agrees with the lens there.
DoubleDouble slopeOnAxis(const LensParts& lens) noexcept;

/// Sets limit..., ...End and edge: lib/lens/limit.cpp.
void setLimits(LensParts& lens);

/// How fast the slope of Brown's polynomials can change between these radii. Infinite next to a pole.
double curvature(const LensParts& lens, double from, double to) noexcept;

/// Whether a lens sees a direction: isSeen() of lens/map.hpp.
struct Seen {
  bool isSeen, certain;
};

/// The direction that is put there, before `scale`, of unit length, and how far it may be from the true one in radians;
/// NaN where none is proven to be the only one: lib/lens/undistort.cpp.
struct Undistorted {
  Sight<DoubleDouble> at;
  double error;
};
Undistorted undistort(const LensParts& lens, const PlanePoint<DoubleDouble>& target) noexcept;

/// Of targets that lens/inverse.hpp leaves: slower.
Undistorted undistortSlowly(const LensParts& lens, const PlanePoint<DoubleDouble>& target) noexcept;

}  // namespace viewproj::detail
