// Where a ray meets a shape.
//
// The verdict, hit or miss and how many hits, is that of exact arithmetic on the given doubles, whatever their
// magnitudes: no epsilon decides anything. Double-double with a running error bound decides nearly all; what it cannot
// certify is done again in exact integers. The ray's direction counts as the exact direction, rounded as it may be.
//
// Sources: sphere and ellipsoid by Haines et al., "Precision improvements for ray/sphere intersection", Ray Tracing
// Gems 2019 (after Hearn & Baker; the discriminant from the distance of the centre to the ray, and Press's q for the
// nearer root); box by slabs, Kay & Kajiya 1986, with a zero direction set apart as Williams et al. 2005 and Ize 2013
// advise; triangle by the signs of three edges seen from the origin, as Woop, Benthin & Wald, "Watertight ray/triangle
// intersection", 2013, without the shear that rounds.
#pragma once

#include <array>
#include <cstdint>

#include "projection/ray.hpp"
#include "scene/shapes.hpp"

namespace viewproj {

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

// Hits at a distance >= 0 count: a ray that starts on a surface hits it there, and one that starts inside a solid hits
// it once. A surface that is only touched, at a tangent, an edge or a corner, is hit once. No hits where the shape is
// not valid (shapes.hpp), where the ray is not finite, or where its direction is zero.

/// A ray within or parallel to the plane does not hit it.
Hits intersect(const Ray& ray, const Plane& plane) noexcept;

Hits intersect(const Ray& ray, const Sphere& sphere) noexcept;

/// A ray along a face, edge or through a corner hits: the box is closed.
Hits intersect(const Ray& ray, const Box& box) noexcept;

/// Both sides count, and so do edges and corners: no ray slips between two triangles that share an edge (one that meets
/// it hits both). A ray in the triangle's plane does not hit it, nor does any a triangle of no area.
Hits intersect(const Ray& ray, const Triangle& triangle) noexcept;

Hits intersect(const Ray& ray, const Ellipsoid& ellipsoid) noexcept;

}  // namespace viewproj
