#include <cmath>

#include "camera/pose.hpp"
#include "camera/require.hpp"
#include "numbers/dyadic.hpp"
#include "viewproj/matrices.hpp"

namespace viewproj {

using namespace detail;

namespace {

/// Whether twoProd(a, b) is exact.
bool isExactProduct(double a, double b) noexcept {
  constexpr double kLargest = 0x1p900, kSmallest = 0x1p-900;
  if (a == 0 || b == 0) return true;
  const double product = std::fabs(a * b);
  return std::fabs(a) < kLargest && std::fabs(b) < kLargest && product < kLargest && product > kSmallest;
}

}  // namespace

Mat4 worldFromLocal(const Vec3& translation, const Quaternion& rotation, const Vec3& scale) {
  requireFinite(translation, "translation");
  requireFinite(scale, "scale");
  // The rotation is that of a camera whose axes are x right, y up, z back.
  const Pose turned = poseFromRotation({0, 0, 0}, rotation, CameraAxes::RUB, Handedness::right);
  const Axes& axis = parts(turned).columns;
  const DDVec3 axes[] = {axis.right, axis.up, -axis.forward};
  Mat4 m;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) m[i][j] = rounded(toWide(axes[j][i]) * Wide(scale[j]));
    m[i][3] = translation[i];
  }
  m[3][3] = 1;
  return m;
}

Vec4 toWorld(const Mat4& m, const Vec4& p) noexcept {
  const double local[] = {p.x, p.y, p.z, p.w};
  const auto coordinate = [&](std::size_t i) {
    bool isExact = true, isFinite = true;
    for (std::size_t j = 0; j < 4; ++j) {
      isExact = isExact && isExactProduct(m[i][j], local[j]);
      isFinite = isFinite && std::isfinite(m[i][j]) && std::isfinite(local[j]);
    }
    if (isExact) {
      Expansion<8> sum;
      for (std::size_t j = 0; j < 4; ++j) sum.addProduct(m[i][j], local[j]);
      return sum.rounded().hi + 0.0;
    }
    if (!isFinite) return m[i][0] * p.x + m[i][1] * p.y + m[i][2] * p.z + m[i][3] * p.w;
    Dyadic sum;
    for (std::size_t j = 0; j < 4; ++j) sum = sum + Dyadic(m[i][j]) * Dyadic(local[j]);
    return nearestDouble(sum.rounded());
  };
  return {coordinate(0), coordinate(1), coordinate(2), p.w};
}

}  // namespace viewproj
