#include "records/model.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "camera/camera_set.hpp"
#include "camera/patch.hpp"
#include "camera/read_camera.hpp"
#include "camera/rigid.hpp"
#include "camera/values.hpp"
#include "formats/pose_chain.hpp"
#include "numbers/dyadic.hpp"
#include "text/error.hpp"
#include "text/file.hpp"
#include "text/number.hpp"
#include "text/pasted_matrices.hpp"
#include "viewproj/camera.hpp"

namespace viewproj::cmd {
namespace {

/// Three numbers, or one for all three.
Vec3 readScale(const Node& value) {
  if (!value.json().is_number()) return value.vec3();
  return {value.number(), value.number(), value.number()};
}

/// 4 rows of 4 as programs print them.
std::optional<Json> rowsOf(const std::string& text) {
  const std::vector<PastedMatrix> matrices = findMatrices(text).matrices;
  if (matrices.size() != 1 || matrices.front().rows != 4 || matrices.front().columns != 4) return std::nullopt;
  const PastedMatrix& m = matrices.front();
  if (!std::all_of(m.numbers.begin(), m.numbers.end(), [](const PrintedNumber& n) { return std::isfinite(n.value); }))
    return std::nullopt;
  Json rows = Json::array();
  for (std::size_t i = 0; i < 4; ++i) {
    rows.push_back(Json::array());
    for (std::size_t j = 0; j < 4; ++j) rows.back().push_back(m.isByColumns ? m.at(j, i) : m.at(i, j));
  }
  return rows;
}

Mat4 matrixOf(const std::string& source, const Json& pose) {
  const Document document{source, std::make_shared<Json>(pose)};
  return matrixOf(rigidOf(readRigid(Node(document))));
}

/// What no model is may be a pose, with #NAME behind the file or without.
Document loadModel(const std::string& source) {
  if (isInlineJson(source)) return load(source, "--model");
  const auto ofPose = [&] { return Document{source, std::make_shared<Json>(matrixOf(source, poseOf(source)).m)}; };
  if (splitPick(source).pick) return ofPose();
  std::string text = readWholeFile(source, kMostDocumentBytes);
  if (auto rows = rowsOf(text)) return {shownName(source), std::make_shared<Json>(*std::move(rows))};
  if (source != "-" && text.find_first_of("{[") != text.find_first_not_of(" \t\r\n")) return ofPose();
  return parseDocument(shownName(source), std::move(text));
}

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
    const auto scale = model.find("scale");
    return worldFromLocal(vector("translation", {0, 0, 0}), rotation, scale ? readScale(*scale) : Vec3{1, 1, 1});
  } catch (const CameraError& e) {
    model.fail(e.what());
  }
}

void requireNumbers(const Vec3& v, const char* field) {
  for (const double x : {v.x, v.y, v.z})
    if (!(std::fabs(x) <= kLargestNumber))
      throw CameraError(field, "has a component that is not a finite number up to 1e45");
}

}  // namespace

Mat4 worldFromLocal(const Vec3& translation, const Quaternion& rotation, const Vec3& scale) {
  requireNumbers(translation, "translation");
  requireNumbers(scale, "scale");
  // The rotation is that of a camera with axes x right, y up, z back. The camera's rows are the columns of its inverse.
  const Camera camera = cameraIn({}, poseFromRotation({0, 0, 0}, rotation, CameraAxes::RUB));
  Mat4 m;
  for (std::size_t i = 0; i < 3; ++i) {
    Vec4 axis;
    (i == 0 ? axis.x : i == 1 ? axis.y : axis.z) = 1;
    const detail::DDVec3 row = detail::joined(alongAxes(camera, axis));
    for (std::size_t j = 0; j < 3; ++j)
      m[i][j] = detail::rounded(detail::Wide(j == 2 ? -row.z : row[j]) * detail::Wide(scale[j]));
    m[i][3] = translation[i];
  }
  m[3][3] = 1;
  return m;
}

std::optional<Mat4> inverseOfAffine(const Mat4& m) {
  using detail::DDVec3;
  const auto [x, y, z] = rigidOf({m[0].data(), 12}).columns;
  // The rows of the inverse of the 3x3 part, times its determinant.
  const std::array<DDVec3, 3> rows{cross(y, z), cross(z, x), cross(x, y)};
  const detail::DoubleDouble size = dot(x, rows[0]);
  if (!(std::fabs(size.hi) > 0 && std::isfinite(size.hi))) return std::nullopt;
  const DDVec3 origin{m[0][3], m[1][3], m[2][3]};
  Mat4 inverse;
  for (std::size_t i = 0; i < 3; ++i) {
    const DDVec3 row = rows[i] * (detail::DoubleDouble(1) / size);
    inverse[i] = {row.x.hi, row.y.hi, row.z.hi, -dot(row, origin).hi};
  }
  inverse[3] = {0, 0, 0, 1};
  return inverse;
}

Vec4 toWorld(const Mat4& m, const Vec4& p) noexcept {
  const double local[] = {p.x, p.y, p.z, p.w};
  const auto coordinate = [&](std::size_t i) {
    detail::DoubleDouble near;
    double size = 0;
    for (std::size_t j = 0; j < 4; ++j) {
      near += detail::twoProd(m[i][j], local[j]);
      size += std::fabs(m[i][j] * local[j]);
    }
    // At this size, no product has lost a significant digit to underflow.
    if (size > 0x1p-800 && size < 0x1p900 && detail::roundsAlike(near, 0x1p-100 * size)) return detail::rounded(near);
    detail::Dyadic<2> sum;
    for (std::size_t j = 0; j < 4; ++j) sum = sum + detail::Dyadic<1>(m[i][j]) * detail::Dyadic<1>(local[j]);
    return detail::nearestDouble(sum.rounded());
  };
  return {coordinate(0), coordinate(1), coordinate(2), p.w};
}

namespace {

/// "1,2,3 rpy:0,0,90 scale:2" or "1,2,3 scale:1,2,1".
std::optional<Mat4> modelOfText(const std::string& source) {
  const std::size_t at = source.find(" scale:");
  const auto pose = poseOfText(source.substr(0, at));
  if (!pose) return std::nullopt;
  Mat4 m = matrixOf("--model " + source, *pose);
  if (at == std::string::npos) return m;
  auto scale = parseNumberList(source.substr(at + 7));
  if (scale && scale->size() == 1) scale->resize(3, scale->front());
  if (!scale || scale->size() != 3)
    throw UsageError("--model " + source + ": expected scale:S or scale:X,Y,Z behind the place and its turn");
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) m[i][j] *= (*scale)[j];
  return m;
}

Mat4 readOne(const std::string& source) {
  constexpr const char* kForms =
      "4 rows of 4 numbers, or {\"translation\": [x, y, z], \"rotation\": [x, y, z, w], \"scale\": [x, y, z]}";
  if (const auto typed = modelOfText(source)) return *typed;
  if (source.find(',') != std::string::npos && parseNumberList(source))
    throw UsageError("--model " + source + ": expected a file or the JSON itself: " + kForms);
  const Document document = loadModel(source);
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

}  // namespace

Mat4 readModel(const std::vector<std::string>& chain) {
  Mat4 model = readOne(chain.back());
  for (std::size_t at = chain.size() - 1; at-- > 0;) {
    const Mat4 outer = readOne(chain[at]), inner = model;
    for (std::size_t j = 0; j < 4; ++j) {
      const Vec4 column = toWorld(outer, {inner[0][j], inner[1][j], inner[2][j], inner[3][j]});
      model[0][j] = column.x;
      model[1][j] = column.y;
      model[2][j] = column.z;
    }
  }
  return model;
}

}  // namespace viewproj::cmd
