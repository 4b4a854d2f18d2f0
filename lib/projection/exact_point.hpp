// A point's distances along the camera's axes: the one step that every projection begins with.
#pragma once

#include "camera/camera.hpp"
#include "numbers/wide.hpp"
#include "viewproj/screen.hpp"

namespace viewproj::detail {

/// Whether a point is one that is projected: finite, not 0 0 0 0, no farther than kFarthestPoint from the eye, a
/// direction no longer; its weight 0 or between 1e-90 and 1e90 in magnitude.
bool isInDomain(const Vec3& eye, const Vec4& point) noexcept;

/// Distances along right, up and forward, still to be divided by the point's weight. Each is within 2^-99 of itself and
/// the error, which only a pose of sines and cosines has: its rows are off by 2^-206 and more where up is near the
/// view. Then a distance that cancels to less is 0, and a point nearer to the eye plane than 2^60 errors counts as on
/// it. Otherwise 0 means 0, and the sign of forward is certain.
struct AxisDistances {
  Wide right, up, forward;
  Wide error;
};

/// From the exact rows, in about a microsecond. Of points that isInDomain.
AxisDistances exactDistances(const PoseParts& pose, const Vec4& point) noexcept;

/// The screen position by exactDistances. What is not certain is a tie, or a number that cancels to about 0.
ScreenPoint exactToScreen(const CameraParts& camera, const Vec4& point) noexcept;

}  // namespace viewproj::detail
