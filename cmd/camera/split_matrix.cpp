#include "camera/split_matrix.hpp"

#include <algorithm>
#include <cmath>

#include "viewproj/camera.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

DoubleDouble length(const DDVec3& a) { return DoubleDouble(1) / inverseLength(a); }

}  // namespace

SplitMatrix splitMatrix(std::span<const double> p) {
  //     | fx 0  cx |                   row 3 of P's left part is r3 up to its length, row 2 is fy r2 + cy r3,
  // P = | 0  fy cy | [R | t],  R = r1, row 1 is fx r1 + cx r3 (with a skew also r2)
  //     | 0  0  1  |              r2,
  //                               r3
  if (!std::all_of(p.begin(), p.end(), [](double n) { return std::isfinite(n); }))
    throw CameraError("P", "has an entry that is not a finite number");
  DDVec3 m1{p[0], p[1], p[2]}, m2{p[4], p[5], p[6]}, m3{p[8], p[9], p[10]}, p4{p[3], p[7], p[11]};
  if (!(maxAbs(m1) > 0 && maxAbs(m2) > 0 && maxAbs(m3) > 0))
    throw CameraError("P", "is not of the form K [R | t]: its left 3x3 has a row of zeros");
  // P and -P are the same camera. One of the two has a rotation.
  if (dot(m1, cross(m2, m3)).hi < 0) {
    m1 = -m1;
    m2 = -m2;
    m3 = -m3;
    p4 = -p4;
  }
  constexpr double kNone = 0x1p-80;  // the rounding error of a difference of equals
  const DoubleDouble one = 1, scale = length(m3);
  const bool hasUnitRow = p[8] == 0 && p[9] == 0 && p[10] == 1;
  const DDVec3 r3 = hasUnitRow ? m3 : m3 * (one / scale);
  const DoubleDouble cy = dot(m2, r3), cx = dot(m1, r3);
  const DDVec3 rest2 = m2 + r3 * -cy;
  if (!(maxAbs(rest2) > kNone * maxAbs(m2)))
    throw CameraError("P", "is not of the form K [R | t]: its rows lie in a plane");
  const DoubleDouble fy = length(rest2);
  const DDVec3 r2 = rest2 * (one / fy);
  const DoubleDouble skew = dot(m1, r2);
  const DDVec3 rest1 = m1 + r3 * -cx + r2 * -skew;
  if (!(maxAbs(rest1) > kNone * maxAbs(m1)))
    throw CameraError("P", "is not of the form K [R | t]: its rows lie in a plane");
  const DoubleDouble fx = length(rest1);
  SplitMatrix split;
  const DDVec3 r1 = rest1 * (one / fx);
  const DoubleDouble unit = hasUnitRow ? one : one / scale;
  split.fx = fx * unit;
  split.fy = fy * unit;
  split.cx = cx * unit;
  split.cy = cy * unit;
  split.skew = skew * unit;
  split.columns = {r1, r2, r3};  // the rows of R are the camera's axes in the world
  // t = K^-1 p4, eye = -R^T t.
  const DoubleDouble tz = p4.z * unit;
  const DoubleDouble ty = (p4.y * unit - split.cy * tz) / split.fy;
  const DoubleDouble tx = (p4.x * unit - split.skew * ty - split.cx * tz) / split.fx;
  split.eye = -(r1 * tx + r2 * ty + r3 * tz);
  return split;
}

bool hasSkew(const SplitMatrix& split) {
  constexpr double kSkew = 1e-6;  // relative to fx
  return !(std::fabs(split.skew.hi) <= kSkew * split.fx.hi);
}

void requireNoSkew(const SplitMatrix& split) {
  if (hasSkew(split)) throw CameraError("P", "has a skew: pixels of a skewed grid are not modelled");
}

}  // namespace viewproj::cmd
