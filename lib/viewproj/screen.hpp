// World to screen and back: points, pixels and rays, one or many at a time, and how wrong each may be.
//
// Screen positions are pixels, in the viewport's origin and pixelCenter; window depth is that of depthFirst and
// depthSecond, not clamped. Nothing here allocates or throws.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "viewproj/camera.hpp"

namespace viewproj {

/// Which arithmetic a result is computed in.
enum class Precision {
  standard,  ///< double, relative to the eye; through a lens as exact
  exact,     ///< the double nearest the true value
};

/// What a point or a direction of the world is to the camera.
enum class PointStatus : std::uint8_t {
  inFront,     ///< has a screen position
  behind,      ///< perspective: on or behind the plane through the eye; no screen position
  atInfinity,  ///< orthographic: a direction, which no finite screen position belongs to
  beyondLens,  ///< in front, at the limit of the camera's lens or beyond it; no screen position
  outOfRange,  ///< not finite, farther than kFarthestPoint from the eye, or 0 0 0 0
};

/// Of a point |x - eye.x| + |y - eye.y| + |z - eye.z| is below this, and of a direction |x| + |y| + |z|. However small
/// its coordinates are, nothing of them is lost; but a distance below 1e-307 comes out with fewer digits. A weight is
/// 0, or between 1e-90 and 1e90 in magnitude.
inline constexpr double kFarthestPoint = 1e91;

/// Whether a point is none that worldToScreen finds out of range.
bool isInRange(const Camera& camera, const Vec4& point) noexcept;

/// The boundaries of the view that a point may lie beyond, named the same in every convention.
enum Side : std::uint8_t {
  sideLeft = 1,
  sideRight = 2,
  sideBottom = 4,
  sideTop = 8,
  sideNear = 16,
  sideFar = 32,
};

/// Numbers that do not exist are NaN.
struct ScreenPoint {
  double x = 0, y = 0;      ///< position, in the viewport's origin and pixelCenter
  double depth = 0;         ///< window depth, not clamped; NaN of a camera without near plane
  double viewDistance = 0;  ///< along the viewing axis; NaN for a direction
  PointStatus status = PointStatus::inFront;
  std::uint8_t outside = 0;  ///< Sides the point lies beyond; a point on a boundary is inside
  /// exact: x, y, depth and viewDistance are certainly the doubles nearest the true values. Otherwise one of them is a
  /// tie or cancels to about 0, and within kExactUlps or kExactAbsolute.
  bool certain = false;
  /// What the numbers were computed in: exact where the precision asked for could not bound the point.
  /// boundOfPoint of this precision is theirs.
  Precision precision = Precision::exact;

  bool visible() const noexcept { return status == PointStatus::inFront && outside == 0; }
};

/// The sides of the picture that a screen position lies beyond.
std::uint8_t sidesBeyond(const Camera& camera, const Vec2& screen) noexcept;

/// Projects a point, as near the true value as ErrorBound says of the precision; points that standard cannot bound are
/// projected exactly. Homogeneous, it is (x/w, y/w, z/w), negative w included, or with w = 0 a direction, whose
/// vanishing point is given; weights other than 1 are projected exactly whatever the precision.
ScreenPoint worldToScreen(const Camera& camera, const Vec3& point, Precision precision = Precision::exact) noexcept;
ScreenPoint worldToScreen(const Camera& camera, const Vec4& point, Precision precision = Precision::exact) noexcept;

// ---- Many points or pixels at a time

/// What became of the points of a batch.
struct BatchCounts {
  /// Settled one by one: off the kernel's range, next to the eye plane or to a lens's limit, or not certain.
  std::size_t escalated = 0;
  std::size_t uncertain = 0;  ///< exact: of those, the ones that no arithmetic here decides (ties, numbers about 0)
};

/// Screen x, screen y and window depth of each point: the numbers of worldToScreen for a single point, bit for bit, on
/// every processor. Both spans have the same size and may be the same memory.
BatchCounts worldToScreen(const Camera& camera, std::span<const Vec3> points, std::span<Vec3> screen,
                          Precision precision = Precision::exact) noexcept;

/// The same in full. Takes about a third longer.
BatchCounts worldToScreen(const Camera& camera, std::span<const Vec3> points, std::span<ScreenPoint> screen,
                          Precision precision = Precision::exact) noexcept;

/// The unit directions of the rays through screen positions, within kRayDirectionBound of the true ones.
void screenToRayDirections(const Camera& camera, std::span<const Vec2> pixels, std::span<Vec3> directions) noexcept;

// ---- How wrong

/// exact: units in the last place of the result, for x, y, depth and viewDistance; a result that cancels to about zero
/// keeps an absolute error instead, 1e-26 of the viewport's size, or of the whole picture's where a window was cropped
/// or shifted from far off the axis.
inline constexpr double kExactUlps = 0.51;
inline constexpr double kExactAbsolute = 1e-26;

/// exact, of a window depth that is not certain: the distance is known to this share, and the depth to this share of
/// depthScale / W (perspective) or depthScale W (orthographic). It counts in slabs of far/near - 1
/// below 2e-3, where it is beyond kExactAbsolute.
inline constexpr double kExactDistance = 0x1p-96;

/// The largest error of screen x and y, in pixels, and of window depth. Infinite where nothing is promised.
struct ErrorBound {
  double screen = 0;
  double depth = 0;
};

/// For every point whose true pixel lies in the picture, between near and far in orthographic (and whose depth lies
/// between near and far, for the depth's bound).
ErrorBound boundInPicture(const Camera& camera, Precision precision) noexcept;

/// For one point, wherever it lies, in the precision that worldToScreen has for it.
ErrorBound boundOfPoint(const Camera& camera, const Vec3& point, Precision precision) noexcept;
ErrorBound boundOfPoint(const Camera& camera, const Vec4& point, Precision precision) noexcept;

// ---- Back to the world

/// direction has unit length.
struct Ray {
  Vec3 origin, direction;
};

enum class RayOrigin {
  eye,        ///< the plane through the eye: the eye itself in perspective, a point per pixel in orthographic
  nearPlane,  ///< the eye where there is none
};

/// Largest angle in radians between a ray's direction and the true one, for pixels of the picture, in every precision,
/// whatever near and far are and through whatever lens. Five roundings a component, (5 sqrt(3) + 1) 2^-53, plus what a
/// pose matrix's non-orthogonality adds.
inline constexpr double kRayDirectionBound = 1.2e-15;

/// The ray of points that project to this screen position; NaN for NaN, and for a pixel that no point has through a
/// lens. In exact, each component is within 0.51 ulp of the true one.
Ray screenToRay(const Camera& camera, const Vec2& screen, Precision precision = Precision::exact,
                RayOrigin origin = RayOrigin::eye) noexcept;

enum class DepthStatus : std::uint8_t {
  point,
  infinity,   ///< the window depth of points infinitely far away: a direction, no point
  beyond,     ///< a depth that no point in front of the eye has; every depth, of a camera without near plane
  noRay,      ///< no point in front of the camera is seen there, through its lens
  notFinite,  ///< the input had a NaN or an infinity
};

struct WorldPoint {
  Vec3 position;  ///< NaN unless status is point
  DepthStatus status = DepthStatus::point;
  /// How far position can be from the true point, in world units, if the window depth given is the double nearest the
  /// true one; infinite where that double could also be the depth of infinity. What the arithmetic adds, half a unit in
  /// the last place of each coordinate, is included; of a point by its distance it is all.
  double bound = 0;
  /// Along the viewing axis, the double nearest that of the depth given; NaN unless status is point.
  double viewDistance = std::numeric_limits<double>::quiet_NaN();
};

/// How much of the world one pixel spans at a distance along the viewing axis, across and down, in world units: each
/// within 1 ulp of what the distance given makes it. In orthographic the same everywhere; NaN in perspective where the
/// distance is not above 0. Through a lens that of the pinhole.
Vec2 pixelSize(const Camera& camera, double viewDistance) noexcept;

/// The point at this screen position and window depth (not clamped), or distance along the viewing axis. In
/// double-double and rounded once; what the depth's own last digit is worth in distance is in WorldPoint's bound.
WorldPoint screenToWorld(const Camera& camera, const Vec2& screen, double depth) noexcept;
WorldPoint screenToWorldAtDistance(const Camera& camera, const Vec2& screen, double viewDistance) noexcept;

}  // namespace viewproj
