#include "camera/pose_source.hpp"

#include <utility>

namespace viewproj {
namespace {

using Row = std::array<Dyadic, 3>;

Row exactly(const Vec3& v) noexcept { return {v.x, v.y, v.z}; }

Row cross(const Row& a, const Row& b) noexcept {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Dyadic dot(const Row& a, const Row& b) noexcept { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Wide inverseLength(const Row& a) noexcept {
  const Wide squared = dot(a, a).rounded();
  return squared.sign() == 0 ? Wide(0) : Wide(1) / sqrt(squared);
}

/// x, y, z of the camera to right, up, forward.
ExactSource named(const PoseSource& source, const std::array<Row, 3>& xyz, const Wide& scale) noexcept {
  ExactSource result;
  Row* const rows[] = {&result.right, &result.up, &result.forward};
  Wide* const scales[] = {&result.rightScale, &result.upScale, &result.forwardScale};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto along = static_cast<std::size_t>(source.along[i]);
    *rows[along] = xyz[i];
    *scales[along] = scale * Wide(source.sign[i]);
  }
  return result;
}

ExactSource look(const PoseSource& source) noexcept {
  const auto& [from, to, up] = source.numbers;
  ExactSource result;
  for (std::size_t i = 0; i < 3; ++i) result.forward[i] = Dyadic::difference(to[i], from[i]);
  result.right = cross(result.forward, exactly(up));
  result.up = cross(result.right, result.forward);
  const Wide handed = source.leftHanded ? -1 : 1;
  result.forwardScale = inverseLength(result.forward);
  const Wide rightScale = inverseLength(result.right);
  result.rightScale = rightScale * handed;
  result.upScale = rightScale * result.forwardScale;
  return result;
}

ExactSource rotation(const PoseSource& source) noexcept {
  const Dyadic x = source.numbers[0].x, y = source.numbers[0].y, z = source.numbers[0].z, w = source.numbers[1].x;
  const Dyadic xx = x * x, yy = y * y, zz = z * z, ww = w * w;
  const auto twice = [](const Dyadic& a) { return a + a; };
  const Dyadic xy = x * y, zw = z * w, xz = x * z, yw = y * w, yz = y * z, xw = x * w;
  const std::array<Row, 3> columns = {{
      {ww + xx - yy - zz, twice(xy + zw), twice(xz - yw)},
      {twice(xy - zw), ww - xx + yy - zz, twice(yz + xw)},
      {twice(xz + yw), twice(yz - xw), ww - xx - yy + zz},
  }};
  return named(source, columns, Wide(1) / (xx + yy + zz + ww).rounded());
}

ExactSource columns(const PoseSource& source) noexcept {
  const Row x = exactly(source.numbers[0]), y = exactly(source.numbers[1]), z = exactly(source.numbers[2]);
  const std::array<Row, 3> adjugate = {cross(y, z), cross(z, x), cross(x, y)};
  return named(source, adjugate, Wide(1) / dot(adjugate[0], x).rounded());
}

}  // namespace

ExactSource exactSource(const PoseSource& source) noexcept {
  switch (source.kind) {
    case PoseSource::Kind::look:
      return look(source);
    case PoseSource::Kind::rotation:
      return rotation(source);
    case PoseSource::Kind::columns:
      return columns(source);
    case PoseSource::Kind::rows:
      break;
  }
  return {};
}

}  // namespace viewproj
