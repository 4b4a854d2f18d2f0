#include <cmath>

#include "camera/pose.hpp"
#include "camera/require.hpp"
#include "numbers/dyadic.hpp"
#include "viewproj/matrices.hpp"

namespace viewproj {

using namespace detail;

Mat4 worldFromLocal(const Vec3& translation, const Quaternion& rotation, const Vec3& scale) {
  requireNumber(translation, "translation");
  requireNumber(scale, "scale");
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
    DoubleDouble near;
    double size = 0;
    for (std::size_t j = 0; j < 4; ++j) {
      near += twoProd(m[i][j], local[j]);
      size += std::fabs(m[i][j] * local[j]);
    }
    // Products of such a size have underflowed in nothing that counts.
    if (size > 0x1p-800 && size < 0x1p900 && roundsAlike(near, 0x1p-100 * size)) return rounded(near);
    Dyadic<2> sum;
    for (std::size_t j = 0; j < 4; ++j) sum = sum + Dyadic<1>(m[i][j]) * Dyadic<1>(local[j]);
    return nearestDouble(sum.rounded());
  };
  return {coordinate(0), coordinate(1), coordinate(2), p.w};
}

}  // namespace viewproj
