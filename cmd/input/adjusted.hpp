// A camera's parts with one number changed, and nothing else.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "viewproj/camera.hpp"

namespace viewproj::cmd {

/// The same turn elsewhere.
Pose movedTo(const Pose& pose, const Vec3& eye, Handedness world);

/// Another world, whose axes are each one of this world's or against it.
struct WorldMap {
  std::array<std::size_t, 3> from = {0, 1, 2};  ///< which of this world's axes the new x, y, z are
  std::array<int, 3> signs = {1, 1, 1};         ///< -1: against it

  /// Whether it turns a right-handed world into a left-handed one.
  bool mirrors() const;
};

/// What shows the same picture of the world so mapped, with lengths times scale > 0.
Pose mappedTo(const Pose& pose, const WorldMap& map, double scale, Handedness newWorld);
Projection scaledBy(const Projection& projection, double scale);

/// The same window with the ends that are given.
Projection withRange(const Projection& projection, std::optional<double> near, std::optional<double> far);

/// Whether the view goes through the middle of the picture.
bool isCentred(const Projection& projection);

/// The same height with another width, of one that is centred.
Projection withAspect(const Projection& projection, double aspect);

}  // namespace viewproj::cmd
