// Changed copies of camera documents: another world, another place, another window, another convention. Each keeps the
// kind of pose and projection of the original if that can express the change.
#pragma once

#include <array>
#include <cstddef>

#include "camera/read_camera.hpp"

namespace viewproj::cmd {

/// A signed permutation of axes.
struct AxisMap {
  std::array<std::size_t, 3> from = {0, 1, 2};  ///< the old axes that the new x, y, z are
  std::array<int, 3> signs = {1, 1, 1};         ///< -1: in the opposite direction

  /// Whether it changes a right-handed world into a left-handed one.
  bool mirrors() const;
  friend bool operator==(const AxisMap&, const AxisMap&) = default;
};

/// A camera with the same picture of the mapped world, and lengths times scale > 0. Angles of the pose become a
/// rotation if the axes change, and a place on the Earth becomes x, y, z.
Document mapped(const CameraFile& camera, const AxisMap& map, double scale);

/// The same view from another position, with exactly the same axes. A target becomes a direction.
Document movedTo(const CameraFile& camera, const Vec3& eye);

/// For a perspective: multiplies the window's width and height by factor, about the viewing axis.
Document opened(const CameraFile& camera, double factor);

/// An orthographic camera with these edges. A crop becomes a viewport of its own.
Document withWindow(const CameraFile& camera, double left, double right, double bottom, double top);

/// The document in another convention. Defaults of the old preset are written out where the new one has others. The
/// convention must have the camera's world. Throws InputError for a ps2 projection if depth is not reversed.
Document inConvention(const CameraFile& camera, const ConventionPreset& preset, const Convention& convention);

}  // namespace viewproj::cmd
