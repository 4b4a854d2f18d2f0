// Mistakes with a few numbers, found by least squares.
#pragma once

#include <vector>

#include "commands/check/hypothesis.hpp"

namespace viewproj::cmd::mistakes {

/// A camera, and pairs whose pixels are mended already.
struct Fit {
  PlainCamera camera;
  Rows world;   ///< its axes: x, y, z; or east, north, up on the Earth
  Vec3 up;      ///< of the world at the eye
  Vec2 corner;  ///< of the picture
  bool isOnEarth = false;
  std::vector<Pair> pairs;
};

enum class Table { simple, poses };  ///< poses: pan-tilt-zoom, pose and what has more parameters

/// wrong: how many of the pairs may be wrong; their weight goes to 0. Families that have more parameters than the pairs
/// determine are left out.
std::vector<Hypothesis> families(const Fit& fit, Table table, std::size_t wrong = 0);
std::size_t countOf(Table table);

}  // namespace viewproj::cmd::mistakes
