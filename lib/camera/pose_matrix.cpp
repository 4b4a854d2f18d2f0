// Poses of axes that are given: a rotation, or a matrix.
#include <array>
#include <cstdio>
#include <string>

#include "camera/exact_vectors.hpp"
#include "camera/pose.hpp"
#include "camera/pose_source.hpp"

namespace viewproj::detail {
namespace {

using Columns = std::array<Vec3, 3>;

const char* axesName(CameraAxes axes) {
  switch (axes) {
    case CameraAxes::RUB:
      return "RUB";
    case CameraAxes::RUF:
      return "RUF";
    case CameraAxes::RDF:
      return "RDF";
    case CameraAxes::FRU:
      break;
  }
  return "FRU";
}

/// Of right, up, forward: which one each camera axis lies along, and its sign.
struct AxisMap {
  std::array<int, 3> along;
  std::array<double, 3> sign;
};

AxisMap axisMap(CameraAxes axes) {
  switch (axes) {
    case CameraAxes::RUB:
      return {{0, 1, 2}, {1, 1, -1}};
    case CameraAxes::RUF:
      return {{0, 1, 2}, {1, 1, 1}};
    case CameraAxes::RDF:
      return {{0, 1, 2}, {1, -1, 1}};
    case CameraAxes::FRU:
      break;
  }
  return {{2, 0, 1}, {1, 1, 1}};
}

Handedness handednessOf(CameraAxes axes) {
  return axes == CameraAxes::RUB || axes == CameraAxes::RDF ? Handedness::right : Handedness::left;
}

/// A set of axes with determinant +1 belongs to a world of its own handedness, with -1 to the other.
void requireHandedness(CameraAxes axes, Handedness world, bool mirrored, const char* field) {
  const Handedness fits = mirrored == (handednessOf(axes) == Handedness::left) ? Handedness::right : Handedness::left;
  if (fits == world) return;
  const bool rightHandedAxesFit = (world == Handedness::right) != mirrored;
  throw CameraError(field, std::string("is a ") + (mirrored ? "mirroring" : "rotation") + " of camera axes " +
                               axesName(axes) + ", which does not fit a " +
                               (world == Handedness::right ? "right" : "left") + "-handed world; cameraAxes " +
                               (rightHandedAxesFit ? "RUB or RDF" : "RUF or FRU") + " would");
}

/// From camera x, y, z to right, up, forward.
Axes toAxes(const std::array<DDVec3, 3>& xyz, CameraAxes axes) {
  const AxisMap map = axisMap(axes);
  std::array<DDVec3, 3> result;
  for (std::size_t i = 0; i < 3; ++i)
    result[static_cast<std::size_t>(map.along[i])] = xyz[i] * DoubleDouble(map.sign[i]);
  return {result[0], result[1], result[2]};
}

/// The same for exact rows, which share a scale; the signs go to the scales.
ExactRows toExactRows(const std::array<ExactVec3, 3>& xyz, DoubleDouble scale, CameraAxes axes, const Vec3& origin,
                      const Vec3& translation, PoseSource::Kind kind = PoseSource::Kind::rows,
                      const std::array<Vec3, 3>& numbers = {}) {
  const AxisMap map = axisMap(axes);
  ExactRows rows;
  rows.source = {kind, numbers, false, map.along, map.sign};
  for (const ExactVec3& row : xyz) rows.isNarrow = rows.isNarrow && isAbove(row, kSmallestTerm);
  rows.origin = origin;
  ExactVec3* const row[] = {&rows.right, &rows.up, &rows.forward};
  DoubleDouble* const rowScale[] = {&rows.rightScale, &rows.upScale, &rows.forwardScale};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto along = static_cast<std::size_t>(map.along[i]);
    *row[along] = xyz[i];
    *rowScale[along] = scale * DoubleDouble(map.sign[i]);
    rows.translation[along] = {translation[i]};
  }
  return rows;
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

/// The 3x3 of a pose matrix, by columns, checked.
Columns checkedColumns(const Mat4& matrix, const char* field) {
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      if (!std::isfinite(matrix[i][j])) throw CameraError(field, "has an entry that is not a finite number");
  if (!(matrix[3] == std::array<double, 4>{0, 0, 0, 1})) {
    const bool looksTransposed = matrix[0][3] == 0 && matrix[1][3] == 0 && matrix[2][3] == 0 && matrix[3][3] == 1;
    throw CameraError(field, std::string("has a last row that is not 0 0 0 1") +
                                 (looksTransposed ? "; this one is written for row vectors: transpose it" : ""));
  }
  Columns c;
  for (std::size_t j = 0; j < 3; ++j) c[j] = {matrix[0][j], matrix[1][j], matrix[2][j]};
  requireOrthogonal(c, field);
  return c;
}

/// The rows of the inverse of the matrix with these columns, not yet divided by the determinant: exact.
std::array<ExactVec3, 3> exactAdjugateRows(const Columns& c) {
  return {exactCross(toDoubleDouble(c[1]), exactly(c[2])), exactCross(toDoubleDouble(c[2]), exactly(c[0])),
          exactCross(toDoubleDouble(c[0]), exactly(c[1]))};
}

DoubleDouble exactDeterminant(const std::array<ExactVec3, 3>& adjugate, const Columns& c) {
  Expansion<48> sum;
  for (std::size_t i = 0; i < 3; ++i) sum.addScaled(adjugate[0][i], c[0][i]);
  return sum.rounded();
}

struct Inverse {
  std::array<ExactVec3, 3> adjugate;
  DoubleDouble determinant;
  std::array<DDVec3, 3> rows;
};

Inverse inverse(const Columns& c) {
  Inverse result{exactAdjugateRows(c), {}, {}};
  result.determinant = exactDeterminant(result.adjugate, c);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) result.rows[i][j] = result.adjugate[i][j].rounded() / result.determinant;
  return result;
}

std::array<DDVec3, 3> transposedColumns(const std::array<DDVec3, 3>& rows) {
  std::array<DDVec3, 3> columns;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) columns[i][j] = rows[j][i];
  return columns;
}

/// The eye of a matrix from the world to the camera, -M^-1 t rounded, and M eye + t: what the rounding left over, as
/// columns that hold one number each, to be named like the axes.
struct RoundedEye {
  Vec3 eye;
  std::array<DDVec3, 3> residual;
};

/// Whether no product of a translation's part with an entry of a narrow row, of an eye's with one, or of a sum's rest
/// underflows, and no sum overflows.
bool isNarrowTranslation(const Vec3& t) {
  return maxAbs(t) < 0x1p600 && isAbove(t.x, 0x1p-200) && isAbove(t.y, 0x1p-200) && isAbove(t.z, 0x1p-200);
}

RoundedEye eyeOf(const Inverse& inverted, const Mat4& matrix, const Vec3& translation) {
  RoundedEye result;
  for (std::size_t i = 0; i < 3; ++i) {
    Expansion<48> sum;
    for (std::size_t j = 0; j < 3; ++j) sum.addScaled(inverted.adjugate[i][j], -translation[j]);
    result.eye[i] = (sum.rounded() / inverted.determinant).hi;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    Expansion<8> sum;
    for (std::size_t j = 0; j < 3; ++j) sum.addProduct(matrix[i][j], result.eye[j]);
    sum.add(translation[i]);
    result.residual[i].x = sum.rounded();
  }
  return result;
}

/// The same whatever the magnitudes.
RoundedEye eyeOfDyadic(const Columns& c, const Mat4& matrix, const Vec3& translation) {
  const Vector3<Dyadic> columns[] = {toDyadic(c[0]), toDyadic(c[1]), toDyadic(c[2])}, t = toDyadic(translation);
  const Wide determinant = dot(columns[0], crossOf(columns[1], columns[2])).rounded();
  RoundedEye result;
  for (std::size_t i = 0; i < 3; ++i) {
    const Dyadic sum = -dot(crossOf(columns[(i + 1) % 3], columns[(i + 2) % 3]), t);
    result.eye[i] = nearestDouble(sum.rounded() / determinant);
  }
  if (!isFinite(result.eye)) return result;
  for (std::size_t i = 0; i < 3; ++i) {
    const Dyadic rest =
        dot(toDyadic(Vec3{matrix[i][0], matrix[i][1], matrix[i][2]}), toDyadic(result.eye)) + Dyadic(translation[i]);
    result.residual[i].x = toDoubleDouble(rest.rounded());
  }
  return result;
}

}  // namespace

Pose poseFromColumns(const std::array<DDVec3, 3>& columns, const DDVec3& eye, CameraAxes axes, Handedness world) {
  const Columns c{rounded(columns[0]), rounded(columns[1]), rounded(columns[2])};
  requireFinite(rounded(eye), "position");
  for (const Vec3& column : c) requireFinite(column, "columns");
  requireOrthogonal(c, "columns");
  const std::array<DDVec3, 3> crossed = {cross(columns[1], columns[2]), cross(columns[2], columns[0]),
                                         cross(columns[0], columns[1])};
  const DoubleDouble determinant = dot(columns[0], crossed[0]);
  requireHandedness(axes, world, determinant.hi < 0, "columns");
  const DoubleDouble scale = DoubleDouble(1) / determinant;
  const std::array<DDVec3, 3> rows = {crossed[0] * scale, crossed[1] * scale, crossed[2] * scale};
  // Rounded, so that the exact rows hold it too; it is 2^-53 of the eye, and so is its rounding of it.
  const DDVec3 rest = -DDVec3{eye.x.lo, eye.y.lo, eye.z.lo};
  const Vec3 residual{dot(rows[0], rest).hi, dot(rows[1], rest).hi, dot(rows[2], rest).hi};
  std::array<ExactVec3, 3> exact;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) exact[i][j] = {rows[i][j].lo, rows[i][j].hi};
  const ExactRows exactRows = toExactRows(exact, 1, axes, rounded(eye), residual);
  // The signs of the axes are in the scales of the exact rows, which take the translation in.
  const auto along = [&](DoubleDouble rowScale, std::size_t i) {
    return rowScale * exactRows.translation[i].rounded();
  };
  return made({rounded(eye),
               toAxes(rows, axes),
               toAxes(columns, axes),
               {along(exactRows.rightScale, 0), along(exactRows.upScale, 1), along(exactRows.forwardScale, 2)},
               exactRows});
}

}  // namespace viewproj::detail

namespace viewproj {

using namespace detail;

Pose poseFromColumns(const std::array<SplitVec3, 3>& columns, const SplitVec3& eye, CameraAxes axes, Handedness world) {
  return poseFromColumns({joined(columns[0]), joined(columns[1]), joined(columns[2])}, joined(eye), axes, world);
}

Pose movedTo(const Pose& pose, const Vec3& eye) {
  const Axes& c = parts(pose).columns;
  return poseFromColumns({c.right, c.up, c.forward}, toDoubleDouble(eye), CameraAxes::RUF, pose.world());
}

Pose poseFromRotation(const Vec3& position, const Quaternion& q, CameraAxes axes, Handedness world) {
  requireFinite(position, "position");
  requireFinite({q.x, q.y, q.z}, "rotation");
  requireFinite({q.w, 0, 0}, "rotation");
  const double largest = std::max(maxAbs(Vec3{q.x, q.y, q.z}), std::fabs(q.w));
  if (largest == 0) throw CameraError("rotation", "is zero");
  requireHandedness(axes, world, false, "rotation");
  const int k = -std::ilogb(largest);
  const double x = std::ldexp(q.x, k), y = std::ldexp(q.y, k), z = std::ldexp(q.z, k), w = std::ldexp(q.w, k);

  const auto squares = [&](double sx, double sy, double sz) {
    Expansion<8> e;
    e.addProduct(w, w);
    e.addProduct(sx * x, x);
    e.addProduct(sy * y, y);
    e.addProduct(sz * z, z);
    return e;
  };
  const auto twice = [&](double a, double b, double c, double d) {  // 2 (a b + c d)
    Expansion<8> e;
    e.addProduct(2 * a, b);
    e.addProduct(2 * c, d);
    return e;
  };
  //     | ww+xx-yy-zz   2(xy-zw)      2(xz+yw)    |
  // R = | 2(xy+zw)      ww-xx+yy-zz   2(yz-xw)    | / (ww+xx+yy+zz), by columns:
  //     | 2(xz-yw)      2(yz+xw)      ww-xx-yy+zz |
  const std::array<ExactVec3, 3> columns = {{
      {squares(1, -1, -1), twice(x, y, z, w), twice(x, z, -y, w)},
      {twice(x, y, -z, w), squares(-1, 1, -1), twice(y, z, x, w)},
      {twice(x, z, y, w), twice(y, z, -x, w), squares(-1, -1, 1)},
  }};
  const DoubleDouble scale = DoubleDouble(1) / squares(1, 1, 1).rounded();
  bool isNarrow = true;
  for (double part : {x, y, z, w}) isNarrow = isNarrow && isAbove(part, kSmallestFactor);
  const Axes camera =
      toAxes({rounded(columns[0]) * scale, rounded(columns[1]) * scale, rounded(columns[2]) * scale}, axes);
  ExactRows exact =
      toExactRows(columns, scale, axes, position, {}, PoseSource::Kind::rotation, {{{q.x, q.y, q.z}, {q.w, 0, 0}, {}}});
  for (double part : {q.x, q.y, q.z, q.w}) isNarrow = isNarrow && (part == 0) == (std::ldexp(part, k) == 0);
  exact.isNarrow = exact.isNarrow && isNarrow;
  return made({position, camera, camera, {}, exact});
}

Pose poseFromWorldFromCamera(const Mat4& matrix, CameraAxes axes, Handedness world) {
  const Columns c = checkedColumns(matrix, "worldFromCamera");
  const Inverse inverted = inverse(c);
  requireHandedness(axes, world, inverted.determinant.hi < 0, "worldFromCamera");
  const Vec3 eye{matrix[0][3], matrix[1][3], matrix[2][3]};
  ExactRows exact = toExactRows(inverted.adjugate, DoubleDouble(1) / inverted.determinant, axes, eye, {},
                                PoseSource::Kind::columns, c);
  for (const Vec3& column : c) exact.isNarrow = exact.isNarrow && isAbove(toDoubleDouble(column), kSmallestFactor);
  return made({eye,
               toAxes(inverted.rows, axes),
               toAxes({toDoubleDouble(c[0]), toDoubleDouble(c[1]), toDoubleDouble(c[2])}, axes),
               {},
               exact});
}

Pose poseFromCameraFromWorld(const Mat4& matrix, CameraAxes axes, Handedness world) {
  const Columns c = checkedColumns(matrix, "cameraFromWorld");
  const Inverse inverted = inverse(c);
  requireHandedness(axes, world, inverted.determinant.hi < 0, "cameraFromWorld");
  std::array<ExactVec3, 3> exact;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) exact[i][j] = {matrix[i][j]};
  const Vec3 translation{matrix[0][3], matrix[1][3], matrix[2][3]};
  const ExactRows exactRows = toExactRows(exact, 1, axes, {}, translation);
  const auto [eye, residual] = exactRows.isNarrow && isNarrowTranslation(translation)
                                   ? eyeOf(inverted, matrix, translation)
                                   : eyeOfDyadic(c, matrix, translation);
  if (!isFinite(eye)) throw CameraError("cameraFromWorld", "has its eye beyond the range of doubles, 1.8e308");
  const Axes left = toAxes(residual, axes);
  const std::array<DDVec3, 3> rows = {{{matrix[0][0], matrix[0][1], matrix[0][2]},
                                       {matrix[1][0], matrix[1][1], matrix[1][2]},
                                       {matrix[2][0], matrix[2][1], matrix[2][2]}}};
  return made({eye,
               toAxes(rows, axes),
               toAxes(transposedColumns(inverted.rows), axes),
               {left.right.x, left.up.x, left.forward.x},
               exactRows});
}

}  // namespace viewproj
