#include "projection/eye_point.hpp"

#include <algorithm>
#include <cmath>

#include "camera/pose_source.hpp"

namespace viewproj::detail {
namespace {

/// A distance along the view of fewer than this many of its errors says too little of the pixel.
constexpr double kInEyePlane = 0x1p60;

/// point - w * origin, exactly.
using ExactDifference = std::array<Expansion<3>, 3>;

Expansion<3> exactDifference(double value, double w, double origin) noexcept {
  Expansion<3> sum;
  if (origin != 0) sum.addProduct(-origin, w);
  sum.add(value);
  return sum;
}

DoubleDouble relativeTo(double origin, double value, double w) noexcept {
  return w == 1 ? twoDiff(value, origin) : exactDifference(value, w, origin).rounded();
}

double largestOf(const ExactVec3& v) noexcept {
  return maxAbs(Vec3{v[0].rounded().hi, v[1].rounded().hi, v[2].rounded().hi});
}

/// Brought down where a difference of the largest doubles would overflow, up where products would underflow.
int scaleExponent(const Vec4& point, const Vec3& origin, const ExactVec3& translation) noexcept {
  const double largest = std::max({std::fabs(point.x), std::fabs(point.y), std::fabs(point.z),
                                   maxAbs(origin) * std::fabs(point.w), largestOf(translation) * std::fabs(point.w)});
  return largest > 0 && std::isfinite(largest) ? -std::ilogb(largest) : largest > 0 ? -1023 : 0;
}

Vec3 scaled(const Vec3& v, int exponent) noexcept {
  return {std::ldexp(v.x, exponent), std::ldexp(v.y, exponent), std::ldexp(v.z, exponent)};
}

ExactVec3 scaled(const ExactVec3& v, int exponent) noexcept {
  ExactVec3 result;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t t = 0; t < v[i].size(); ++t) result[i].add(std::ldexp(v[i].term(t), exponent));
  return result;
}

/// scale (row . d + w translation)
template <std::size_t Terms>
DoubleDouble distanceAlong(const std::array<Expansion<Terms>, 3>& row, const ExactDifference& d, double w,
                           const Expansion<8>& translation, DoubleDouble scale) noexcept {
  // Two terms for each product of a row's term with one of d's, and of the translation's with w.
  Expansion<Terms * 3 * 2 * 3 + std::size_t{2} * 8> sum;
  for (std::size_t i = 0; i < 3; ++i) sum.addProduct(row[i], d[i]);
  sum.addScaled(translation, w);
  return sum.rounded() * scale;
}

/// The components of a x b. A row of lookAt has up to 8 terms, its direction 2.
std::array<Expansion<64>, 3> exactCross(const ExactVec3& a, const ExactVec3& b) noexcept {
  std::array<Expansion<64>, 3> result;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    result[i].addProduct(a[j], b[k]);
    Expansion<16> negated;
    for (std::size_t t = 0; t < b[j].size(); ++t) negated.add(-b[j].term(t));
    result[i].addProduct(a[k], negated);
  }
  return result;
}

using ExactRow = Vector3<Dyadic>;

template <std::size_t Terms>
ExactRow toDyadic(const std::array<Expansion<Terms>, 3>& row) noexcept {
  ExactRow result;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t t = 0; t < row[i].size(); ++t) result[i] = result[i] + Dyadic(row[i].term(t));
  return result;
}

/// From the rows' terms, which lost nothing.
ExactSource sourceOfRows(const ExactRows& rows) noexcept {
  const auto up = [&] { return rows.upIsCross ? toDyadic(exactCross(rows.right, rows.forward)) : toDyadic(rows.up); };
  return {toDyadic(rows.right),      up(), toDyadic(rows.forward), Wide(rows.rightScale, 0), Wide(rows.upScale, 0),
          Wide(rows.forwardScale, 0)};
}

}  // namespace

Vec4 withUnitWeight(const Vec4& p) noexcept {
  if (p.w == 0 || p.w == 1) return p;
  const int k = -std::ilogb(p.w);
  const Vec4 scaledPoint{std::ldexp(p.x, k), std::ldexp(p.y, k), std::ldexp(p.z, k), std::ldexp(p.w, k)};
  if (isFinite(Vec3{scaledPoint.x, scaledPoint.y, scaledPoint.z})) return scaledPoint;
  return p.w > 0 ? Vec4{p.x, p.y, p.z, 0} : Vec4{-p.x, -p.y, -p.z, 0};
}

EyePoint toEye(const PoseParts& pose, const Vec4& point) noexcept {
  const Vec3 xyz{point.x, point.y, point.z};
  // Scaled down where the difference of the largest doubles would overflow.
  const bool huge = std::max(maxAbs(xyz), maxAbs(pose.eye)) > 0x1p900;
  const double scale = huge ? 0x1p-200 : 1;
  DDVec3 d;
  for (std::size_t i = 0; i < 3; ++i) d[i] = relativeTo(pose.eye[i] * scale, xyz[i] * scale, point.w);
  const int k = exponentToUnit(d);
  d = scaleByPowerOfTwo(d, k);
  const int exponent = -k + (huge ? 200 : 0);
  double residualSize = 0;
  const auto along = [&](const DDVec3& axis, DoubleDouble residual) {
    const DoubleDouble sum = dotOrZero(axis, d);
    if (residual.hi == 0 || point.w == 0) return sum;
    const DoubleDouble rest = scaleByPowerOfTwo(residual * DoubleDouble(point.w), -exponent);
    residualSize = std::max(residualSize, std::fabs(rest.hi));
    return sumOrZero(sum, rest);
  };
  EyePoint e{along(pose.rows.right, pose.residual.x), along(pose.rows.up, pose.residual.y),
             along(pose.rows.forward, pose.residual.z), exponent};
  e.error = 0x1p-98 * (std::fabs(d.x.hi) + std::fabs(d.y.hi) + std::fabs(d.z.hi) + residualSize);
  return e;
}

EyePoint toEyeExactly(const PoseParts& pose, const Vec4& point) noexcept {
  const ExactRows& rows = pose.exact;
  // Well above 1, so that distances far below the largest coordinate keep their digits too.
  const int k = scaleExponent(point, rows.origin, rows.translation) + 500;
  const Vec3 p = scaled({point.x, point.y, point.z}, k);
  const Vec3 origin = scaled(rows.origin, k);
  const ExactVec3 translation = scaled(rows.translation, k);
  const double w = point.w;
  const ExactDifference d{exactDifference(p.x, w, origin.x), exactDifference(p.y, w, origin.y),
                          exactDifference(p.z, w, origin.z)};
  EyePoint e;
  e.right = distanceAlong(rows.right, d, w, translation[0], rows.rightScale);
  e.forward = distanceAlong(rows.forward, d, w, translation[2], rows.forwardScale);
  e.up = rows.upIsCross ? distanceAlong(exactCross(rows.right, rows.forward), d, w, translation[1], rows.upScale)
                        : distanceAlong(rows.up, d, w, translation[1], rows.upScale);
  e.exponent = -k;
  if (rows.error > 0) {
    for (const Expansion<3>& part : d) e.error += rows.error * std::fabs(part.rounded().hi);
    const DoubleDouble scales[] = {rows.rightScale, rows.upScale, rows.forwardScale};
    double largest = 0;
    for (std::size_t i = 0; i < 3; ++i)
      largest = std::max(largest, std::fabs(translation[i].rounded().hi * scales[i].hi));
    e.error += rows.error * largest * std::fabs(w);
    if (std::fabs(e.right.hi) <= e.error) e.right = {};
    if (std::fabs(e.up.hi) <= e.error) e.up = {};
    if (std::fabs(e.forward.hi) <= kInEyePlane * e.error) e.forward = {};
  }
  return e;
}

bool isInExactRange(const PoseParts& pose, const Vec4& point) noexcept {
  const ExactRows& rows = pose.exact;
  if (!rows.isNarrow) return false;
  // Differences of such coordinates have terms of 2^-300 and more, and row terms are 2^-250 and more, an up's of two
  // 2^-600: their products are above 2^-969 (error_free.hpp).
  constexpr double kSmallest = 0x1p-200;
  const int k = scaleExponent(point, rows.origin, rows.translation) + 500;
  // Of a direction, origin and translation may be too large as well.
  const auto hasDigits = [&](double value) {
    const double size = std::fabs(std::ldexp(value, k));
    return value == 0 || (size >= kSmallest && size <= 0x1p502);
  };
  for (const Vec3& v : {Vec3{point.x, point.y, point.z}, rows.origin})
    for (std::size_t i = 0; i < 3; ++i)
      if (!hasDigits(v[i])) return false;
  for (const Expansion<8>& part : rows.translation)
    for (std::size_t t = 0; t < part.size(); ++t)
      if (!hasDigits(part.term(t))) return false;
  return true;
}

WideEyePoint toEyeWidely(const PoseParts& pose, const Vec4& point) noexcept {
  const ExactRows& rows = pose.exact;
  const bool hasSource = rows.source.kind != PoseSource::Kind::rows && !rows.isNarrow;
  const ExactSource source = hasSource ? exactSource(rows.source) : sourceOfRows(rows);
  const Dyadic w = point.w;
  const Vec3 xyz{point.x, point.y, point.z};
  ExactRow d;
  for (std::size_t i = 0; i < 3; ++i) d[i] = Dyadic(xyz[i]) - Dyadic(rows.origin[i]) * w;
  const ExactRow translation = toDyadic(rows.translation);
  const auto along = [&](const ExactRow& row, std::size_t i, const Wide& scale) {
    return (dot(row, d) + translation[i] * w).rounded() * scale;
  };
  WideEyePoint e{along(source.right, 0, source.rightScale), along(source.up, 1, source.upScale),
                 along(source.forward, 2, source.forwardScale), 0};
  if (rows.error > 0) {
    for (const Dyadic& part : {d.x, d.y, d.z}) e.error = e.error + magnitude(part.rounded()) * Wide(rows.error);
    const Wide scales[] = {source.rightScale, source.upScale, source.forwardScale};
    Wide largest;
    for (std::size_t i = 0; i < 3; ++i)
      if (const Wide size = magnitude(translation[i].rounded() * scales[i]); (size - largest).sign() > 0)
        largest = size;
    e.error = e.error + largest * magnitude(point.w) * Wide(rows.error);
    const auto isAbove = [](const Wide& a, const Wide& b) { return (magnitude(a) - b).sign() > 0; };
    if (!isAbove(e.right, e.error)) e.right = {};
    if (!isAbove(e.up, e.error)) e.up = {};
    if (!isAbove(e.forward, e.error * Wide(kInEyePlane))) e.forward = {};
  }
  return e;
}

}  // namespace viewproj::detail
