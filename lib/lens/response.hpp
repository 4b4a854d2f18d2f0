// What a lens does to small differences and to rounding errors, between two distances from the axis. Internal.
#pragma once

#include "lens/lens.hpp"

namespace viewproj::detail {

struct Range {
  double low, high;
};

/// Proven bounds over a range of distances r from the axis, before the lens.
struct Response {
  Range radial, tangential;  ///< stretching along and across, without p1 and p2
  double stretch = 0;        ///< the largest factor of a difference, with p1 and p2
  double least = 0;          ///< the least, or 0
  /// Of distort, for a rounding unit of 1: of double 2^-53, of double-double kFineUnit.
  double rounding = 0;
};
Response responseOver(const LensParts& lens, const Range& r) noexcept;

/// The slope of a fisheye's distances, over a range of angles.
Range slopeOver(const LensParts& lens, const Range& angle) noexcept;

/// Operations of double-double are within 10 2^-106, an arctangent within 2^-94.
inline constexpr double kFineUnit = 0x1p-94;

/// More than stretch and rounding are at r, in a few operations: for certificates that have digits to spare. Infinite
/// next to a pole.
struct Roughly {
  double stretch, rounding;
};
Roughly roughly(const LensParts& lens, double r) noexcept;

}  // namespace viewproj::detail
