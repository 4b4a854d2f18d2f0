#include "input/model.hpp"

#include "input/camera_fields.hpp"
#include "input/document.hpp"
#include "viewproj/camera.hpp"

namespace viewproj::cmd {
namespace {

constexpr Field kRows{"rows", ValueForm::rigid, "What an array by itself is read as."};
constexpr Field kMatrix{"matrix", ValueForm::rigid, "16 numbers by columns."};
constexpr Field kTranslation{"translation", ValueForm::triple, "x, y, z."};
constexpr Field kRotation{"rotation", ValueForm::quaternion, "x, y, z, w."};
constexpr Field kScale{"scale", ValueForm::triple, "x, y, z."};
// What else a glTF node says does not bear on where it is.
constexpr Field kMesh{"mesh", ValueForm::anything, ""}, kCamera{"camera", ValueForm::anything, ""},
    kSkin{"skin", ValueForm::anything, ""}, kWeights{"weights", ValueForm::anything, ""},
    kChildren{"children", ValueForm::anything, ""}, kExtensions{"extensions", ValueForm::anything, ""},
    kExtras{"extras", ValueForm::anything, ""};
constexpr Way kWays[] = {{.keys = field::list<kRows>},
                         {.keys = field::list<kMatrix>},
                         {.keys = field::list<kTranslation, kRotation, kScale>, .anyKey = true}};
constexpr ObjectForm kModel{.help = "Where a model stands in the world.",
                            .fields = field::list<kRows, kMatrix, kTranslation, kRotation, kScale, field::name, kMesh,
                                                  kCamera, kSkin, kWeights, kChildren, kExtensions, kExtras>,
                            .ways = kWays,
                            .aim = "place"};

void requireAffine(const Mat4& m, const ObjectReader& fields, const Field& field) {
  if (m[3] == std::array<double, 4>{0, 0, 0, 1}) return;
  const bool looksTransposed = m[0][3] == 0 && m[1][3] == 0 && m[2][3] == 0 && m[3][3] == 1;
  fields.fail(field, std::string("has a last row that is not 0 0 0 1") +
                         (looksTransposed ? "; this one is written for row vectors: transpose it" : ""));
}

Mat4 readParts(const ObjectReader& fields) {
  const Vec3 translation = fields.vec3(kTranslation).value_or(Vec3{0, 0, 0});
  const Vec3 scale = fields.vec3(kScale).value_or(Vec3{1, 1, 1});
  Quaternion rotation;
  if (const auto q = fields.numbers(kRotation, 4, 4)) rotation = {(*q)[0], (*q)[1], (*q)[2], (*q)[3]};
  try {
    return worldFromLocal(translation, rotation, scale);
  } catch (const CameraError& e) {
    fields.fail(e.field(), e.message());
  }
}

}  // namespace

Mat4 readModel(const std::string& source) {
  const Document document(source, "--model", kRows.name.data());
  const ObjectReader fields(document, document.root(), {});
  fields.allow(kModel);
  (void)fields.way(kModel);
  if (const auto rows = fields.mat4(kRows)) {
    requireAffine(*rows, fields, kRows);
    return *rows;
  }
  if (const auto flat = fields.numbers(kMatrix, 16, 16)) {
    Mat4 m;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) m[i][j] = (*flat)[4 * j + i];
    requireAffine(m, fields, kMatrix);
    return m;
  }
  return readParts(fields);
}

}  // namespace viewproj::cmd
