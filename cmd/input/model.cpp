#include "input/model.hpp"

#include "input/document.hpp"
#include "viewproj/camera.hpp"

namespace viewproj::cmd {
namespace {

constexpr const char* kRows = "rows";  // what an array by itself is read as

void requireAffine(const Mat4& m, const ObjectReader& fields, const char* key) {
  if (m[3] == std::array<double, 4>{0, 0, 0, 1}) return;
  const bool looksTransposed = m[0][3] == 0 && m[1][3] == 0 && m[2][3] == 0 && m[3][3] == 1;
  fields.fail(key, std::string("has a last row that is not 0 0 0 1") +
                       (looksTransposed ? "; this one is written for row vectors: transpose it" : ""));
}

Mat4 readParts(const ObjectReader& fields) {
  const Vec3 translation = fields.vec3("translation").value_or(Vec3{0, 0, 0});
  const Vec3 scale = fields.vec3("scale").value_or(Vec3{1, 1, 1});
  Quaternion rotation;
  if (const auto q = fields.numbers("rotation", 4, 4)) rotation = {(*q)[0], (*q)[1], (*q)[2], (*q)[3]};
  try {
    return worldFromLocal(translation, rotation, scale);
  } catch (const CameraError& e) {
    fields.fail(e.field(), e.message());
  }
}

}  // namespace

Mat4 readModel(const std::string& source) {
  const Document document(source, "--model", kRows);
  const ObjectReader fields(document, document.root(), {});
  // Beside its place a glTF node says what stands there.
  fields.allow({kRows, "matrix", "translation", "rotation", "scale", "name", "mesh", "camera", "skin", "weights",
                "children", "extensions", "extras"});
  const bool hasParts = fields.has("translation") || fields.has("rotation") || fields.has("scale");
  if (const auto rows = fields.mat4(kRows)) {
    requireAffine(*rows, fields, kRows);
    return *rows;
  }
  if (const auto flat = fields.numbers("matrix", 16, 16)) {
    if (hasParts) fields.fail("matrix", "is given beside translation, rotation or scale; one of them is expected");
    Mat4 m;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) m[i][j] = (*flat)[4 * j + i];
    requireAffine(m, fields, "matrix");
    return m;
  }
  if (!hasParts) fields.fail("expected 4 rows of 4 numbers, or an object with translation, rotation, scale or matrix");
  return readParts(fields);
}

}  // namespace viewproj::cmd
