// Poses from given axes: a rotation or a matrix.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include "camera/pose.hpp"
#include "camera/require.hpp"

namespace viewproj::detail {
namespace {

using Columns = std::array<Vec3, 3>;

const AxisMap& mapOf(CameraAxes axes) noexcept {
  static constexpr AxisMap kAxes[] = {
      // RUB, RUF, RDF, FRU, FLU, FRD
      {{0, 1, 2}, {1, 1, -1}}, {{0, 1, 2}, {1, 1, 1}},  {{0, 1, 2}, {1, -1, 1}},
      {{2, 0, 1}, {1, 1, 1}},  {{2, 0, 1}, {1, -1, 1}}, {{2, 0, 1}, {1, 1, -1}},
  };
  return kAxes[static_cast<std::size_t>(axes)];
}

/// From the camera's x, y, z to right, up, forward.
template <class Vector>
std::array<Vector, 3> toAxes(const std::array<Vector, 3>& xyz, CameraAxes axes) {
  const AxisMap& map = mapOf(axes);
  std::array<Vector, 3> result;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) result[map.along[i]][j] = map.sign[i] < 0 ? -xyz[i][j] : xyz[i][j];
  return result;
}

Axes toAxesOf(const std::array<DDVec3, 3>& xyz, CameraAxes axes) {
  const auto [right, up, forward] = toAxes(xyz, axes);
  return {right, up, forward};
}

/// The same for one number per axis.
Vec3 toAxes(const Vec3& xyz, CameraAxes axes) {
  const AxisMap& map = mapOf(axes);
  Vec3 result;
  for (std::size_t i = 0; i < 3; ++i) result[map.along[i]] = xyz[i] * map.sign[i];
  return result;
}

void requireOrthogonal(const Columns& c, const char* field) {
  double worst = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = i; j < 3; ++j)
      worst = std::max(worst, std::fabs(c[i].x * c[j].x + c[i].y * c[j].y + c[i].z * c[j].z - (i == j ? 1 : 0)));
  if (!(worst <= kPoseOrthogonality)) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2g", worst);
    throw CameraError(field, std::string("has a 3x3 part that is not a rotation: the largest entry of M^T M - I is ") +
                                 text + ", 0.001 is allowed");
  }
}

Columns columnsOf(const Mat4& m) noexcept {
  Columns c;
  for (std::size_t j = 0; j < 3; ++j) c[j] = {m[0][j], m[1][j], m[2][j]};
  return c;
}

/// A pose matrix, after all checks.
Mat4 checkedPose(const Mat4& given, const char* field) {
  const Mat4 matrix = checkedEntries(given, field);
  if (!(matrix[3] == std::array<double, 4>{0, 0, 0, 1})) {
    const bool looksTransposed = matrix[0][3] == 0 && matrix[1][3] == 0 && matrix[2][3] == 0 && matrix[3][3] == 1;
    throw CameraError(field, std::string("has a last row that is not 0 0 0 1") +
                                 (looksTransposed ? "; this one is written for row vectors: transpose it" : ""));
  }
  requireOrthogonal(columnsOf(matrix), field);
  return matrix;
}

/// The inverse of the matrix with these columns: exact rows to be divided by the determinant, and the rounded rows.
struct Inverse {
  std::array<Vector3<Dyadic<2>>, 3> adjugate;
  Dyadic<3> determinant;
  Wide divisor;
  std::array<DDVec3, 3> rows;
};

Inverse inverse(const Columns& c) {
  const Vector3<Dyadic<1>> x = toDyadic(c[0]), y = toDyadic(c[1]), z = toDyadic(c[2]);
  Inverse result{{crossOf(y, z), crossOf(z, x), crossOf(x, y)}, {}, {}, {}};
  result.determinant = dot(result.adjugate[0], x);
  result.divisor = result.determinant.rounded();
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      result.rows[i][j] = toDoubleDouble(result.adjugate[i][j].rounded() / result.divisor);
  return result;
}

/// Whether |a| = |b|.
template <int A, int B>
bool isOfSize(const Dyadic<A>& a, const Dyadic<B>& b) {
  return (a - b).sign() == 0 || (a + b).sign() == 0;
}

}  // namespace

DoubleDouble determinant(const std::array<DDVec3, 3>& v) noexcept { return dot(v[0], cross(v[1], v[2])); }

std::array<DDVec3, 3> inverse(const std::array<DDVec3, 3>& v) noexcept {
  const DoubleDouble scale = DoubleDouble(1) / determinant(v);
  return {cross(v[1], v[2]) * scale, cross(v[2], v[0]) * scale, cross(v[0], v[1]) * scale};
}

AxisMap axisMap(CameraAxes axes) noexcept { return mapOf(axes); }

Pose poseFromColumns(const std::array<DDVec3, 3>& columns, const DDVec3& eye, CameraAxes axes) {
  const Columns c{rounded(columns[0]), rounded(columns[1]), rounded(columns[2])};
  if (!(maxAbs(eye) <= kLargestNumber))
    throw CameraError("position", "has a component that is not a finite number up to 1e45");
  for (const Vec3& column : c)
    if (!isFinite(column)) throw CameraError("columns", "has a component that is not a finite number");
  requireOrthogonal(c, "columns");
  const std::array<DDVec3, 3> rows = inverse(columns);
  // Rounding the remainder lets the exact rows hold it. It is below 2^-53 of the eye, and its rounding 2^-53 of that.
  const DDVec3 rest = -DDVec3{eye.x.lo, eye.y.lo, eye.z.lo};
  const auto axisRows = toAxes(rows, axes);
  ExactPose exact;
  exact.origin = rounded(eye);
  exact.translation = toAxes({dot(rows[0], rest).hi, dot(rows[1], rest).hi, dot(rows[2], rest).hi}, axes);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) exact.rows[i][j] = Dyadic<1>(axisRows[i][j].hi) + Dyadic<1>(axisRows[i][j].lo);
  return made(
      {exact.origin, toAxesOf(rows, axes), toAxesOf(columns, axes), toDoubleDouble(exact.translation), share(exact)});
}

}  // namespace viewproj::detail

namespace viewproj {

using namespace detail;

Pose poseFromColumns(const std::array<SplitVec3, 3>& columns, const SplitVec3& eye, CameraAxes axes) {
  return poseFromColumns({joined(columns[0]), joined(columns[1]), joined(columns[2])}, joined(eye), axes);
}

Pose poseFromRotation(const Vec3& position, const Quaternion& q, CameraAxes axes) {
  const Vec3 eye = checkedEntries(position, "position"), vector = checkedEntries(Vec3{q.x, q.y, q.z}, "rotation");
  const Dyadic<1> x = vector.x, y = vector.y, z = vector.z, w = checkedEntry(q.w, "rotation");
  if (maxAbs(vector) == 0 && w.sign() == 0) throw CameraError("rotation", "is zero");
  const auto squares = [&](bool plusX, bool plusY, bool plusZ) {
    const auto added = [](const Dyadic<2>& sum, const Dyadic<2>& square, bool plus) {
      return plus ? sum + square : sum - square;
    };
    return added(added(added(w * w, x * x, plusX), y * y, plusY), z * z, plusZ);
  };
  const auto twice = [](const Dyadic<2>& a) { return a + a; };
  //     | ww+xx-yy-zz   2(xy-zw)      2(xz+yw)    |
  // R = | 2(xy+zw)      ww-xx+yy-zz   2(yz-xw)    | / (ww+xx+yy+zz), by columns:
  //     | 2(xz-yw)      2(yz+xw)      ww-xx-yy+zz |
  const std::array<ExactPose::Row, 3> columns = {{
      {squares(true, false, false), twice(x * y + z * w), twice(x * z - y * w)},
      {twice(x * y - z * w), squares(false, true, false), twice(y * z + x * w)},
      {twice(x * z + y * w), twice(y * z - x * w), squares(false, false, true)},
  }};
  ExactPose exact;
  exact.origin = eye;
  const Wide scale = Wide(1) / squares(true, true, true).rounded();
  const auto rows = toAxes(columns, axes);
  for (std::size_t i = 0; i < 3; ++i) setUnitRow(exact, i, rows[i], scale);
  return orthogonal(exact);
}

Pose poseFromWorldFromCamera(const Mat4& worldFromCamera, CameraAxes axes) {
  const Mat4 matrix = checkedPose(worldFromCamera, "worldFromCamera");
  const Columns c = columnsOf(matrix);
  const Inverse inverted = inverse(c);
  ExactPose exact;
  exact.origin = {matrix[0][3], matrix[1][3], matrix[2][3]};
  const auto adjugate = toAxes(inverted.adjugate, axes);
  for (std::size_t i = 0; i < 3; ++i) {
    exact.rows[i] = {adjugate[i].x, adjugate[i].y, adjugate[i].z};
    exact.scale[i] = Wide(1) / inverted.divisor;
    const std::size_t only = onlyEntry(exact.rows[i]);
    if (only < 3 && isOfSize(adjugate[i][only], inverted.determinant))
      setUnitRow(exact, i, exact.rows[i], exact.scale[i]);
  }
  return made({exact.origin,
               toAxesOf(inverted.rows, axes),
               toAxesOf({toDoubleDouble(c[0]), toDoubleDouble(c[1]), toDoubleDouble(c[2])}, axes),
               {},
               share(exact)});
}

Pose poseFromCameraFromWorld(const Mat4& cameraFromWorld, CameraAxes axes) {
  const Mat4 matrix = checkedPose(cameraFromWorld, "cameraFromWorld");
  const Vec3 translation{matrix[0][3], matrix[1][3], matrix[2][3]};
  std::array<Vec3, 3> matrixRows;
  for (std::size_t i = 0; i < 3; ++i) matrixRows[i] = {matrix[i][0], matrix[i][1], matrix[i][2]};
  const std::array<DDVec3, 3> columns =
      inverse({toDoubleDouble(matrixRows[0]), toDoubleDouble(matrixRows[1]), toDoubleDouble(matrixRows[2])});
  Vec3 eye;  // -M^-1 t. Rounded in any way: the residual is what that leaves.
  for (std::size_t i = 0; i < 3; ++i)
    eye[i] = rounded(-dotOrZero({columns[0][i], columns[1][i], columns[2][i]}, toDoubleDouble(translation)));
  std::array<DDVec3, 3> residual;  // M eye + t in x
  for (std::size_t i = 0; i < 3; ++i)
    residual[i].x = toDoubleDouble((dot(toDyadic(matrixRows[i]), toDyadic(eye)) + Dyadic<1>(translation[i])).rounded());
  ExactPose exact;
  exact.translation = toAxes(translation, axes);
  const auto rows = toAxes(matrixRows, axes);
  for (std::size_t i = 0; i < 3; ++i) exact.rows[i] = {rows[i].x, rows[i].y, rows[i].z};
  const Axes rests = toAxesOf(residual, axes);
  return made(
      {eye, roundedRows(exact), toAxesOf(columns, axes), {rests.right.x, rests.up.x, rests.forward.x}, share(exact)});
}

}  // namespace viewproj
