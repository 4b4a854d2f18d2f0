// A camera's place at the end of a chain of nodes, each with a transform of its own: glTF nodes, three.js objects.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "input/document.hpp"
#include "numbers/vectors.hpp"
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

/// What a chain of nodes makes of the coordinates of its last.
struct Chain {
  std::array<detail::DDVec3, 3> columns{detail::DDVec3{1, 0, 0}, detail::DDVec3{0, 1, 0}, detail::DDVec3{0, 0, 1}};
  detail::DDVec3 origin{};
  bool moves = false;  ///< any of them
};

/// The chain and one node more. Throws InputError.
Chain behind(const Chain& chain, const PlacedNode& node);

/// above: the chain to the camera's own node; nodes: all of it, for messages. See poseAtEndOf(nodes).
Pose poseAtEndOf(const Chain& above, const PlacedNode& own, const std::function<std::vector<PlacedNode>()>& nodes);

/// chain: from the outermost node to the camera's own. The camera looks along its -z with y up (right-handed); scales
/// do not count, as the glTF specification has it. Composed in double-double; a node that stands alone is exact. Throws
/// InputError where the scales of other nodes leave no right angles (by kPoseOrthogonality) or mirror the camera.
Pose poseAtEndOf(const std::vector<PlacedNode>& chain);

}  // namespace viewproj::cmd
