// Cameras in trees of nodes, such as glTF nodes and three.js objects. Each node has a transform relative to its parent.
#pragma once

#include <array>
#include <cstddef>
#include <unordered_map>
#include <vector>

#include "camera/document.hpp"
#include "numbers/vectors.hpp"

namespace viewproj::cmd {

/// A member that is a text, or an empty one.
std::string stringAt(const Node& object, std::string_view key);

/// A node has a "matrix" of 16 numbers by columns, or translation * rotation [x, y, z, w] * "scale".
class NodeTree {
 public:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  std::vector<Node> nodes;
  std::vector<std::size_t> parents;  ///< of each node; kNone at a root

  /// translation, rotation: the format's names for these members.
  NodeTree(std::string_view translation, std::string_view rotation) : translation_(translation), rotation_(rotation) {}

  /// Adds the pose of the camera at a node. It looks along the node's -z with y up. Its scale is ignored, as in the
  /// glTF specification. If no node above has a transform, the pose is position and rotation, unchanged. Otherwise it
  /// is worldFromCamera, composed in double-double and rounded once. Throws InputError for a mirror, a scale of 0, or a
  /// node inside itself.
  void addPose(Json& document, std::size_t node);

 private:
  /// A node's coordinates in the world.
  struct Frame {
    std::array<detail::DDVec3, 3> columns{detail::DDVec3{1, 0, 0}, detail::DDVec3{0, 1, 0}, detail::DDVec3{0, 0, 1}};
    detail::DDVec3 origin{};
    bool isMoved = false;
  };

  Frame frameIn(const Frame& parent, const Node& node, bool isCamera) const;
  Frame worldFrame(std::size_t node);

  std::string_view translation_, rotation_;
  std::unordered_map<std::size_t, Frame> frames_;  ///< of nodes with children, computed when needed
};

}  // namespace viewproj::cmd
