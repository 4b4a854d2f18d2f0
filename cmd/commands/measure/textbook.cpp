#include "commands/measure/textbook.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "camera/convention.hpp"
#include "camera/depth.hpp"
#include "viewproj/matrices.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

Vec3 unproject(const Mat4& worldFromClip, double x, double y, double z) {
  const auto along = [&](std::size_t row) {
    const auto& r = worldFromClip[row];
    return r[0] * x + r[1] * y + r[2] * z + r[3];
  };
  const double w = along(3);
  return {along(0) / w, along(1) / w, along(2) / w};
}

}  // namespace

template <class T>
TextbookCamera<T> textbookCamera(const Camera& camera) {
  const Mat4 matrix = clipFromWorld(camera.pose(), camera.projection(), camera.convention());
  const Mat4 viewport = screenFromNdc(camera.viewport(), camera.convention());
  TextbookCamera<T> t;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) t.clipFromWorld[i][j] = static_cast<T>(matrix[i][j]);
  for (std::size_t i = 0; i < 3; ++i) {
    t.scale[i] = static_cast<T>(viewport[i][i]);
    t.offset[i] = static_cast<T>(viewport[i][3]);
  }
  return t;
}

template <class T>
void projectByMatrix(const TextbookCamera<T>& camera, std::span<const Vector3<T>> points,
                     std::span<Vector3<T>> screen) {
  const auto& m = camera.clipFromWorld;
  const std::size_t count = std::min(points.size(), screen.size());
  for (std::size_t i = 0; i < count; ++i) {
    const Vector3<T> p = points[i];
    const T x = m[0][0] * p.x + m[0][1] * p.y + m[0][2] * p.z + m[0][3];
    const T y = m[1][0] * p.x + m[1][1] * p.y + m[1][2] * p.z + m[1][3];
    const T z = m[2][0] * p.x + m[2][1] * p.y + m[2][2] * p.z + m[2][3];
    const T w = m[3][0] * p.x + m[3][1] * p.y + m[3][2] * p.z + m[3][3];
    const T perW = w > 0 ? T(1) / w : std::numeric_limits<T>::quiet_NaN();
    screen[i] = {camera.offset[0] + camera.scale[0] * (x * perW), camera.offset[1] + camera.scale[1] * (y * perW),
                 camera.offset[2] + camera.scale[2] * (z * perW)};
  }
}

template TextbookCamera<double> textbookCamera<double>(const Camera&);
template TextbookCamera<float> textbookCamera<float>(const Camera&);
template void projectByMatrix<double>(const TextbookCamera<double>&, std::span<const Vector3<double>>,
                                      std::span<Vector3<double>>);
template void projectByMatrix<float>(const TextbookCamera<float>&, std::span<const Vector3<float>>,
                                     std::span<Vector3<float>>);

TextbookInverse textbookInverse(const Camera& camera) {
  const Mat4 viewport = ndcFromScreen(camera.viewport(), camera.convention());
  const DepthEnds depths = ndcDepths(camera.convention());
  return {worldFromClip(camera.pose(), camera.projection(), camera.convention()),
          {viewport[0][0], viewport[1][1]},
          {viewport[0][3], viewport[1][3]},
          depths.atNear,
          depths.atFar};
}

void castByInverse(const TextbookInverse& inverse, std::span<const Vec2> pixels, std::span<Vec3> directions) {
  const std::size_t count = std::min(pixels.size(), directions.size());
  for (std::size_t i = 0; i < count; ++i) {
    const double x = inverse.offset[0] + inverse.scale[0] * pixels[i].x;
    const double y = inverse.offset[1] + inverse.scale[1] * pixels[i].y;
    const Vec3 near = unproject(inverse.worldFromClip, x, y, inverse.ndcNear);
    const Vec3 far = unproject(inverse.worldFromClip, x, y, inverse.ndcFar);
    const Vec3 d{far.x - near.x, far.y - near.y, far.z - near.z};
    const double length = std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
    directions[i] = {d.x / length, d.y / length, d.z / length};
  }
}

}  // namespace viewproj::cmd
