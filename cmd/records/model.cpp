#include "records/model.hpp"

#include <nlohmann/json.hpp>

#include "camera/check.hpp"
#include "text/error.hpp"
#include "text/number.hpp"
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
  constexpr const char* kForms =
      "4 rows of 4 numbers, or {\"translation\": [x, y, z], \"rotation\": [x, y, z, w], \"scale\": [x, y, z]}";
  if (source.find(',') != std::string::npos && parseNumberList(source))
    throw UsageError("--model " + source + ": expected a file or the JSON itself: " + kForms);
  const Document document = load(source, "--model");
  const Node model(document);
  if (model.json().is_object()) {
    allowMembers(model, {"name", "translation", "rotation", "scale"});
    return readParts(model);
  }
  if (!model.holdsNumbers(16) || model.size() != 4) model.fail(std::string("expected ") + kForms);
  const Mat4 rows = model.mat4();
  requireAffine(rows, model);
  return rows;
}

}  // namespace viewproj::cmd
