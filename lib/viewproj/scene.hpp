// Shapes in world coordinates: where a ray hits them, and what a camera sees of them.
//
// A component of its own: link viewproj::scene.
//
// Example:
//   const Viewport picture{.width = 640, .height = 480};
//   const Camera camera = makeCamera(lookAlong({0, 0, 5}, {0, 0, -1}, {0, 1, 0}, Handedness::right),
//                                    perspective(90, picture, 1, 100), picture);
//   const Sphere ball{{0, 0, 0}, 2};
//   const Hits hits = intersect(screenToRay(camera, {320, 240}), ball);
//   const bool isSeen = cull(viewFrustum(camera), ball).verdict != CullVerdict::outside;
//   std::printf("%d hits, at %g, seen %d", hits.count, hits.hits[0].distance, isSeen);  // prints 2 hits, at 3, seen 1
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "viewproj/screen.hpp"

namespace viewproj {

namespace detail {
struct FrustumParts;
}

/// The points p with normal . (p - point) = 0. The normal may have any length but 0.
struct Plane {
  Vec3 point, normal;
};

/// With radius 0, a point.
struct Sphere {
  Vec3 center;
  double radius = 0;
};

/// Axis-aligned, including its faces. It may be flat: a rectangle, a segment or a point.
struct Box {
  Vec3 min, max;
};

/// Including its edges and corners. A triangle without area is never hit.
struct Triangle {
  Vec3 a, b, c;
};

/// Rotated about z, centred at the origin.
struct Ellipsoid {
  double equatorial = 0, polar = 0;  ///< semi-axes
};

/// WGS84 in ECEF metres: a = 6378137 and b = a (1 - 1/298.257223563), the nearest double.
inline constexpr Ellipsoid kWgs84{6378137, 6356752.314245179};

// Whether a shape is valid: numbers up to 1e46 (kFarthestPoint) in magnitude, a normal that is not zero, radius >= 0,
// min <= max, semi-axes > 0. NaN is invalid. An invalid shape is hit by no ray and is outside every frustum.

bool isValid(const Plane& plane) noexcept;
bool isValid(const Sphere& sphere) noexcept;
bool isValid(const Box& box) noexcept;
bool isValid(const Triangle& triangle) noexcept;
bool isValid(const Ellipsoid& ellipsoid) noexcept;

// ---- Hits
//
// Whether and how often a ray hits is decided exactly for the given doubles, without an epsilon. Double-double with a
// running error bound decides nearly all cases; exact integers decide the rest.
//
// Sources: sphere and ellipsoid by Haines et al., "Precision improvements for ray/sphere intersection", Ray Tracing
// Gems 2019 (after Hearn & Baker; the discriminant from the distance of the centre to the ray, and Press's q for the
// nearer root); box by slabs, Kay & Kajiya 1986, with a zero direction set apart as Williams et al. 2005 and Ize 2013
// advise; triangle by the signs of three edges seen from the origin, as Woop, Benthin & Wald, "Watertight ray/triangle
// intersection", 2013, without the shear that rounds.

enum class BoxFace : std::uint8_t { none, minX, maxX, minY, maxY, minZ, maxZ };

struct Hit {
  /// Length from the ray's origin to the point, >= 0, in world units, even if the direction is not quite of unit
  /// length. 0 if the ray starts on the surface. Infinite beyond the largest double; then the point may be too.
  double distance = 0;
  Vec3 point;
  /// Unit length. Sphere, ellipsoid, box: outward, also where the ray leaves. Sphere of radius 0: opposite to the ray.
  /// Plane: as given. Triangle: (b - a) x (c - a), so a, b, c run counterclockwise seen from its tip in a right-handed
  /// world.
  Vec3 normal;
  BoxFace face = BoxFace::none;  ///< of a box; on an edge or a corner, the first of x, y, z that is crossed there
};

/// Nearest first.
struct Hits {
  std::array<Hit, 2> hits;
  int count = 0;

  const Hit* begin() const noexcept { return hits.data(); }
  const Hit* end() const noexcept { return hits.data() + count; }
};

/// The distance, and each coordinate of a point on a plane, triangle or box, is within this many ulps of the true value
/// (1 for subnormal numbers).
inline constexpr double kHitUlps = 0.51;
/// A coordinate of a point on a sphere or ellipsoid is within kHitUlps, or within this share of the largest semi-axis.
/// A component of a normal is within kHitUlps, or within this (for an ellipsoid times the ratio of its semi-axes).
inline constexpr double kHitShare = 0x1p-70;

/// Returns the hits at distance >= 0. A ray that starts on a surface hits it there; one that starts inside a solid hits
/// it once. A surface that is only touched (at a tangent, an edge or a corner) is hit once. There are no hits if the
/// shape is invalid (isValid), if a number of the ray is not finite or beyond 1e46, or if its direction is zero. A ray
/// within the plane, or a triangle's plane, does not hit. Both sides of a triangle count, and its edges belong to it:
/// no ray slips between two triangles with a common edge (a ray through that edge hits both).
Hits intersect(const Ray& ray, const Plane& plane) noexcept;
Hits intersect(const Ray& ray, const Sphere& sphere) noexcept;
Hits intersect(const Ray& ray, const Box& box) noexcept;
Hits intersect(const Ray& ray, const Triangle& triangle) noexcept;
Hits intersect(const Ray& ray, const Ellipsoid& ellipsoid) noexcept;

// ---- The frustum
//
// The part of the world that a camera sees, as planes, and tests of shapes against it. The planes come from the
// camera's parameters. They are the planes that Gribb & Hartmann, "Fast extraction of viewing frustum planes from the
// world-view-projection matrix", 2001, read from a matrix, without the digits that a matrix loses.

struct FrustumPlane {
  Side side = sideLeft;
  /// (a, b, c, d) as x, y, z, w, with (a, b, c) the inward unit normal: a x + b y + c z + d >= 0 inside. Each is within
  /// 0.51 ulp, or within kPlaneBound (1 + e) / |n|, of the true value. Here e is the larger of the two opposite window
  /// edges (0 for near and far, and in orthographic), and |n| the length of right - edge forward, from 1 to 1 + |edge|.
  /// For d that bound is multiplied by the size of its terms (near, far, orthographic edges, what rounding the eye
  /// left) plus |eye|_1. As doubles they give distances to half an ulp of d: 5e-10 m for an eye in ECEF.
  Vec4 equation;
};

/// Relative accuracy of the planes before they are rounded.
inline constexpr double kPlaneBound = 0x1p-94;

/// The part of space that a camera sees. Culling uses planes relative to the eye, because d of the world's equation
/// loses digits when the eye is far from the origin.
class Frustum {
 public:
  Frustum(const Frustum&) noexcept = default;
  Frustum& operator=(const Frustum&) noexcept = default;

  const Camera& camera() const noexcept;
  /// left, right, bottom, top, then near and far if they exist (far is finite).
  std::span<const FrustumPlane> planes() const noexcept;

 private:
  friend struct detail::Access;
  explicit Frustum(const detail::Shared<detail::FrustumParts>& parts) noexcept : parts_(parts) {}

  detail::Shared<detail::FrustumParts> parts_;
};

/// Accepts every camera without a lens: perspective, orthographic, off-centre, shifted or cropped, with negative near
/// in orthographic, with a pose matrix that is not quite orthogonal. Throws CameraError naming "distortion" for a
/// camera with a lens, because it bends straight edges.
Frustum viewFrustum(const Camera& camera);

inline constexpr double kCullBound = 0x1p-96;

enum class CullVerdict : std::uint8_t { inside, intersects, outside };

struct Cull {
  CullVerdict verdict = CullVerdict::outside;
  /// outside: the plane that the shape is farthest beyond. intersects: the plane that a part of it reaches farthest
  /// beyond. Planes that double arithmetic cannot tell apart count as equal. 0 if inside, and for invalid input, which
  /// is outside.
  std::uint8_t side = 0;
};

// A shape that touches a plane from inside is inside; one that touches it from outside intersects.
//
// `inside` and `outside` are always right, however large and far away a shape is: the exact rows decide what double
// leaves open. A point counts as on a plane if it is nearer than kCullBound (|X| + |edge W|), with X and
// W its distances along the camera's axes; for a sphere, the radius is added. `intersects` may be returned for a shape
// that is outside, near an edge or a corner of the frustum, if it is beyond no single plane. A visible shape is never
// outside. Source: Assarsson & Möller, "Optimized view frustum culling algorithms for bounding boxes", 2000.

/// A point is treated like a sphere of radius 0. worldToScreen instead judges its rounded pixel and distance, so it
/// allows half an ulp. A point behind the eye in perspective is beyond near; without a near plane it is beyond a side,
/// and the eye itself, on all four sides, is inside.
Cull cull(const Frustum& frustum, const Vec3& point) noexcept;
Cull cull(const Frustum& frustum, const Sphere& sphere) noexcept;
Cull cull(const Frustum& frustum, const Box& box) noexcept;
Cull cull(const Frustum& frustum, const Triangle& triangle) noexcept;

// ---- Rectangles on the screen

/// Screen positions of a rectangle's left, upper, right and lower edge. top is above bottom in the picture, so it is
/// the smaller number if the viewport's origin is topLeft.
struct ScreenBox {
  double left = 0, top = 0, right = 0, bottom = 0;
};

/// Error of each number, relative to itself and the size of the picture. It may be larger for a sphere whose surface is
/// nearer to the eye than 1e-9 of its radius.
inline constexpr double kScreenBoxBound = 0x1.1p-53;

/// The smallest box that holds the part of the shape in front of near or on it, even if outside of the picture or
/// beyond far. Nothing if no part is there, if the shape is invalid, or if without a near plane not all of it is in
/// front of the eye. Infinite beyond the largest double. Points within 2^-90 of near count as on it. A lens is ignored.
///
/// In perspective a sphere is seen as an ellipse between the lines through the eye that touch it. If near cuts the
/// sphere, the circle of the cut counts too. Source of the touching lines: Mara & McGuire, "2D polyhedral bounds of a
/// clipped, perspective-projected 3D sphere", 2013.
std::optional<ScreenBox> screenBox(const Camera& camera, const Sphere& sphere) noexcept;
std::optional<ScreenBox> screenBox(const Camera& camera, const Box& box) noexcept;
std::optional<ScreenBox> screenBox(const Camera& camera, const Triangle& triangle) noexcept;

// ---- Segments

struct SegmentEnd {
  double t = 0;  ///< a + t (b - a) is this end: 0 is a, 1 is b
  Vec2 screen;
  double depth = 0;         ///< window depth
  double viewDistance = 0;  ///< along the viewing axis
  std::uint8_t side = 0;    ///< the Side that cuts the segment here; 0 for an end of the segment itself
};

struct VisibleSegment {
  bool visible = false;
  SegmentEnd start, end;  ///< start.t <= end.t; default values if not visible
};

/// Error of the numbers at an end that a side cuts off: t is within this, relative to the size of the segment's
/// distances to the planes; screen and depth within this of the picture's size and the depth range.
inline constexpr double kSegmentBound = 0x1p-50;

/// Clips the segment against the planes before any division, so a segment through the eye plane is cut and not mirrored
/// (Liang & Barsky, "A new concept and method for line clipping", 1984, in homogeneous coordinates). A segment on a
/// boundary is visible. The segment's own ends have the numbers of worldToScreen. Not visible if a number is not
/// finite, or if the camera has no near plane.
VisibleSegment clipSegment(const Frustum& frustum, const Vec3& a, const Vec3& b) noexcept;

/// a + t (b - a), rounded once.
Vec3 pointAlong(const Vec3& a, const Vec3& b, double t) noexcept;

}  // namespace viewproj
