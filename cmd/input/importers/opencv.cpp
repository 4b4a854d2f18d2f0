// A calibrated camera as OpenCV has it: K, and [R|t] from the world to the camera, whose x, y, z point right, down,
// forward. Whole numbers of pixels are pixel centres. YAML is not read.
// Source: OpenCV documentation, "Camera Calibration and 3D Reconstruction".
#include <cmath>
#include <nlohmann/json.hpp>

#include "input/importers/importer.hpp"
#include "numbers/radians.hpp"

namespace viewproj::cmd {
namespace {

constexpr std::string_view kK[] = {"K", "camera_matrix", "cameraMatrix", "mtx"};
constexpr std::string_view kDistortion[] = {
    "dist", "distortion_coefficients", "dist_coeffs", "dist_coeff", "distCoeffs", "D"};
constexpr std::string_view kT[] = {"t", "tvec", "T"};
constexpr std::string_view kWidth[] = {"width", "image_width"};
constexpr std::string_view kHeight[] = {"height", "image_height"};

bool recognises(const nlohmann::json& root) {
  for (std::string_view key : kK)
    if (root.contains(key)) return true;
  return false;
}

/// The one of the names that the file has, or the first. Throws where it has two.
template <std::size_t N>
std::string_view nameIn(const ObjectReader& file, const std::string_view (&names)[N]) {
  std::string_view found;
  for (std::string_view name : names) {
    if (!file.has(name)) continue;
    if (!found.empty()) file.fail(name, "says what " + std::string(found) + " does; one of them is expected");
    found = name;
  }
  return found.empty() ? names[0] : found;
}

/// A matrix as nested rows, as one row, or as FileStorage writes it: {"rows", "cols", "data"}. Any count where 0.
std::optional<std::vector<double>> readMatrix(const ObjectReader& file, std::string_view key, std::size_t count) {
  const nlohmann::json* value = file.find(key);
  if (!value) return std::nullopt;
  if (value->is_object()) {
    const ObjectReader stored = *file.object(key);
    if (!stored.has("data")) stored.fail("needs data, or an array in its place");
    return readMatrix(stored, "data", count);
  }
  return flatNumbers(file, key, count);
}

struct Matrix3 {
  std::vector<double> m;
  double operator()(std::size_t i, std::size_t j) const { return m[3 * i + j]; }
};

Matrix3 readK(const ObjectReader& file, std::string_view key) {
  const Matrix3 k{*readMatrix(file, key, 9)};
  if (k(2, 0) != 0 || k(2, 1) != 0 || k(2, 2) != 1) {
    const bool looksTransposed = k(0, 2) == 0 && k(1, 2) == 0 && k(2, 2) == 1;
    file.fail(key, std::string("has a last row that is not 0 0 1") + (looksTransposed ? "; transpose it" : ""));
  }
  if (k(1, 0) != 0) file.fail(key, "is not fx s cx, 0 fy cy, 0 0 1");
  if (k(0, 1) != 0) file.fail(key, "has a skew: pixels of a skewed grid are not modelled");
  return k;
}

/// A rotation vector, whose length is the angle in radians, and t = -R eye, in double-double.
Pose poseFromRotationVector(const Vec3& r, const Vec3& t) {
  constexpr double kLargest = 1e6;  // radians: beyond, the angle is not known to its last digits
  constexpr DoubleDouble kTurn{0x1.921fb54442d18p+2, 0x1.1a62633145c07p-52};
  std::array<DDVec3, 3> columns{DDVec3{1, 0, 0}, DDVec3{0, 1, 0}, DDVec3{0, 0, 1}};
  if (!(maxAbs(r) <= kLargest))
    throw CameraError("rotation", "is no rotation vector: its length is the angle in radians");
  if (maxAbs(r) > 0) {
    DDVec3 axis = normalized(toDoubleDouble(r));
    DoubleDouble angle = DoubleDouble(1) / inverseLength(toDoubleDouble(r));
    angle = angle - kTurn * DoubleDouble(std::round(angle.hi / kTurn.hi));
    if (angle.hi < 0) {
      angle = -angle;
      axis = -axis;
    }
    // From the tangent of a quarter of the angle, which is at most 1, by way of those of its half.
    const DoubleDouble q = angle.hi > 0 ? tanHalfRadians(timesPowerOfTwo(angle, 0.5)) : DoubleDouble();
    const DoubleDouble one = 1, qq = q * q, half = one / (one + qq);
    const DoubleDouble s = timesPowerOfTwo(q * half, 2), c = (one - qq) * half;  // of half the angle
    const DDVec3 v = axis * s;
    // The columns of the inverse rotation: the axis turned the other way.
    const auto twice = [](DoubleDouble a) { return timesPowerOfTwo(a, 2); };
    columns[0] = {one - twice(v.y * v.y + v.z * v.z), twice(v.x * v.y - v.z * c), twice(v.x * v.z + v.y * c)};
    columns[1] = {twice(v.x * v.y + v.z * c), one - twice(v.x * v.x + v.z * v.z), twice(v.y * v.z - v.x * c)};
    columns[2] = {twice(v.x * v.z - v.y * c), twice(v.y * v.z + v.x * c), one - twice(v.x * v.x + v.y * v.y)};
  }
  const DDVec3 eye = -(columns[0] * t.x + columns[1] * t.y + columns[2] * t.z);
  return poseFromColumns(columns, eye, CameraAxes::RDF, Handedness::right);
}

/// The identity where the file says nothing of it: points are then in the camera's own coordinates.
Pose readPose(const ObjectReader& file) {
  const std::string_view tKey = nameIn(file, kT);
  const auto t = readMatrix(file, tKey, 3), r = readMatrix(file, "R", 9), rvec = readMatrix(file, "rvec", 3);
  if (r && rvec) file.fail("rvec", "says what R does; one of them is expected");
  if (t && !r && !rvec) file.fail(tKey, "needs R or rvec beside it");
  if (!t && (r || rvec))
    file.fail(r ? "R" : "rvec",
              std::string("needs t beside it") +
                  (r && file.has("P") ? "; R of a ROS CameraInfo rectifies, and places no camera" : ""));
  const Vec3 translation = t ? Vec3{(*t)[0], (*t)[1], (*t)[2]} : Vec3{};
  if (!r)
    return located(file, {{"rotation", "rvec"}, {"position", tKey}}, [&] {
      return poseFromRotationVector(rvec ? Vec3{(*rvec)[0], (*rvec)[1], (*rvec)[2]} : Vec3{}, translation);
    });
  Mat4 m;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) m[i][j] = (*r)[3 * i + j];
    m[i][3] = translation[i];
  }
  m[3][3] = 1;
  return located(file, {{"cameraFromWorld", "R"}}, [&] {
    try {
      return poseFromCameraFromWorld(m, CameraAxes::RDF, Handedness::right);
    } catch (const CameraError& e) {
      if (e.message().starts_with("is a mirroring"))
        throw CameraError(e.field(), "mirrors (its determinant is negative): it is no rotation");
      throw;
    }
  });
}

struct Size {
  std::optional<double> width, height;
};

Size readSize(const ObjectReader& file) {
  if (const auto size = file.numbers("image_size", 2, 2)) return {(*size)[0], (*size)[1]};
  return {file.number(nameIn(file, kWidth)), file.number(nameIn(file, kHeight))};
}

std::vector<HeldCamera> list(const Document& document) {
  const ObjectReader file(document, document.root(), {});
  const Matrix3 k = readK(file, nameIn(file, kK));
  const Size size = readSize(file);
  std::string note = "fx " + shortNumber(k(0, 0)) + ", fy " + shortNumber(k(1, 1));
  if (size.width && size.height) note += ", " + shortNumber(*size.width) + " x " + shortNumber(*size.height);
  if (!file.has(nameIn(file, kT))) note += ", no pose: at the origin";
  return {{"", "0", "", "intrinsics", note}};
}

CameraFile read(const Document& document, std::size_t, const CameraReading& reading) {
  const ObjectReader file(document, document.root(), {});
  const std::string_view kKey = nameIn(file, kK), distortionKey = nameIn(file, kDistortion);
  const Matrix3 k = readK(file, kKey);
  const auto distortion = readMatrix(file, distortionKey, 0);
  if (distortion && std::any_of(distortion->begin(), distortion->end(), [](double c) { return c != 0; })) {
    if (!reading.ignoreDistortion)
      file.fail(distortionKey,
                "distorts the picture, which is not modelled; undistort points or picture first, or "
                "give --ignore-distortion for pixels of an ideal lens");
    document.note({std::string(distortionKey)}, kDistortionLeftOut);
  }
  const Size size = readSize(file);
  const auto viewport = importedViewport(document, {.width = size.width, .height = size.height, .pixelCenter = 0});
  // The pixels that K counts are the file's own; a viewport of another size shows the same picture.
  std::optional<Projection> projection;
  if (viewport || (size.width && size.height)) {
    const Viewport& frame = viewport->frame;
    const Viewport pixels{.width = size.width.value_or(frame.width),
                          .height = size.height.value_or(frame.height),
                          .pixelCenter = frame.pixelCenter};
    projection =
        located(file, {{"fx", kKey}, {"fy", kKey}, {"cx", kKey}, {"cy", kKey}, {"near", "near"}, {"far", "far"}}, [&] {
          return intrinsics(k(0, 0), k(1, 1), k(0, 2), k(1, 2), pixels, file.numberOr("near", kDefaultNear),
                            file.numberOr("far", kInfiniteFar));
        });
    if (!reading.allowStretch) requireShape(DoubleDouble(pixels.width) / DoubleDouble(pixels.height), frame, file);
  } else {
    file.fail("has no width and height, the size of its pictures; --viewport WIDTHxHEIGHT gives one");
  }
  return imported(document, *conventionPreset("opencv"), readPose(file), projection, viewport);
}

}  // namespace

const Importer kOpenCv{"a calibration", recognises, list, read};

}  // namespace viewproj::cmd
