// A view and a projection matrix in a stated convention: written by `viewproj matrix`, printed by programs, or passed
// to gluUnProject.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "camera/names.hpp"
#include "camera/read_convention.hpp"
#include "formats/format.hpp"
#include "viewproj/convention.hpp"

namespace viewproj::cmd {
namespace matrices {

using Names = std::initializer_list<std::string_view>;

const Names kView{"view",          "viewMatrix",          "modelview", "modelViewMatrix",
                  "worldToCamera", "worldToCameraMatrix", "w2c",       "matrixWorldInverse"};
const Names kViewInverse{"viewInverse", "viewMatrixInverse", "cameraToWorld", "cameraToWorldMatrix",
                         "c2w",         "matrixWorld"};
const Names kProjection{"projection", "projectionMatrix", "proj"};
const Names kProduct{"viewProjection", "viewProjectionMatrix"};

/// The member with one of these names. Throws if there are two with different values.
std::optional<Node> oneOf(const Node& object, Names names) {
  std::optional<Node> found;
  for (const std::string_view name : names) {
    const auto member = object.find(name);
    if (found && member && found->json() != member->json())
      member->fail("differs from " + found->path() + ", another name of it");
    if (!found) found = member;
  }
  return found;
}

Convention conventionOf(const Node& root) {
  const auto stated = root.find("convention");
  if (!stated || stated->json().empty())
    root.fail("matrices need a convention: --read-as NAME states it, and viewproj info lists those that fit");
  return readConvention(root.document()).convention;
}

/// The matrix for column vectors. 4 rows of 4 are as written, 16 numbers are in memory order.
Mat4 matrixIn(const Node& node, const Convention& c) {
  const bool isFlat = node.size() == 16;
  if (!isFlat && (node.size() != 4 || node[0].size() != 4)) node.fail("expected 4 rows of 4 numbers, or 16 numbers");
  const std::vector<double> m = node.numbers(16);
  const bool isTransposed = (c.vectors == Vectors::row) != (isFlat && c.storage == Storage::columnMajor);
  Mat4 rows;
  for (std::size_t i = 0; i < 16; ++i) (isTransposed ? rows[i % 4][i / 4] : rows[i / 4][i % 4]) = m[i];
  return rows;
}

/// A viewport: our own object, [x, y, width, height] of gluUnProject, whose y counts from the bottom, or the matrix
/// from NDC to the screen.
Json viewportOf(const Node& node, const Convention& c) {
  if (node.json().is_object()) return node.json();
  if (node.holdsNumbers(4)) {
    const std::vector<double> v = node.numbers(4);
    return {{"x", v[0]}, {"y", v[1]}, {"width", v[2]}, {"height", v[3]}, {"origin", "bottom-left"}};
  }
  if (!node.holdsNumbers(16)) node.fail("expected an object, [x, y, width, height] or a matrix");
  //     | W/2   0     0   x + W/2 |
  // M = | 0   -+H/2   0   y + H/2 |   z: 0..1, or -1..1 with half the range
  //     | 0     0   range   first |
  const Mat4 m = matrixIn(node, c);
  if (m[0][1] != 0 || m[0][2] != 0 || m[1][0] != 0 || m[1][2] != 0 || m[2][0] != 0 || m[2][1] != 0 ||
      m[3] != std::array<double, 4>{0, 0, 0, 1})
    node.fail("is not a matrix from NDC to the screen");
  const double width = 2 * m[0][0], height = 2 * std::fabs(m[1][1]);
  return {{"x", m[0][3] - width / 2},
          {"y", m[1][3] - height / 2},
          {"width", width},
          {"height", height},
          {"pixelCenter", 0.5},
          {"origin", (m[1][1] < 0) == (c.ndcY == NdcY::up) ? "top-left" : "bottom-left"},
          {"depthRange", {c.ndcZ == NdcZ::minusOneToOne ? m[2][3] - m[2][2] : m[2][3], m[2][3] + m[2][2]}}};
}

Json document(const Node& root) {
  const Convention c = conventionOf(root);
  const auto view = oneOf(root, kView), inverse = oneOf(root, kViewInverse), projection = oneOf(root, kProjection);
  if (const auto product = oneOf(root, kProduct); product && !((view || inverse) && projection))
    product->fail("a product of matrices is not taken apart; give view and projection");
  Json camera{{"convention", root.require("convention").json()}};
  // Fields without a preset, as `viewproj matrix` writes them, get the preset that has them all, with its pixel centre.
  if (Json& stated = camera["convention"]; stated.is_object() && !stated.contains("preset"))
    for (const ConventionPreset& preset : conventionPresets())
      if (preset.convention == c) stated["preset"] = preset.name;
  if (view || inverse) {
    Mat4 m = matrixIn(view ? *view : *inverse, c);
    if (const double last = m[3][3]; last != 0 && last != 1)  // a matrix and its multiples are the same map
      for (std::size_t i = 0; i < 16; ++i) m[i / 4][i % 4] /= last;
    camera[view ? "cameraFromWorld" : "worldFromCamera"] = m.m;
    camera["cameraAxes"] = nameOf(kViewNames, c.view);
    if (const auto eye = root.find("eye")) {
      if (m[0][3] != 0 || m[1][3] != 0 || m[2][3] != 0)
        eye->fail("belongs beside a view relative to the eye, and this view has a translation; leave eye out");
      camera["position"] = eye->json();
    }
  }
  if (projection) camera["projection"] = {{"type", "matrix"}, {"matrix", projection->json()}};
  if (const auto viewport = root.find("viewport")) camera["viewport"] = viewportOf(*viewport, c);
  return camera;
}

Import open(const Node& root) {
  Import result = Import::one([root] { return document(root); });
  if (const auto viewport = root.find("viewport"); viewport && viewport->holdsNumbers(4))
    result.notesUnlessSet.emplace_back("viewport.origin",
                                       "viewport: as glViewport's, whose y counts from the bottom; --set "
                                       "viewport.origin=top-left counts from the top");
  return result;
}

}  // namespace matrices

extern const Format kMatrices{
    "matrices", "a file of matrices",
    "view:16|viewMatrix:16|modelview:16|modelViewMatrix:16|worldToCameraMatrix:16|viewInverse:16|viewMatrixInverse:16|"
    "cameraToWorldMatrix:16|projection:16|projectionMatrix:16|proj:16 !cameraPoseARFrame",
    matrices::open, "*"};

}  // namespace viewproj::cmd
