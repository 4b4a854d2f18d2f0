// The outlines of shapes as a camera sees them: segments of the world, clipped before the division.
#pragma once

#include <string>
#include <vector>

#include "records/scene.hpp"
#include "viewproj/scene.hpp"

namespace viewproj::cmd {

struct Segment {
  Vec3 a, b;
};

struct Outline {
  std::string label;
  std::vector<VisibleSegment> pieces;  ///< those that are visible, in order along the outline
  bool isSegment = false;
  std::string fault;  ///< what of it is not drawn, and why
};

/// How far the chords of a round outline may lie within it, as a share of the picture's longer side: a tenth of a pixel
/// where the picture is 1600 wide.
inline constexpr double kChordShare = 6e-5;

Outline outlineOf(const Frustum& frustum, const Segment& segment);
/// Twelve edges, those behind the box as well.
Outline outlineOf(const Frustum& frustum, const Box& box);
Outline outlineOf(const Frustum& frustum, const Triangle& triangle);

// The silhouette: the circle in which the cone of rays from the eye (in orthographic the cylinder of rays) touches the
// sphere, drawn as chords; of an ellipsoid the same, in the space where it is a sphere. A surface that the near or far
// plane cuts has an edge there too, which is not drawn; an eye within it sees no silhouette.
Outline outlineOf(const Frustum& frustum, const Sphere& sphere);
Outline outlineOf(const Frustum& frustum, const Ellipsoid& ellipsoid);
/// As an ellipsoid, which leaves the surface by less than a line's width.
Outline outlineOf(const Frustum& frustum, const HeightSurface& surface);

}  // namespace viewproj::cmd
