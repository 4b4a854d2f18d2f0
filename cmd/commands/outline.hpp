// The outline of what a picture shows of the ground.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "picture/ground.hpp"

namespace viewproj::cmd {

struct OutlineVertex {
  Vec3 point;
  Vec2 place;
  std::optional<Vec2> pixel;  ///< nothing on a cut
};

struct OutlineRing {
  std::vector<OutlineVertex> vertices;  ///< clockwise as the camera sees it
  double area = 0;
  bool isHole = false;
};

/// Metres between the middles of a pixel's left and right side, and of its upper and lower side.
using GroundSampling = std::optional<std::array<double, 2>>;

struct Outline {
  std::vector<OutlineRing> rings;
  std::vector<std::string> cut;
  double area = 0, error = 0;
  std::optional<Ground::Seen> center;
  GroundSampling gsd;
  std::array<GroundSampling, 4> cornerGsd;  ///< top left, top right, bottom right, bottom left
};

/// error: how far the boundary may be from the straight line on the map between two vertices; 0: a thousandth of the
/// outline's extent. Throws InputError where the picture reaches the horizon of a plane, and beyond a million vertices.
Outline outlineOf(const Camera& camera, const Ground& ground, double most, double error);

/// Where the ground's horizon enters a perspective picture, is half-way through it by azimuth, and leaves it, by
/// growing azimuth. Of several parts the widest. One that is all in the picture enters and leaves it behind the
/// camera's heading, in radians. Nothing if it is not in the picture.
std::array<std::optional<Vec2>, 3> horizonPixels(const Camera& camera, const Ground& ground, double heading);

}  // namespace viewproj::cmd
