// Pixels of cameras with a lens, from tangents in double-double: what the kernel leaves, and bounds.
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

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

double length(double x, double y) noexcept { return std::sqrt(x * x + y * y); }

double scaleOf(const CameraParts& c) noexcept {
  return std::max(std::fabs(c.screen.scaleX.hi), std::fabs(c.screen.scaleY.hi));
}

/// How far a pixel may be from the true one before it is rounded; error: of tangents, shift: its way from the centre.
double errorOf(const CameraParts& c, double stretch, double rounding, double error, double shift) noexcept {
  const double reach = std::max(c.screen.reachX, c.screen.reachY);
  return scaleOf(c) * (1.5 * stretch * error + rounding * kFineUnit) + kExactParameter * (reach + 4 * shift);
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

NearestPixel detail::bentPixel(const CameraParts& c, const BoundedTangents& t) noexcept {
  const auto bent = distort<DoubleDouble>(*c.lens, t.at);
  const DoubleDouble stepX = c.screen.scaleX * bent.x, stepY = -(c.screen.scaleY * bent.y);
  const DoubleDouble x = c.screen.centerX + stepX, y = c.screen.centerY + stepY;
  if (!(std::isfinite(x.hi) && std::isfinite(y.hi))) return {{kNaN, true}, {kNaN, true}};
  const auto [stretch, rounding] = roughly(*c.lens, t.radius(), t.error);
  const double error = errorOf(c, stretch, rounding, t.error, std::fabs(stepX.hi) + std::fabs(stepY.hi));
  return {{rounded(x), roundsAlike(x, error)}, {rounded(y), roundsAlike(y, error)}};
}

WindowPoint detail::beforeLens(const CameraParts& c, const Vec2& screen) noexcept {
  const ScreenMap& m = c.screen;
  const Tangents<DoubleDouble> at =
      undistort(*c.lens, {sumOrZero(screen.x, -m.centerX) / m.scaleX, -(sumOrZero(screen.y, -m.centerY) / m.scaleY)})
          .at;
  return {at.x, -at.y};
}

double detail::boundThroughLens(const Camera& camera, const Vec4& point, double shift) noexcept {
  const CameraParts& c = parts(camera);
  const ScreenPoint p = worldToScreen(camera, point);
  if (p.status != PointStatus::inFront) return kInfinity;
  const double rounding = halfUlp(std::max(std::fabs(p.x), std::fabs(p.y))) * 2 * kExactUlps;
  if (p.certain && shift == 0) return rounding;
  const BoundedTangents t = exactTangents(c, point);
  const double r = t.radius(), around = 2 * t.error + 0x1p-45 * r + shift / scaleOf(c);
  const Response response = responseOver(*c.lens, {std::max(0.0, r - around), r + around});
  return rounding + shift * response.stretch +
         errorOf(c, response.stretch, response.rounding, t.error, scaleOf(c) * response.stretch * r);
}

ErrorBound detail::boundInPictureThroughLens(const CameraParts& c) noexcept {
  const Vec2 reach = pictureReach(c);
  const double position = std::max(std::fabs(c.screen.centerX.hi) + reach.x, std::fabs(c.screen.centerY.hi) + reach.y);
  const double end = picturePreimage(c), step = 0.01 * std::min(end, 1.0);
  double worst = 0;
  for (double low = 0, high; low < end; low = high) {
    high = std::min(end, low * 1.02 + step);
    const Response response = responseOver(*c.lens, {low, high});
    const double error = 0x1p-97 * high + 0x1p-200 * (1 + high) * (1 + high);
    worst =
        std::max(worst, errorOf(c, response.stretch, response.rounding, error, scaleOf(c) * response.stretch * high));
  }
  return {halfUlp(position) * 1.02 + worst, boundWithin(*c.pinhole, reach, Precision::exact).depth};
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
