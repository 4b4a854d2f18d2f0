#include "records/model.hpp"

#include <nlohmann/json.hpp>

#include "camera/check.hpp"
#include "viewproj/camera.hpp"

namespace viewproj::cmd {
namespace {

Mat4 readParts(const Node& model) {
  const auto vector = [&](const char* key, const Vec3& fallback) {
    const auto value = model.find(key);
    return value ? value->vec3() : fallback;
  };
  Quaternion rotation;
  if (const auto value = model.find("rotation")) {
    const std::vector<double> q = value->numbers(4);
    rotation = {q[0], q[1], q[2], q[3]};
  }
  try {
    return worldFromLocal(vector("translation", {0, 0, 0}), rotation, vector("scale", {1, 1, 1}));
  } catch (const CameraError& e) {
    model.fail(e.what());
  }
}

}  // namespace

Mat4 readModel(const std::string& source) {
  const Document document = load(source, "--model");
  const Node model(document);
  if (model.json().is_array()) {
    if (!model.holdsNumbers(16) || model.size() != 4) model.fail("expected 4 rows of 4 numbers");
    const Mat4 rows = model.mat4();
    requireAffine(rows, model);
    return rows;
  }
  // A node of glTF may say more, which does not bear on where it is.
  allowMembers(model, {"matrix", "translation", "rotation", "scale", "name", "mesh", "camera", "skin", "weights",
                       "children", "extensions", "extras"});
  const auto matrix = model.find("matrix");
  const bool hasParts = model.find("translation") || model.find("rotation") || model.find("scale");
  if (matrix && hasParts) matrix->fail("leave out translation, rotation and scale beside a matrix");
  if (!matrix && !hasParts) model.fail("needs matrix, translation, rotation or scale");
  if (!matrix) return readParts(model);
  const Mat4 m = transposed(matrix->mat4());  // 16 numbers by columns
  requireAffine(m, *matrix);
  return m;
}

}  // namespace viewproj::cmd
