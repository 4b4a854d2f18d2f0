#include "cameras_of/matrix_lens.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "camera/pose.hpp"
#include "numbers/vectors.hpp"

namespace viewproj::detail {
namespace {

/// A far plane beyond infinity by up to this share of 1/near counts as infinite.
constexpr double kTweak = 0x1p-16;

struct Interval {
  DoubleDouble value, low, high;
};

Interval around(DoubleDouble value, double error) noexcept {
  return {value, value - DoubleDouble(error), value + DoubleDouble(error)};
}

/// b must be above 0 or reach down to 0.
PlaneDistance quotient(const Interval& a, const Interval& b) noexcept {
  const auto over = [](DoubleDouble end, DoubleDouble divisor) {
    return divisor.hi > 0 ? end / divisor : DoubleDouble(end.hi == 0 ? 0 : std::copysign(kInfinity, end.hi));
  };
  return {over(a.value, b.value).hi + 0.0, lowerDouble(over(a.low, a.low.hi < 0 ? b.low : b.high)) + 0.0,
          upperDouble(over(a.high, a.high.hi > 0 ? b.low : b.high)) + 0.0};
}

}  // namespace

double lengthOf(const std::array<double, 4>& row) noexcept { return hypotenuse(row[0], row[1], row[2]); }

Mat4 roundingErrors(const Mat4& m) noexcept {
  Mat4 errors;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) errors[i][j] = m[i][j] == 0 ? 0 : halfUlp(m[i][j]);
  return errors;
}

double secondOrder(const Mat4& m, const Mat4& errors) noexcept {
  double largest = 0;
  for (std::size_t i = 0; i < 4; ++i)
    if (const double length = lengthOf(m[i]); length > 0) largest = std::max(largest, lengthOf(errors[i]) / length);
  return 1 / std::max(1 - 4 * largest, 0.05);
}

Vec3 pointErrors(const Mat4& m, const Mat4& errors, const std::array<std::size_t, 3>& rows,
                 const Vec3& point) noexcept {
  const auto row = [&](std::size_t i) { return DDVec3{m[rows[i]][0], m[rows[i]][1], m[rows[i]][2]}; };
  const std::array<DDVec3, 3> columns = inverse({row(0), row(1), row(2)});
  Vec3 result;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::array<double, 4>& e = errors[rows[i]];
    const double off = e[0] * std::fabs(point.x) + e[1] * std::fabs(point.y) + e[2] * std::fabs(point.z) + e[3];
    for (std::size_t j = 0; j < 3; ++j) result[j] += std::fabs(columns[i][j].hi) * off;
  }
  const double more = secondOrder(m, errors);
  return {result.x * more, result.y * more, result.z * more};
}

double fovError(const Mat4& errors, const ClipParts& parts, std::size_t row) noexcept {
  const double k = parts.lines[row].scale.hi, o = parts.lines[row].offset.hi, s = parts.scale.hi;
  const auto along = [&](const DDVec3& axis, std::size_t i) {
    return std::fabs(axis.x.hi) * errors[i][0] + std::fabs(axis.y.hi) * errors[i][1] +
           std::fabs(axis.z.hi) * errors[i][2];
  };
  const DDVec3 &a = parts.axes[row], &f = parts.axes[2];
  const double kError = (along(a, row) + std::fabs(o) * along(a, 3)) / s + k * along(f, 3) / s;
  const double oError = (along(f, row) + std::fabs(o) * along(f, 3) + k * along(a, 3)) / s;
  const double high = (1 - o) / k, low = (-1 - o) / k;
  const double byHigh = 1 / (1 + high * high), byLow = 1 / (1 + low * low);
  const double radians = std::fabs(high * byHigh - low * byLow) / k * kError + std::fabs(byHigh - byLow) / k * oError;
  return radians * 180 / std::numbers::pi;
}

DepthErrors depthErrors(const Mat4& m, const Mat4& entryErrors, const ClipParts& parts) noexcept {
  const auto &z = m[2], &w = m[3];
  const auto step = [&](std::size_t i, std::size_t j) { return entryErrors[i][j]; };
  const double a = parts.lines[2].offset.hi, b = parts.lines[2].scale.hi, s = parts.scale.hi;
  // Perspective's last column: A = z . w / s^2 and B = (z3 - A w3) / s. Orthographic's: A = z3 / s.
  DepthErrors errors;
  (parts.orthographic ? errors.offset : errors.scale) = (step(2, 3) + std::fabs(a) * step(3, 3)) / s;
  if (parts.orthographic) errors.scale = std::fabs(b) * step(3, 3) / s;  // B = |z| / s
  for (std::size_t j = 0; j < 3; ++j) {
    if (parts.orthographic) {
      errors.scale += std::fabs(parts.axes[2][j].hi) * step(2, j) / s;
      continue;
    }
    const double axis = w[j] / s, byW = (z[j] / s - 2 * a * axis) / s;  // A's derivatives by z[j], times s, and by w[j]
    errors.offset += std::fabs(axis) / s * step(2, j) + std::fabs(byW) * step(3, j);
    errors.scale +=
        std::fabs(axis / s * (w[3] / s)) * step(2, j) + std::fabs(byW * (w[3] / s) + b * axis / s) * step(3, j);
  }
  const double margin = secondOrder(m, entryErrors);
  errors.offset *= margin;
  errors.scale *= margin;
  return errors;
}

bool setPerspectiveDepth(MatrixLens& lens, DepthLine depth, DepthErrors errors, DepthEnds z) noexcept {
  const DoubleDouble sign = z.atNear > z.atFar ? 1 : -1;  // of B
  Interval b = around(depth.scale * sign, errors.scale);
  if (!(b.high.hi > 0)) return false;
  if (b.low.hi < 0) b.low = 0;
  if (b.value.hi < 0) b.value = 0;
  const auto below = [&](double d) { return around((DoubleDouble(d) - depth.offset) * sign, errors.offset); };
  const Interval toNear = below(z.atNear), toFar = below(z.atFar);
  if (!(toNear.value.hi > 0)) return false;
  lens.beyondInfinity = toFar.high.hi < 0;
  if (lens.beyondInfinity && !(-toFar.high.hi <= kTweak * toNear.high.hi)) return false;
  lens.zNear = quotient(b, toNear);
  lens.zFar = lens.beyondInfinity ? PlaneDistance{kInfinity, kInfinity, kInfinity} : quotient(b, toFar);
  return true;
}

void setOrthographicDepth(MatrixLens& lens, DepthLine depth, DepthErrors errors, DepthEnds z) noexcept {
  const auto plane = [&](double d) {
    const Interval fromOffset = around(DoubleDouble(d) - depth.offset, errors.offset);
    const PlaneDistance at = quotient(fromOffset, around(depth.scale, errors.scale));
    return z.atNear > z.atFar ? PlaneDistance{0 - at.value, 0 - at.high, 0 - at.low} : at;
  };
  lens.zNear = plane(z.atNear);
  lens.zFar = plane(z.atFar);
}

void setWindow(MatrixLens& lens, const ClipParts& p, NdcY ndcY) {
  const auto edge = [](double ndc, DepthLine line) { return (DoubleDouble(ndc) - line.offset) / line.scale; };
  const DoubleDouble left = edge(-1, p.lines[0]), right = edge(1, p.lines[0]);
  const DoubleDouble low = edge(-1, p.lines[1]), high = edge(1, p.lines[1]);
  const DoubleDouble bottom = ndcY == NdcY::up ? low : -high, top = ndcY == NdcY::up ? high : -low;
  lens.left = rounded(left);
  lens.right = rounded(right);
  lens.bottom = rounded(bottom);
  lens.top = rounded(top);
  const double near = lens.zNear.value, far = lens.zFar.value;
  try {
    if (lens.orthographic)
      lens.projection = made({true, left, right, bottom, top, near, far});
    else if (near > 0 || (!lens.depthFault.empty() && far > 0))
      lens.projection = made({false, left, right, bottom, top, near, far});
  } catch (const CameraError&) {  // NOLINT: no projection
  }
}

}  // namespace viewproj::detail
