#include "camera/pose_source.hpp"

#include <utility>

namespace viewproj::detail {
namespace {

using Row = Vector3<Dyadic>;

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
  result.right = crossOf(result.forward, toDyadic(up));
  result.up = crossOf(result.right, result.forward);
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
  const Row x = toDyadic(source.numbers[0]), y = toDyadic(source.numbers[1]), z = toDyadic(source.numbers[2]);
  const std::array<Row, 3> adjugate = {crossOf(y, z), crossOf(z, x), crossOf(x, y)};
  return named(source, adjugate, Wide(1) / dot(adjugate[0], x).rounded());
}

}  // namespace

ExactSource exactSource(const PoseSource& source) noexcept {
  if (source.kind == PoseSource::Kind::rotation) return rotation(source);
  return source.kind == PoseSource::Kind::columns ? columns(source) : look(source);
}

}  // namespace viewproj::detail
