// A camera's place at the end of a chain of nodes, each with a transform of its own: glTF nodes, three.js objects.
#pragma once

#include <optional>
#include <vector>

#include "input/document.hpp"
#include "viewproj/camera.hpp"

namespace viewproj::cmd {

/// A matrix, or else translation * rotation * scale.
struct PlacedNode {
  ObjectReader fields;  ///< for messages
  std::optional<Mat4> matrix;
  std::optional<Vec3> translation, scale;
  std::optional<Quaternion> rotation;  ///< normalised when used

  bool moves() const { return matrix || translation || scale || rotation; }
};

/// A matrix of 16 numbers by columns, last row 0 0 0 1; or nothing. Throws InputError.
std::optional<Mat4> readColumnMajor(const ObjectReader& fields, std::string_view key);

/// chain: from the outermost node to the camera's own. The camera looks along its -z with y up (right-handed); scales
/// do not count, as the glTF specification has it. Composed in double-double; a node that stands alone is exact. Throws
/// InputError where the scales of other nodes leave no right angles (by kPoseOrthogonality) or mirror the camera.
Pose poseAtEndOf(const std::vector<PlacedNode>& chain);

}  // namespace viewproj::cmd
