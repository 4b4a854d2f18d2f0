#include "cameras_of/clip_parts.hpp"

#include <algorithm>
#include <cmath>

#include "camera/pose.hpp"

namespace viewproj::detail {

Rows rowsOf(const Mat4& m) noexcept {
  Rows rows;
  for (std::size_t i = 0; i < 4; ++i) rows[i] = {{m[i][0], m[i][1], m[i][2]}, m[i][3]};
  return rows;
}

DDVec3 quotient(const WideVec3& a, const Wide& by) noexcept {
  return {toDoubleDouble(a.x / by), toDoubleDouble(a.y / by), toDoubleDouble(a.z / by)};
}

std::optional<ClipParts> perspectiveParts(const Rows& m) noexcept {
  const Row& w = m[3];
  const Dyadic<2> exactSquare = dot(w.axis, w.axis);
  const Wide square = exactSquare.rounded(), length = sqrt(square), unit = square * length;
  ClipParts parts{false, toDoubleDouble(length), {}, {}, 0};
  for (std::size_t i = 0; i < 3; ++i) {
    // The part that is not along the w row, times w . w. It cancels to exactly 0 if there is none.
    const Dyadic<2> along = dot(m[i].axis, w.axis);
    const auto across = [&](const Dyadic<1>& a, const Dyadic<1>& b) { return (a * exactSquare - b * along).rounded(); };
    WideVec3 axis;
    for (std::size_t j = 0; j < 3; ++j) axis[j] = across(m[i].axis[j], w.axis[j]);
    const Wide size = lengthOf(axis);
    if (i < 2 && size.sign() == 0) return std::nullopt;
    parts.lines[i] = {toDoubleDouble(along.rounded() / square),
                      toDoubleDouble((i < 2 ? size : across(m[i].last, w.last)) / unit)};
    if (i < 2)
      parts.axes[i] = quotient(axis, size);
    else
      parts.depthResidual = maxAbs(quotient(axis, unit)) / std::max(1.0, maxAbs(quotient(rounded(m[i].axis), length)));
  }
  parts.axes[2] = quotient(rounded(w.axis), length);
  parts.residual = std::fabs(dot(parts.axes[0], parts.axes[1]).hi);
  return parts;
}

std::optional<ClipParts> orthographicParts(const Rows& m) noexcept {
  const Wide divisor = m[3].last.rounded();
  ClipParts parts{true, toDoubleDouble(divisor), {}, {}, 0};
  for (std::size_t i = 0; i < 3; ++i) {
    const WideVec3 axis = rounded(m[i].axis);
    const Wide size = lengthOf(axis);
    if (size.sign() == 0) return std::nullopt;
    parts.lines[i] = {toDoubleDouble(m[i].last.rounded() / divisor), toDoubleDouble(size / divisor)};
    parts.axes[i] = quotient(axis, size);
  }
  for (std::size_t i = 0; i < 3; ++i)
    parts.residual = std::max(parts.residual, std::fabs(dot(parts.axes[i], parts.axes[(i + 1) % 3]).hi));
  return parts;
}

}  // namespace viewproj::detail
