// World to screen and back: points, pixels and rays, one or many at a time, and their error bounds.
//
// Screen positions are pixels in the viewport's origin and pixelCenter. Window depth uses depthFirst and depthSecond
// and is not clamped. Nothing here allocates or throws.
//
// Example:
//   const Viewport picture{.width = 640, .height = 480};
//   const Camera camera = makeCamera(lookAlong({0, 0, 5}, {0, 0, -1}, {0, 1, 0}, Handedness::right),
//                                    perspective(90, picture, 1, 100), picture);
//   const ScreenPoint seen = worldToScreen(camera, Vec3{1, 0, 0});
//   const Ray ray = screenToRay(camera, {320, 240});
//   std::printf("%g %g, ray to %g", seen.x, seen.y, ray.direction.z);  // prints 368 240, ray to -1
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "viewproj/camera.hpp"

namespace viewproj {

/// The arithmetic that a result is computed in.
enum class Precision {
  standard,  ///< double, with coordinates relative to the eye; through a lens the same as exact
  exact,     ///< the double nearest the true value
};

/// Where a point or a direction lies, seen from the camera.
enum class PointStatus : std::uint8_t {
  inFront,     ///< has a screen position, which is infinite beyond the largest double
  behind,      ///< perspective: on or behind the plane through the eye, and no lens sees it; no screen position
  atInfinity,  ///< orthographic: a direction, which has no finite screen position
  beyondLens,  ///< in front, but the camera's lens does not see it; no screen position
  outOfRange,  ///< not finite, farther than kFarthestPoint from the eye, or 0 0 0 0
};

/// For a point, |x - eye.x| + |y - eye.y| + |z - eye.z| must be below this; for a direction, |x| + |y| + |z|. Small
/// coordinates lose nothing, but a distance below 1e-307 has fewer digits. |w| is 0, or between 1e-45 and 1e45.
inline constexpr double kFarthestPoint = 1e46;

/// Whether worldToScreen accepts a point: false where its status would be outOfRange.
bool isInRange(const Camera& camera, const Vec4& point) noexcept;

/// The sides of the view that a point may be beyond. They have the same names in every convention.
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
  double depth = 0;         ///< window depth, not clamped; NaN without a near plane, or not in front
  double viewDistance = 0;  ///< along the viewing axis; NaN for a direction
  PointStatus status = PointStatus::inFront;
  std::uint8_t outside = 0;  ///< the Sides that the point is beyond, 0 unless it is inFront; a boundary is inside
  /// exact: x, y, depth and viewDistance are proven to be the doubles nearest the true values. If false, one of them is
  /// a tie or cancels to about 0, and is within kExactUlps or kExactAbsolute.
  bool certain = false;
  /// The arithmetic that was used: exact if standard could not bound the point. Use it for boundOfPoint.
  Precision precision = Precision::exact;

  bool visible() const noexcept { return status == PointStatus::inFront && outside == 0; }
  friend constexpr bool operator==(const ScreenPoint&, const ScreenPoint&) = default;
};

/// The sides of the picture that a screen position is beyond.
std::uint8_t sidesBeyond(const Camera& camera, const Vec2& screen) noexcept;

/// Projects a point. The error is at most ErrorBound of the precision; points that standard cannot bound are projected
/// exactly. A Vec4 is the point (x/w, y/w, z/w), for negative w too, or with w = 0 a direction, whose vanishing point
/// is returned. Weights other than 1 are always projected exactly.
ScreenPoint worldToScreen(const Camera& camera, const Vec3& point, Precision precision = Precision::exact) noexcept;
ScreenPoint worldToScreen(const Camera& camera, const Vec4& point, Precision precision = Precision::exact) noexcept;

// ---- Many points or pixels at a time

/// Counts of the points of a batch.
struct BatchCounts {
  /// Points computed one by one: out of the kernel's range, next to the eye plane or a lens's limit, or not certain.
  std::size_t escalated = 0;
  std::size_t uncertain = 0;  ///< exact: those that stay uncertain (ties, numbers about 0)
};

/// Points in memory as other libraries have them: three doubles or floats each, `stride` bytes from one to the next.
/// Floats count as exact.
struct Points {
  const void* first = nullptr;
  std::size_t count = 0;
  std::size_t stride = sizeof(Vec3);
  bool areFloats = false;

  Points(std::span<const Vec3> points) noexcept : first(points.data()), count(points.size()) {}  // NOLINT: as they are
  Points(const double* xyz, std::size_t n, std::size_t bytes = 3 * sizeof(double)) noexcept
      : first(xyz), count(n), stride(bytes) {}
  Points(const float* xyz, std::size_t n, std::size_t bytes = 3 * sizeof(float)) noexcept
      : first(xyz), count(n), stride(bytes), areFloats(true) {}
};

/// Screen x, screen y and window depth of each point: bit for bit the numbers of worldToScreen for single points, on
/// every processor. Both have the same size; of two sizes the smaller counts. They may be the same memory if the points
/// are a span; else they are disjoint.
BatchCounts worldToScreen(const Camera& camera, std::span<const Vec3> points, std::span<Vec3> screen,
                          Precision precision = Precision::exact) noexcept;
BatchCounts worldToScreen(const Camera& camera, const Points& points, std::span<Vec3> screen,
                          Precision precision = Precision::exact) noexcept;

/// The same with all fields of ScreenPoint. Takes about twice as long.
BatchCounts worldToScreen(const Camera& camera, std::span<const Vec3> points, std::span<ScreenPoint> screen,
                          Precision precision = Precision::exact) noexcept;
BatchCounts worldToScreen(const Camera& camera, const Points& points, std::span<ScreenPoint> screen,
                          Precision precision = Precision::exact) noexcept;

/// The unit directions of rays through screen positions, within kRayDirectionBound of the true ones. NaN where
/// screenToRay's is.
void screenToRayDirections(const Camera& camera, std::span<const Vec2> pixels, std::span<Vec3> directions) noexcept;

// ---- How wrong

/// exact: error in ulps of x, y, depth and viewDistance. A result that cancels to about zero has an absolute error
/// instead: 1e-26 of the viewport's size, or of the whole picture's if the window was cropped or shifted from far off
/// the axis.
inline constexpr double kExactUlps = 0.51;
inline constexpr double kExactAbsolute = 1e-26;

/// exact, for a window depth that is not certain: the relative error of the distance, which makes an error of this
/// share of depthScale / W (perspective) or depthScale W (orthographic). It exceeds kExactAbsolute only if far/near - 1
/// is below 2e-3.
inline constexpr double kExactDistance = 0x1p-96;

/// The largest error of screen x and y, in pixels, and of window depth. Infinite if there is no bound.
struct ErrorBound {
  double screen = 0;
  double depth = 0;
};

/// Bound for every point whose true pixel lies in the picture (in orthographic, between near and far). The depth's
/// bound also needs a depth between near and far.
ErrorBound boundInPicture(const Camera& camera, Precision precision) noexcept;

/// Bound for one point, wherever it lies, in the precision that worldToScreen uses for it. Unlike boundInPicture, which
/// is the arithmetic's, it includes the error of the camera's pose (Pose::error) and of the point itself: pointError is
/// how far it may be from the true one in the world, such as placeError().
ErrorBound boundOfPoint(const Camera& camera, const Vec3& point, Precision precision, double pointError = 0) noexcept;
ErrorBound boundOfPoint(const Camera& camera, const Vec4& point, Precision precision, double pointError = 0) noexcept;

// ---- Back to the world

/// direction has unit length.
struct Ray {
  Vec3 origin, direction;
  friend constexpr bool operator==(const Ray&, const Ray&) = default;
};

enum class RayOrigin {
  eye,        ///< on the plane through the eye: the eye itself in perspective, one point per pixel in orthographic
  nearPlane,  ///< the eye if there is no near plane; NaN for a ray that points backwards
};

/// Largest angle in radians between a ray's direction and the true one, for pixels of the picture,
/// for every near and far and through every lens. It is five roundings a component, (5 sqrt(3) + 1) 2^-53, plus the
/// effect of a pose matrix that is not quite orthogonal.
inline constexpr double kRayDirectionBound = 1.2e-15;

/// The ray of points that project to this screen position. NaN for a pixel that is not finite or beyond kFarthestPoint,
/// or that has no point through the lens. Through a lens it may point backwards.
Ray screenToRay(const Camera& camera, const Vec2& screen, RayOrigin origin = RayOrigin::eye) noexcept;

/// The rays of many pixels, with their origins, as screenToRay makes them.
void screenToRays(const Camera& camera, std::span<const Vec2> pixels, std::span<Ray> rays,
                  RayOrigin origin = RayOrigin::eye) noexcept;

enum class DepthStatus : std::uint8_t {
  point,
  infinity,   ///< the window depth of infinitely distant points: a direction, not a point
  beyond,     ///< the ray has no point of this depth or distance; no depth has one if there is no near plane
  noRay,      ///< the lens shows nothing there
  notFinite,  ///< the input had a NaN or an infinity, or a pixel beyond kFarthestPoint
};

struct WorldPoint {
  Vec3 position;  ///< NaN unless status is point
  DepthStatus status = DepthStatus::point;
  /// How far position can be from the true point, in world units, if the given window depth is the double nearest the
  /// true one, or within depthError of that. Infinite if it could also be the depth of infinity. Includes the
  /// arithmetic's error, half an ulp of each coordinate, and the pose's error; for a point by its distance, that is all
  /// of it.
  double bound = 0;
  /// The double nearest to the distance along the viewing axis at the given depth. NaN unless status is point.
  double viewDistance = std::numeric_limits<double>::quiet_NaN();
};

/// Size of one pixel in the world at a distance along the viewing axis, across and down, in world units. Each is within
/// 1 ulp for the given distance. In orthographic the same at every distance; in perspective NaN if the distance is not
/// above 0. A lens is ignored.
Vec2 pixelSize(const Camera& camera, double viewDistance) noexcept;

/// The point at this screen position and window depth (not clamped), or distance along the viewing axis. Computed in
/// double-double and rounded once; WorldPoint's bound includes the effect of the depth's last digit, and of depthError:
/// how far a depth may be from the double nearest the true one. Of a depth buffer of floats it is half the distance to
/// the next float, (std::nextafter(depth, 2.0f) - depth) / 2.
WorldPoint screenToWorld(const Camera& camera, const Vec2& screen, double depth, double depthError = 0) noexcept;
WorldPoint screenToWorldAtDistance(const Camera& camera, const Vec2& screen, double viewDistance) noexcept;

}  // namespace viewproj
