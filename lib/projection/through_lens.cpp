// standard bends the pinhole's pixel, in double. exact bends the point's tangents, in double-double: as the rounded
// rows give them or, where that cannot certify the pixel, as the exact rows do.
#include "projection/through_lens.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lens/response.hpp"
#include "projection/exact_point.hpp"
#include "projection/kernels/error_model.hpp"

namespace viewproj {

using namespace detail;
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Points with larger tangents are projected exactly: standard's bound grows with them.
constexpr double kFarAside = 32;

double length(double x, double y) noexcept { return std::sqrt(x * x + y * y); }

/// Each of the two is within error of the true one.
struct BoundedTangents {
  Tangents<DoubleDouble> at;
  double error;

  double radius() const noexcept { return length(at.x.hi, at.y.hi); }
};

/// row . d + residual, within 2^-97 of the sum of the products' sizes and the residual: what is below a product's last
/// place is added up in double.
DoubleDouble along(const DDVec3& row, const DDVec3& d, const DoubleDouble& residual) noexcept {
  DoubleDouble sum = residual;
  for (std::size_t i = 0; i < 3; ++i) {
    const DoubleDouble product = twoProd(row[i].hi, d[i].hi), high = twoSum(sum.hi, product.hi);
    sum = {high.hi, sum.lo + (high.lo + (product.lo + (row[i].hi * d[i].lo + row[i].lo * d[i].hi)))};
  }
  return twoSum(sum.hi, sum.lo);
}

/// Of a point in front of the camera; the error is infinite where this is no way.
BoundedTangents tangentsOf(const CameraParts& c, const Vec4& p) noexcept {
  const PoseParts& pose = c.pose;
  const DDVec3 d{twoDiff(p.x, pose.eye.x), twoDiff(p.y, pose.eye.y), twoDiff(p.z, pose.eye.z)},
      &residual = pose.residual;
  const DoubleDouble x = along(pose.rows.right, d, residual.x), y = along(pose.rows.up, d, residual.y);
  const DoubleDouble w = along(pose.rows.forward, d, residual.z);
  const double size = std::fabs(d.x.hi) + std::fabs(d.y.hi) + std::fabs(d.z.hi) + std::fabs(residual.x.hi) +
                      std::fabs(residual.y.hi) + std::fabs(residual.z.hi);
  const double share = 0x1p-96 * size / w.hi;
  if (!(p.w == 1 && share < 0x1p-60 && share >= 0)) return {{}, kInfinity};
  const DoubleDouble inverse = DoubleDouble(1) / w;
  const BoundedTangents t{{x * inverse, -(y * inverse)}, 0};
  return {t.at, share * (1 + t.radius()) * 1.01 + 0x1p-101 * t.radius()};
}

BoundedTangents exactTangentsOf(const CameraParts& c, const Vec4& point) noexcept {
  const AxisDistances a = exactDistances(c.pose, point);
  const BoundedTangents t{{toDoubleDouble(a.right / a.forward), toDoubleDouble(-(a.up / a.forward))}, 0};
  const double r = t.radius();
  const double ofRows = a.error.sign() > 0 ? double(a.error / (magnitude(a.forward) - a.error)) * (1 + r) : 0;
  return {t.at, 0x1p-97 * r + 1.01 * ofRows};
}

double scaleOf(const CameraParts& c) noexcept {
  return std::max(std::fabs(c.screen.scaleX.hi), std::fabs(c.screen.scaleY.hi));
}
double reachOf(const CameraParts& c) noexcept { return std::max(c.screen.reachX, c.screen.reachY); }

/// How far a pixel may be from the true one before it is rounded, in double-double; shift: its way from the centre.
double fineError(const CameraParts& c, double stretch, double rounding, double error, double shift) noexcept {
  return scaleOf(c) * (1.5 * stretch * error + rounding * kFineUnit) + kExactParameter * (reachOf(c) + 4 * shift);
}

struct Pixel {
  Vec2 at;
  bool isCertain;
};

Pixel finePixel(const CameraParts& c, const BoundedTangents& t) noexcept {
  const auto bent = distort<DoubleDouble>(*c.lens, t.at);
  const DoubleDouble stepX = c.screen.scaleX * bent.x, stepY = -(c.screen.scaleY * bent.y);
  const DoubleDouble x = c.screen.centerX + stepX, y = c.screen.centerY + stepY;
  const Roughly rough = roughly(*c.lens, t.radius() * (1 + 0x1p-40));
  const double error = fineError(c, rough.stretch, rough.rounding, t.error, std::fabs(stepX.hi) + std::fabs(stepY.hi));
  return {{rounded(x), rounded(y)}, roundsAlike(x, error) && roundsAlike(y, error)};
}

Pixel exactPixel(const CameraParts& c, const Vec4& point) noexcept {
  const BoundedTangents t = tangentsOf(c, point);
  if (t.error < kInfinity)
    if (const Pixel p = finePixel(c, t); p.isCertain || std::isnan(p.at.x)) return p;
  return finePixel(c, exactTangentsOf(c, point));
}

/// What was the pinhole's pixel as tangents.
Tangents<double> tangentsAt(const CameraParts& c, const Vec2& pixel) noexcept {
  const ScreenMap& m = c.screen;
  return {((pixel.x - m.centerX.hi) - m.centerX.lo) / m.scaleX.hi,
          -(((pixel.y - m.centerY.hi) - m.centerY.lo) / m.scaleY.hi)};
}

Vec2 standardPixel(const CameraParts& c, const Vec2& pinhole) noexcept {
  const ScreenMap& m = c.screen;
  const Tangents<double> bent = distort<double>(*c.lens, tangentsAt(c, pinhole));
  return {m.centerX.hi + (m.scaleX.hi * bent.x + m.centerX.lo), m.centerY.hi - (m.scaleY.hi * bent.y - m.centerY.lo)};
}

/// Of a pixel in standard: pinhole is the bound of the pinhole's.
double standardError(const CameraParts& c, const Response& response, double radius, double pinhole,
                     double position) noexcept {
  const double least = std::min(std::fabs(c.screen.scaleX.hi), std::fabs(c.screen.scaleY.hi)), scale = scaleOf(c);
  const double error = pinhole / least + 5 * kUnitDouble * radius;
  const double put = radius * response.stretch;
  return 1.01 * (scale * (1.5 * response.stretch * error + kUnitDouble * (response.rounding + 4 * put)) +
                 2 * kUnitDouble * position + kExactParameter * reachOf(c));
}

/// Distances from the axis within a share of this one.
Range around(double radius, double error) noexcept {
  const double reach = 2 * error + 0x1p-45 * radius;
  return {std::max(0.0, radius - reach), radius + reach};
}

/// Points of the picture have tangents below this, or as far as the lens goes: |put| >= r g - 3 P r^2, which rises.
double picturePreimage(const CameraParts& c) noexcept {
  const LensParts& lens = *c.lens;
  const Vec2 reach = pictureReach(c);
  const double edge = length(reach.x / c.screen.scaleX.hi, reach.y / c.screen.scaleY.hi) * (1 + 0x1p-40);
  const double end = lens.model == LensModel::brown ? lens.end : kLargestTangent;
  double low = 0, high = end;
  for (int i = 0; i < 200 && high - low > 0x1p-20 * high; ++i) {
    const double r = low + (high - low) / 2;
    const double put = r * radialFactor(lens, r * r) - 3 * lens.tangential * r * r;
    (put < edge ? low : high) = r;
  }
  return high;
}

}  // namespace

ScreenPoint detail::throughLens(const Camera& camera, const Vec4& point, Precision precision) noexcept {
  const CameraParts& c = parts(camera);
  ScreenPoint p = worldToScreen(withoutLens(camera), point, precision);  // the pinhole's
  if (p.status != PointStatus::inFront) return p;
  if (p.precision == Precision::standard) {
    const auto [x, y] = tangentsAt(c, {p.x, p.y});
    if (!(length(x, y) < kFarAside)) p = worldToScreen(withoutLens(camera), point, Precision::exact);
  }
  const Pixel pixel =
      p.precision == Precision::standard ? Pixel{standardPixel(c, {p.x, p.y}), false} : exactPixel(c, point);
  const std::uint8_t ofDirection = point.w == 0 ? p.outside & sideFar : 0;
  p.x = pixel.at.x;
  p.y = pixel.at.y;
  p.certain = p.certain && pixel.isCertain;
  if (std::isfinite(p.x) && std::isfinite(p.y)) {
    p.outside = static_cast<std::uint8_t>(sidesBeyond(c, p) | ofDirection);
  } else {
    p.x = p.y = std::numeric_limits<double>::quiet_NaN();
    p.status = PointStatus::beyondLens;
    p.outside = 0;
  }
  return p;
}

WindowPoint detail::beforeLens(const CameraParts& c, const Vec2& screen) noexcept {
  const ScreenMap& m = c.screen;
  const Tangents<DoubleDouble> at =
      undistort(*c.lens, {sumOrZero(screen.x, -m.centerX) / m.scaleX, -(sumOrZero(screen.y, -m.centerY) / m.scaleY)})
          .at;
  return {at.x, -at.y};
}

ErrorBound detail::boundThroughLens(const Camera& camera, const Vec4& point, Precision precision) noexcept {
  const CameraParts& c = parts(camera);
  const ScreenPoint p = worldToScreen(camera, point, precision);
  if (p.status != PointStatus::inFront) return {kInfinity, kInfinity};
  ErrorBound bound = boundOfPoint(withoutLens(camera), point, precision);
  const double position = std::max(std::fabs(p.x), std::fabs(p.y));
  if (p.precision == Precision::standard) {
    const BoundedTangents t = tangentsOf(c, point);
    const double r = t.radius();
    const double least = std::min(std::fabs(c.screen.scaleX.hi), std::fabs(c.screen.scaleY.hi));
    bound.screen = standardError(c, responseOver(*c.lens, around(r, bound.screen / least)), r, bound.screen, position);
    return bound;
  }
  bound.screen = halfUlp(position) * 2 * kExactUlps;
  if (!p.certain) {
    const BoundedTangents t = exactTangentsOf(c, point);
    const Response response = responseOver(*c.lens, around(t.radius(), t.error));
    bound.screen +=
        fineError(c, response.stretch, response.rounding, t.error, scaleOf(c) * response.stretch * t.radius());
  }
  return bound;
}

ErrorBound detail::boundInPictureThroughLens(const Camera& camera, Precision precision) noexcept {
  const CameraParts& c = parts(camera);
  const Vec2 reach = pictureReach(c);
  const double position = std::max(std::fabs(c.screen.centerX.hi) + reach.x, std::fabs(c.screen.centerY.hi) + reach.y);
  const double end = picturePreimage(c), step = 0.01 * std::min(end, 1.0);
  ErrorBound bound;
  for (double low = 0, high; low < end; low = high) {
    high = std::min(end, low * 1.02 + step);
    const Response response = responseOver(*c.lens, {low, high});
    const Vec2 sofar{std::fabs(c.screen.scaleX.hi) * high, std::fabs(c.screen.scaleY.hi) * high};
    ErrorBound piece = boundWithin(*c.pinhole, sofar, precision);
    if (precision == Precision::standard && low < kFarAside && piece.screen < kInfinity) {
      piece.screen = standardError(c, response, high, piece.screen, position);
    } else {  // what standard cannot bound is projected exactly
      piece = boundWithin(*c.pinhole, sofar, Precision::exact);
      const double error = 0x1p-97 * high + 0x1p-200 * (1 + high) * (1 + high);
      piece.screen = halfUlp(position) * 1.02 +
                     fineError(c, response.stretch, response.rounding, error, scaleOf(c) * response.stretch * high);
    }
    bound = {std::max(bound.screen, piece.screen), std::max(bound.depth, piece.depth)};
  }
  return bound;
}

double largestShift(const Camera& camera) noexcept {
  const CameraParts& c = parts(camera);
  if (!c.lens) return 0;
  constexpr int kSteps = 16;
  double largest = 0;
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; j <= kSteps; ++j) {
      const auto between = [](double first, double last, int step) { return first + (last - first) * step / kSteps; };
      const Vec2 pixel{between(c.corners.first.x, c.corners.last.x, i),
                       between(c.corners.first.y, c.corners.last.y, j)};
      const Vec3 ray = screenToRay(camera, pixel).direction;
      const ScreenPoint pinhole = worldToScreen(withoutLens(camera), Vec4{ray.x, ray.y, ray.z, 0});
      largest = std::fmax(largest, length(pinhole.x - pixel.x, pinhole.y - pixel.y));  // a NaN counts as nothing
    }
  return largest;
}

}  // namespace viewproj
