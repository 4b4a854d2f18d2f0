#include "input/placement.hpp"

#include <algorithm>

#include "camera/camera.hpp"
#include "input/importers/importer.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

/// Scales of which the largest is at most this much above the smallest count as one.
constexpr double kUniform = 1e-9;

constexpr CameraAxes kAxes = CameraAxes::RUB;

Pose ownPose(const PlacedNode& node) {
  return located(node.fields, {{"position", "translation"}, {"rotation", "rotation"}}, [&] {
    return poseFromRotation(node.translation.value_or(Vec3{}), node.rotation.value_or(Quaternion{}), kAxes,
                            Handedness::right);
  });
}

Chain affineOf(const PlacedNode& node) {
  Chain a;
  if (node.matrix) {
    const Mat4& m = *node.matrix;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) a.columns[j][i] = m[i][j];
    a.origin = {m[0][3], m[1][3], m[2][3]};
    return a;
  }
  const Pose pose = ownPose(node);
  const Vec3 scale = node.scale.value_or(Vec3{1, 1, 1});
  a.columns = {parts(pose).columns.right * scale.x, parts(pose).columns.up * scale.y,
               -parts(pose).columns.forward * scale.z};
  a.origin = toDoubleDouble(pose.eye());
  return a;
}

struct Lengths {
  double least, most;
};

/// Of the columns.
Lengths lengthsOf(const Chain& a) {
  double lengths[3];
  for (std::size_t j = 0; j < 3; ++j) lengths[j] = sqrt(dot(a.columns[j], a.columns[j])).hi;
  return {*std::min_element(std::begin(lengths), std::end(lengths)),
          *std::max_element(std::begin(lengths), std::end(lengths))};
}

/// The first node that has what is looked for, or else the camera's own.
template <class Condition>
const PlacedNode& firstNode(const std::vector<PlacedNode>& chain, Condition condition) {
  for (const PlacedNode& node : chain)
    if (condition(affineOf(node))) return node;
  return chain.back();
}

bool mirrors(const Chain& a) { return dot(cross(a.columns[0], a.columns[1]), a.columns[2]).hi < 0; }

}  // namespace

std::optional<Mat4> readColumnMajor(const ObjectReader& fields, std::string_view key) {
  const auto flat = fields.numbers(key, 16, 16);
  if (!flat) return std::nullopt;
  Mat4 m;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) m[i][j] = (*flat)[4 * j + i];
  if (m[3] != std::array<double, 4>{0, 0, 0, 1}) {
    const bool looksTransposed = m[0][3] == 0 && m[1][3] == 0 && m[2][3] == 0 && m[3][3] == 1;
    fields.fail(key, std::string("has a last row that is not 0 0 0 1") +
                         (looksTransposed ? "; it is by columns: the translation is numbers 13 to 15" : ""));
  }
  return m;
}

Chain behind(const Chain& chain, const PlacedNode& node) {
  const auto turned = [&](const DDVec3& v) {
    return chain.columns[0] * v.x + chain.columns[1] * v.y + chain.columns[2] * v.z;
  };
  const Chain local = affineOf(node);
  Chain next;
  for (std::size_t j = 0; j < 3; ++j) next.columns[j] = turned(local.columns[j]);
  next.origin = turned(local.origin) + chain.origin;
  next.moves = chain.moves || node.moves();
  return next;
}

Pose poseAtEndOf(const std::vector<PlacedNode>& nodes) {
  Chain above;
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) above = behind(above, nodes[i]);
  return poseAtEndOf(above, nodes.back(), [&] { return nodes; });
}

Pose poseAtEndOf(const Chain& above, const PlacedNode& own, const std::function<std::vector<PlacedNode>()>& nodes) {
  if (!above.moves && !own.matrix) return ownPose(own);

  PlacedNode unscaled = own;
  unscaled.scale.reset();
  Chain world = behind(above, unscaled);
  if (mirrors(world))
    firstNode(nodes(), mirrors)
        .fields.fail("mirrors the camera (a negative scale), which leaves open which way its picture lies");
  for (DDVec3& column : world.columns) {
    if (maxAbs(column) == 0)
      firstNode(nodes(), [](const Chain& a) {
        return lengthsOf(a).least == 0;
      }).fields.fail("has a scale of 0: no camera can stand in it");
    column = normalized(column);
  }
  try {
    return poseFromColumns(world.columns, world.origin, kAxes, Handedness::right);
  } catch (const CameraError& e) {
    if (e.field() != "columns" || e.message().find(": ") == std::string::npos)
      own.fields.fail("stands where no double reaches");
    const std::vector<PlacedNode> chain = nodes();
    const PlacedNode& uneven = firstNode(chain, [](const Chain& a) {
      const Lengths lengths = lengthsOf(a);
      return !(lengths.most - lengths.least <= kUniform * lengths.most);
    });
    const std::string how = &uneven == &chain.back()
                                ? "has a matrix that shears the camera"
                                : "scales its axes differently, which with a turn below it shears the camera";
    uneven.fields.fail(how + e.message().substr(e.message().find(": ")));
  }
}

}  // namespace viewproj::cmd
