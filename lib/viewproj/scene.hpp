// The shapes of a scene, in world coordinates: what a ray hits, and what a camera sees of them.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>

#include "viewproj/screen.hpp"

namespace viewproj {

namespace detail {
struct FrustumParts;
}

/// All points p with normal . (p - point) = 0. The normal need not be of unit length.
struct Plane {
  Vec3 point, normal;
};

/// A radius of 0 is a point.
struct Sphere {
  Vec3 center;
  double radius = 0;
};

/// Axis-aligned, its faces included. May be flat: a rectangle, a segment or a point.
struct Box {
  Vec3 min, max;
};

/// Its edges and corners included. One of no area is hit by no ray.
struct Triangle {
  Vec3 a, b, c;
};

/// Of revolution about z, centred at the origin.
struct Ellipsoid {
  double equatorial = 0, polar = 0;  ///< semi-axes
};

/// WGS84 in ECEF metres: a = 6378137 and b = a (1 - 1/298.257223563), the nearest double.
inline constexpr Ellipsoid kWgs84{6378137, 6356752.314245179};

// Whether a shape is one: numbers up to 1e91 (kFarthestPoint) in magnitude, a normal that is not zero, radius >= 0, min
// <= max, semi-axes > 0. Shapes that are not valid are hit by no ray and are outside of every frustum. Written so that
// NaN fails.

bool isValid(const Plane& plane) noexcept;
bool isValid(const Sphere& sphere) noexcept;
bool isValid(const Box& box) noexcept;
bool isValid(const Triangle& triangle) noexcept;
bool isValid(const Ellipsoid& ellipsoid) noexcept;

// ---- Hits
//
// The verdict, hit or miss and how many hits, is that of exact arithmetic on the given doubles: no epsilon decides
// anything. Double-double with a running error bound decides nearly all; what it cannot certify is done again in exact
// integers.
//
// Sources: sphere and ellipsoid by Haines et al., "Precision improvements for ray/sphere intersection", Ray Tracing
// Gems 2019 (after Hearn & Baker; the discriminant from the distance of the centre to the ray, and Press's q for the
// nearer root); box by slabs, Kay & Kajiya 1986, with a zero direction set apart as Williams et al. 2005 and Ize 2013
// advise; triangle by the signs of three edges seen from the origin, as Woop, Benthin & Wald, "Watertight ray/triangle
// intersection", 2013, without the shear that rounds.

enum class BoxFace : std::uint8_t { none, minX, maxX, minY, maxY, minZ, maxZ };

struct Hit {
  /// Length from the ray's origin to the point, >= 0, in world units even where the direction is not quite of unit
  /// length. 0 where the ray starts on the surface. Infinite beyond the largest double, and so may the point be.
  double distance = 0;
  Vec3 point;
  /// Of unit length. Sphere, ellipsoid, box: outward, also where the ray leaves. Plane: as given. Triangle: (b - a) x
  /// (c - a), so a, b, c run counterclockwise seen from its tip in a right-handed world. Sphere of radius 0: against
  /// the ray.
  Vec3 normal;
  BoxFace face = BoxFace::none;  ///< of a box; on an edge or a corner the first of x, y, z that the ray crosses there
};

/// Nearest first.
struct Hits {
  std::array<Hit, 2> hits;
  int count = 0;

  const Hit* begin() const noexcept { return hits.data(); }
  const Hit* end() const noexcept { return hits.data() + count; }
};

/// The distance, and each coordinate of a point on a plane, triangle or box, is within this many units in the last
/// place of the true one (1 for subnormal numbers).
inline constexpr double kHitUlps = 0.51;
/// So is each coordinate of a point on a sphere or ellipsoid, or within this share of its largest semi-axis; and each
/// component of a normal, or within this (for an ellipsoid times the ratio of its semi-axes).
inline constexpr double kHitShare = 0x1p-70;

/// Hits at a distance >= 0 count: a ray that starts on a surface hits it there, and one that starts inside a solid hits
/// it once. A surface that is only touched, at a tangent, an edge or a corner, is hit once. No hits where the shape is
/// not valid (isValid), where a number of the ray is not one up to 1e91, or where its direction is zero. A ray within
/// the plane, or that of the triangle, does not hit it. Of a triangle both sides count, and edges are its own: no ray
/// slips between two that share one (a ray that meets it hits both).
Hits intersect(const Ray& ray, const Plane& plane) noexcept;
Hits intersect(const Ray& ray, const Sphere& sphere) noexcept;
Hits intersect(const Ray& ray, const Box& box) noexcept;
Hits intersect(const Ray& ray, const Triangle& triangle) noexcept;
Hits intersect(const Ray& ray, const Ellipsoid& ellipsoid) noexcept;

// ---- The frustum
//
// What part of the world a camera sees, as planes; and whether a shape lies in it. The planes come from the camera's
// parameters. They are those that Gribb & Hartmann, "Fast extraction of viewing frustum planes from the
// world-view-projection matrix", 2001, read from a matrix, without the digits that a matrix loses.

struct FrustumPlane {
  Side side = sideLeft;
  /// (a, b, c, d) as x, y, z, w, with (a, b, c) the inward unit normal: a x + b y + c z + d >= 0 inside. Each is within
  /// 0.51 ulp of the true one, or within kPlaneBound times (1 + e) / |n|, where e is the larger of the two window edges
  /// across from each other (0 for near and far, and in orthographic) and |n| the length of right - edge forward,
  /// between 1 and 1 + |edge|; d within that times what the offset is made of (near, far, orthographic edges, what
  /// rounding the eye left) and |eye|_1 more. As doubles they give distances to half an ulp of d: 5e-10 m for an eye in
  /// ECEF.
  Vec4 equation;
};

/// The planes as they are known to a share of their length.
inline constexpr double kPlaneBound = 0x1p-94;

/// What a camera sees. Culling never forms the world's equation, whose d loses digits with the distance of the eye from
/// the origin.
class Frustum {
 public:
  Frustum(const Frustum&) noexcept = default;
  Frustum& operator=(const Frustum&) noexcept = default;

  const Camera& camera() const noexcept;
  /// left, right, bottom, top, near unless there is none, and far unless it is infinite.
  std::span<const FrustumPlane> planes() const noexcept;

 private:
  friend struct detail::Access;
  explicit Frustum(std::shared_ptr<const detail::FrustumParts> parts) noexcept : parts_(std::move(parts)) {}

  std::shared_ptr<const detail::FrustumParts> parts_;
};

/// For every camera that makeCamera gives: perspective and orthographic, off-centre, shifted or cropped, near negative
/// in orthographic, a pose matrix that is not quite orthogonal. Throws CameraError naming "distortion" for a camera
/// with a lens, which bends what lies between the planes.
Frustum viewFrustum(const Camera& camera);

inline constexpr double kCullBound = 0x1p-96;

enum class CullVerdict : std::uint8_t { inside, intersects, outside };

struct Cull {
  CullVerdict verdict = CullVerdict::outside;
  /// outside: the plane it lies farthest beyond. intersects: the plane of those it straddles that it reaches farthest
  /// beyond. 0 if inside, and for input that is not valid, which is outside.
  std::uint8_t side = 0;
};

// What touches a plane from within is inside, what touches it from without intersects.
//
// `inside` and `outside` are always right, however large and far aside a shape is: what double-double leaves open is
// decided by the exact rows. What is nearer to a plane than kCullBound of |X| + |edge W|, the distances along the
// camera's axes of its point there, counts as on it; of a sphere, of its radius too. `intersects` may be said of a
// shape that is outside, near an edge or a corner of the frustum, where it lies beyond no single plane; nothing that is
// seen is ever lost. Source: Assarsson & Möller, "Optimized view frustum culling algorithms for bounding boxes", 2000.

/// inside or outside, as a sphere of radius 0 there is inside or not. worldToScreen judges the pixel and the distance
/// that it gives out instead, and so forgives half an ulp of them. A point behind the eye of a perspective is beyond
/// near, or without near beyond a side; the eye itself, on all four sides, is inside then.
Cull cull(const Frustum& frustum, const Vec3& point) noexcept;
Cull cull(const Frustum& frustum, const Sphere& sphere) noexcept;
Cull cull(const Frustum& frustum, const Box& box) noexcept;
Cull cull(const Frustum& frustum, const Triangle& triangle) noexcept;

// ---- Segments

struct SegmentEnd {
  double t = 0;  ///< a + t (b - a) is this end: 0 is a, 1 is b
  Vec2 screen;
  double depth = 0;         ///< window depth
  double viewDistance = 0;  ///< along the viewing axis
  std::uint8_t side = 0;    ///< the Side that cuts it off here, on whose boundary it lies; 0: the segment's own end
};

struct VisibleSegment {
  bool visible = false;
  SegmentEnd start, end;  ///< start.t <= end.t; as they are made if not visible
};

/// Numbers of an end that a side cuts off: t is within this of the true one, relative to the size of the segment's
/// distances to the planes, and screen and depth within it of the picture's size and the depth range.
inline constexpr double kSegmentBound = 0x1p-50;

/// Clipped against the planes before any division (Liang & Barsky, "A new concept and method for line clipping", 1984,
/// in homogeneous coordinates), so that a segment through the eye plane is cut and not mirrored. A segment that lies on
/// a boundary is visible. Its own ends have the numbers of worldToScreen. Input that is not finite is not visible, and
/// nothing is without a near plane, which cutting needs.
VisibleSegment clipSegment(const Frustum& frustum, const Vec3& a, const Vec3& b) noexcept;

/// t of the segment's point that is seen nearest the pixel. In perspective equal steps on the screen are not equal
/// steps along the segment: 1 / viewDistance is what is linear on the screen. NaN if the segment is not visible.
double parameterUnder(const Frustum& frustum, const VisibleSegment& segment, const Vec2& pixel) noexcept;

/// a + t (b - a), rounded once.
Vec3 pointAlong(const Vec3& a, const Vec3& b, double t) noexcept;

}  // namespace viewproj
