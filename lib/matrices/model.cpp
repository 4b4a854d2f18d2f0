#include "camera/pose.hpp"
#include "camera/require.hpp"
#include "viewproj/matrices.hpp"

namespace viewproj {

using namespace detail;

Mat4 worldFromLocal(const Vec3& translation, const Quaternion& rotation, const Vec3& scale) {
  requireFinite(translation, "translation");
  requireFinite(scale, "scale");
  // The rotation is that of a camera whose axes are x right, y up, z back.
  const Pose turned = poseFromRotation({0, 0, 0}, rotation, CameraAxes::RUB, Handedness::right);
  const Axes& axis = parts(turned).columns;
  const DDVec3 axes[] = {axis.right, axis.up, -axis.forward};
  Mat4 m;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) m[i][j] = (axes[j][i] * DoubleDouble(scale[j])).hi + 0.0;
    m[i][3] = translation[i];
  }
  m[3][3] = 1;
  return m;
}

Vec4 toWorld(const Mat4& m, const Vec4& p) noexcept {
  const auto coordinate = [&](std::size_t i) {
    Expansion<8> sum;
    sum.addProduct(m[i][0], p.x);
    sum.addProduct(m[i][1], p.y);
    sum.addProduct(m[i][2], p.z);
    sum.addProduct(m[i][3], p.w);
    return sum.rounded().hi + 0.0;
  };
  return {coordinate(0), coordinate(1), coordinate(2), p.w};
}

}  // namespace viewproj
