// Cameras in trees of nodes, each with a transform in its parent's coordinates: glTF nodes, three.js objects.
#pragma once

#include <array>
#include <cstddef>
#include <unordered_map>
#include <vector>

#include "camera/document.hpp"
#include "numbers/vectors.hpp"

namespace viewproj::cmd {

/// A node has a "matrix" of 16 numbers by columns, or translation * rotation [x, y, z, w] * "scale".
class NodeTree {
 public:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  std::vector<Node> nodes;
  std::vector<std::size_t> parents;  ///< of each node; kNone at a root

  /// The arguments: what the format calls them.
  NodeTree(std::string_view translation, std::string_view rotation) : translation_(translation), rotation_(rotation) {}

  /// Adds the pose of a camera at a node, which looks along its -z with y up. Scales do not count, as the glTF
  /// specification has it. A node in no moved one: position and rotation, as they are; else worldFromCamera, composed
  /// in double-double and rounded once. Throws InputError: a mirror, a scale of 0, a node inside itself.
  void addPose(Json& document, std::size_t node);

 private:
  /// What a node makes of its coordinates.
  struct Frame {
    std::array<detail::DDVec3, 3> columns{detail::DDVec3{1, 0, 0}, detail::DDVec3{0, 1, 0}, detail::DDVec3{0, 0, 1}};
    detail::DDVec3 origin{};
    bool isMoved = false;
  };

  Frame frameIn(const Frame& parent, const Node& node, bool isCamera) const;
  Frame worldFrame(std::size_t node);

  std::string_view translation_, rotation_;
  std::unordered_map<std::size_t, Frame> frames_;  ///< of nodes that have others in them, as far as asked for
};

}  // namespace viewproj::cmd
