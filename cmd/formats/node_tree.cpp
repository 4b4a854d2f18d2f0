#include "formats/node_tree.hpp"

#include <nlohmann/json.hpp>

#include "camera/rigid.hpp"

namespace viewproj::cmd {

using namespace detail;

namespace {

Quaternion quaternionIn(const Node& value) { return std::get<Quaternion>(readValue(value, *findField("rotation"))); }

}  // namespace

std::string stringAt(const Node& object, std::string_view key) {
  const auto text = object.find(key);
  return text && text->json().is_string() ? text->text() : "";
}

NodeTree::Frame NodeTree::frameIn(const Frame& parent, const Node& node, bool isCamera) const {
  Frame frame;
  frame.isMoved = parent.isMoved || node.findAny({"matrix", translation_, rotation_, "scale"});
  if (const auto matrix = node.find("matrix")) {
    const std::vector<double> m = matrix->numbers(16);
    if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1)
      matrix->fail("has a last row (numbers 4, 8, 12, 16) other than 0 0 0 1; the translation is numbers 13 to 15");
    for (std::size_t j = 0; j < 3; ++j) frame.columns[j] = {m[4 * j], m[4 * j + 1], m[4 * j + 2]};
    frame.origin = {m[12], m[13], m[14]};
  } else {
    if (const auto turn = node.find(rotation_)) frame.columns = rotationColumns(quaternionIn(*turn));
    if (const auto scale = isCamera ? std::nullopt : node.find("scale"))
      for (std::size_t j = 0; j < 3; ++j) frame.columns[j] = frame.columns[j] * scale->vec3()[j];
    if (const auto move = node.find(translation_)) frame.origin = toDoubleDouble(move->vec3());
  }
  const auto inWorld = [&](const DDVec3& v) {
    return parent.columns[0] * v.x + parent.columns[1] * v.y + parent.columns[2] * v.z;
  };
  for (DDVec3& column : frame.columns) column = inWorld(column);
  frame.origin = inWorld(frame.origin) + parent.origin;
  return frame;
}

NodeTree::Frame NodeTree::worldFrame(std::size_t node) {
  std::vector<std::size_t> path;  // up to a node with a known frame
  for (; node != kNone && !frames_.contains(node); node = parents[node]) {
    path.push_back(node);
    if (path.size() > nodes.size()) nodes[node].fail("is among its own descendants");
  }
  Frame frame = node == kNone ? Frame() : frames_[node];
  for (auto at = path.rbegin(); at != path.rend(); ++at) frames_[*at] = frame = frameIn(frame, nodes[*at], false);
  return frame;
}

void NodeTree::addPose(Json& document, std::size_t at) {
  const Node& node = nodes[at];
  if (const auto scale = node.find("scale")) (void)scale->vec3();
  const Frame parent = worldFrame(parents[at]);
  if (!parent.isMoved && !node.find("matrix")) {
    const auto move = node.find(translation_), turn = node.find(rotation_);
    document["position"] = move ? move->numbers(3) : std::vector<double>{0, 0, 0};
    document["rotation"] = turn ? turn->numbers(4) : std::vector<double>{0, 0, 0, 1};
    return;
  }
  Frame world = frameIn(parent, node, true);
  Mat4 pose{{{{}, {}, {}, {0, 0, 0, 1}}}};
  for (std::size_t j = 0; j < 3; ++j) {
    if (maxAbs(world.columns[j]) == 0) node.fail("has a scale of 0 in its matrix or in a node above it");
    world.columns[j] = normalized(world.columns[j]);
    for (std::size_t i = 0; i < 3; ++i) pose[i][j] = rounded(world.columns[j][i]);
  }
  if (dot(cross(world.columns[0], world.columns[1]), world.columns[2]).hi < 0)
    node.fail("is mirrored, by a negative scale in its matrix or in a node above it");
  for (std::size_t i = 0; i < 3; ++i) pose[i][3] = rounded(world.origin[i]);
  document["worldFromCamera"] = pose.m;
}

}  // namespace viewproj::cmd
