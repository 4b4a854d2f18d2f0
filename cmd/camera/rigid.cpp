#include "camera/rigid.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "numbers/degrees.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

using Columns = std::array<DDVec3, 3>;

/// The columns of the rotation x, y, z, w. The quaternion may have any length but 0.
Columns columnsOf(const std::array<DoubleDouble, 4>& q) {
  const auto& [x, y, z, w] = q;
  const DoubleDouble one = 1, two = DoubleDouble(2) / (x * x + y * y + z * z + w * w);
  //     | 1 - 2 (yy + zz)    2 (xy - zw)      2 (xz + yw)   |
  // R = |   2 (xy + zw)    1 - 2 (xx + zz)    2 (yz - xw)   |  for a quaternion of unit length
  //     |   2 (xz - yw)      2 (yz + xw)    1 - 2 (xx + yy) |
  return {DDVec3{one - two * (y * y + z * z), two * (x * y + z * w), two * (x * z - y * w)},
          DDVec3{two * (x * y - z * w), one - two * (x * x + z * z), two * (y * z + x * w)},
          DDVec3{two * (x * z + y * w), two * (y * z - x * w), one - two * (x * x + y * y)}};
}

/// The quaternion x, y, z, w of a rotation vector.
std::array<DoubleDouble, 4> quaternionOf(const RotationVector& rotation) {
  constexpr DoubleDouble kTurn{0x1.921fb54442d18p+2, 0x1.1a62633145c07p-52};
  const DDVec3 vector = toDoubleDouble(rotation.vector);
  if (!(maxAbs(vector) > 0)) return {0, 0, 0, 1};
  DoubleDouble angle = DoubleDouble(1) / inverseLength(vector);
  angle = angle - kTurn * DoubleDouble(std::round(angle.hi / kTurn.hi));
  // With t the tangent of a quarter of the angle, (2 t axis, 1 - t t) is a quaternion.
  const DoubleDouble quarter = timesPowerOfTwo(angle.hi < 0 ? -angle : angle, 0.5);
  const DoubleDouble t = quarter.hi > 0 ? tanHalfRadians(quarter) : DoubleDouble();
  const DDVec3 part = normalized(vector) * timesPowerOfTwo(angle.hi < 0 ? -t : t, 2);
  return {part.x, part.y, part.z, DoubleDouble(1) - t * t};
}

/// The quaternion scaled so that squares neither underflow nor overflow.
std::array<DoubleDouble, 4> scaled(const Quaternion& q) {
  const std::array<double, 4> parts{q.x, q.y, q.z, q.w};
  const double largest = std::max({std::fabs(q.x), std::fabs(q.y), std::fabs(q.z), std::fabs(q.w)});
  std::array<DoubleDouble, 4> result;
  for (std::size_t i = 0; i < 4; ++i) result[i] = std::scalbn(parts[i], -std::ilogb(largest));
  return result;
}

}  // namespace

Rigid rigidOf(std::span<const double> m) {
  Rigid rigid;
  for (std::size_t j = 0; j < 3; ++j) rigid.columns[j] = {m[j], m[4 + j], m[8 + j]};
  rigid.origin = {m[3], m[7], m[11]};
  return rigid;
}

Rigid rigidOf(std::span<const double> r, const DDVec3& translation) {
  Rigid rigid;
  for (std::size_t j = 0; j < 3; ++j) rigid.columns[j] = {r[j], r[3 + j], r[6 + j]};
  rigid.origin = translation;
  return rigid;
}

Rigid rigidOf(const RigidTransform& transform) {
  if (const Mat4* const m = std::get_if<Mat4>(&transform.rotation)) {
    Rigid rigid;
    for (std::size_t j = 0; j < 3; ++j) rigid.columns[j] = {(*m)[0][j], (*m)[1][j], (*m)[2][j]};
    rigid.origin = {(*m)[0][3], (*m)[1][3], (*m)[2][3]};
    return rigid;
  }
  const auto* const quaternion = std::get_if<Quaternion>(&transform.rotation);
  return {
      quaternion ? rotationColumns(*quaternion) : columnsOf(quaternionOf(std::get<RotationVector>(transform.rotation))),
      toDoubleDouble(transform.translation)};
}

Columns rotationColumns(const Quaternion& quaternion) { return columnsOf(scaled(quaternion)); }

Rigid operator*(const Rigid& a, const Rigid& b) {
  const auto turned = [&](const DDVec3& v) { return a.columns[0] * v.x + a.columns[1] * v.y + a.columns[2] * v.z; };
  return {{turned(b.columns[0]), turned(b.columns[1]), turned(b.columns[2])}, turned(b.origin) + a.origin};
}

Rigid inverse(const Rigid& a) {
  Rigid inverted;
  const auto& [x, y, z] = a.columns;
  inverted.columns = {DDVec3{x.x, y.x, z.x}, DDVec3{x.y, y.y, z.y}, DDVec3{x.z, y.z, z.z}};
  inverted.origin = -DDVec3{dot(x, a.origin), dot(y, a.origin), dot(z, a.origin)};
  return inverted;
}

Mat4 matrixOf(const Rigid& a) {
  const Vec3 x = rounded(a.columns[0]), y = rounded(a.columns[1]), z = rounded(a.columns[2]), t = rounded(a.origin);
  return {{{{x.x, y.x, z.x, t.x}, {x.y, y.y, z.y, t.y}, {x.z, y.z, z.z, t.z}, {0, 0, 0, 1}}}};
}

Json rowsOf(const Rigid& a) { return matrixOf(a).m; }

}  // namespace viewproj::cmd
