// screenToRay and screenToWorld: what lies behind a pixel.
#pragma once

#include <cstdint>

#include "camera/camera.hpp"

namespace viewproj {

/// direction has unit length.
struct Ray {
  Vec3 origin, direction;
};

enum class RayOrigin {
  eye,  ///< the plane through the eye: the eye itself in perspective, a point per pixel in orthographic
  nearPlane,
};

/// Largest angle in radians between a ray's direction and the true one, for pixels of the picture, in every precision
/// and whatever near and far are. Five roundings a component, (5 sqrt(3) + 1) 2^-53, plus what a pose matrix's
/// non-orthogonality adds.
inline constexpr double kRayDirectionBound = 1.2e-15;

/// The ray of points that project to this screen position. No matrix and no inverse: window coordinates of the pixel
/// along the camera's axes. NaN in, NaN out. In exact, each component is within 0.51 ulp of the true one.
Ray screenToRay(const Camera& camera, const Vec2& screen, Precision precision = Precision::exact,
                RayOrigin origin = RayOrigin::eye) noexcept;

enum class DepthStatus : std::uint8_t {
  point,
  infinity,   ///< the window depth of points infinitely far away: a direction, no point
  beyond,     ///< a depth that no point in front of the eye has
  notFinite,  ///< the input had a NaN or an infinity
};

struct WorldPoint {
  Vec3 position;  ///< NaN unless status is point
  DepthStatus status = DepthStatus::point;
  /// How far position can be from the true point, in world units, if the window depth given is the double nearest the
  /// true one; infinite where that double could also be the depth of infinity. What the arithmetic adds, half a unit in
  /// the last place of each coordinate, is included; of a point by its distance it is all.
  double bound = 0;
};

/// How far a point moves along its ray, per unit of window depth: W^2 / |depthScale| times the slant of the ray in
/// perspective, with W the view distance. At standard depth and W far beyond near it is enormous: a depth near 1 says
/// little. Multiply by half the step of the depth buffer that a depth was read from.
double distancePerDepth(const Camera& camera, const Vec2& screen, double viewDistance) noexcept;

/// The point at this screen position and window depth (as worldToScreen gives it; not clamped). In double-double and
/// rounded once; what the depth's own last digit is worth in distance is the depth's, not the arithmetic's.
WorldPoint screenToWorld(const Camera& camera, const Vec2& screen, double depth) noexcept;

/// The point at this screen position and distance along the viewing axis.
WorldPoint screenToWorldAtDistance(const Camera& camera, const Vec2& screen, double viewDistance) noexcept;

/// Every stage of one pixel's way back, for following it by hand. Each number is the double nearest the true value of
/// that stage; a sum that cancels to less than 2^-98 of its terms is 0.
struct PixelStages {
  Vec2 fromCenter;  ///< pixels from where the viewing axis meets the screen
  Vec2 window;      ///< window coordinates right and up: tangents, or in orthographic lengths
  Vec3 toward;      ///< in world axes the way to the plane at distance 1 along the view; in orthographic forward
  double length = 1;
  Ray ray;  ///< as screenToRay gives it, from the plane through the eye
};

PixelStages pixelStages(const Camera& camera, const Vec2& screen) noexcept;

/// From a window depth to the distance along the view: reciprocal is offset + scale depth, its inverse the distance; in
/// orthographic the sum is the distance itself.
struct DepthStages {
  double offset = 0, scale = 0;
  double sum = 0;
  double distance = 0;  ///< NaN unless point.status is point
  WorldPoint point;     ///< as screenToWorld gives it
};

DepthStages depthStages(const Camera& camera, const Vec2& screen, double depth) noexcept;

}  // namespace viewproj
