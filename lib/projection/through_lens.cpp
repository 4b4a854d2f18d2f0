#include "projection/through_lens.hpp"

#include <algorithm>
#include <cmath>

#include "lens/inverse.hpp"
#include "numbers/vectors.hpp"
#include "projection/exact_point.hpp"
#include "projection/kernels/error_model.hpp"
#include "projection/kernels/kernels.hpp"

namespace viewproj {

using namespace detail;
namespace {

double scaleOf(const CameraParts& c) noexcept {
  return std::max(std::fabs(c.screen.scaleX.hi), std::fabs(c.screen.scaleY.hi));
}

/// Of operations, where each distance is off by 2^-98 of itself: that is one rounding more, and an angle has its own.
double unitOf(const LensParts& lens) noexcept { return lens.isAngle ? kFineUnit : kExactParameter; }

/// How far a pixel may be from the true one before it is rounded; error: of the plane, shift: its way from the centre.
double pixelError(const CameraParts& c, double error, double shift) noexcept {
  const double reach = std::max(c.screen.reachX, c.screen.reachY);
  return scaleOf(c) * error + kExactParameter * (reach + 4 * shift);
}

/// A pixel before it is rounded, and its error.
struct FinePixel {
  DoubleDouble x, y;
  double error;
};
/// turned: how far the direction may be from the true one, in radians.
FinePixel finePixel(const CameraParts& c, const Sight<DoubleDouble>& sight, double turned = 0) noexcept {
  const LensParts& lens = *c.lens;
  const auto mapped = mapOf(lens, sight);
  const auto put = planeOf(lens, mapped);
  const DoubleDouble stepX = c.screen.scaleX * put.x, stepY = -(c.screen.scaleY * put.y);
  const double aside = std::sqrt(mapped.square.hi), d1 = length(aside, sight.forward.hi);
  // Twice the angle covers its second order. On the axis the slope is 1.
  const double error = aside > 0 ? errorOf(lens, aside, d1, mapped.measure.hi, 2 * turned, unitOf(lens)) : 2 * turned;
  return {c.screen.centerX + stepX, c.screen.centerY + stepY,
          pixelError(c, error, std::fabs(stepX.hi) + std::fabs(stepY.hi))};
}

/// The largest turn whose second order is small.
constexpr double kLargestTurn = 1e-6;

/// How far a point's direction may be from the true one, in radians, if the point may be so far off.
double turnOf(const CameraParts& c, const Vec4& point, double pointError) noexcept {
  const auto [eye, angle] = c.pose.error;
  const double away = point.w == 0 ? 0 : eye + pointError;
  if (!(away > 0)) return angle;
  const double distance =
      hypotenuse(point.x / point.w - c.pose.eye.x, point.y / point.w - c.pose.eye.y, point.z / point.w - c.pose.eye.z);
  return away < distance ? angle + away / (distance - away) : kInfinity;
}

/// The largest error of a pixel in the picture that is not certain.
double errorInPicture(const CameraParts& c) noexcept {
  const LensParts& lens = *c.lens;
  const Vec2 reach = pictureReach(c);
  const double edge =
      length(reach.x / c.screen.scaleX.hi, reach.y / c.screen.scaleY.hi) * (1 + 0x1p-40) / lens.scale.hi;
  const double ofPose = 0x1p-200;
  double worst = 0;
  if (lens.isAngle) {
    // rho d1 / R grows without bound towards straight back, but not times an error relative to R.
    const Response<double> all = angleResponse(lens, lens.angleEnd, 1.0);
    worst = all.rounding * kFineUnit;
  } else {
    // In steps of the radius before Brown's polynomials, up to one that puts everything beyond the picture.
    double before = 0, beforeAngle = 0;
    while (before < lens.planeEnd) {
      const double r = std::min(lens.planeEnd, before * 1.02 + 0x1p-7);
      const auto at = sphereSight<DoubleDouble>(lens, {r, 0.0}).at;
      const double angle = std::atan2(at.right.hi, at.forward.hi);
      // D / d1 changes by less than this per radian.
      const double b = lens.beta > 1 ? std::sqrt(lens.beta) : 1;
      const double perRadian = (std::fabs(lens.alpha) + std::fabs(lens.oneLessAlpha.hi)) * b * (1 + std::fabs(lens.xi));
      const double by = at.right.hi / r - perRadian * 1.01 * (angle - beforeAngle);
      if (!(by > 0)) return kInfinity;
      const Response<double> sphere = sphereResponse(lens, r, by);
      const Response<double> brown = lens.isBrown ? brownResponse(lens, before, r) : Response<double>{1, 0};
      worst = std::max(worst, brown.stretch * (sphere.rounding * kExactParameter + sphere.stretch * ofPose) +
                                  brown.rounding * kExactParameter);
      const double put = before * radialFactor(lens, before * before) - 3 * lens.tangential * before * before;
      if (!(put < edge)) break;
      before = r;
      beforeAngle = angle;
    }
  }
  const double error = 1.01 * lens.scale.hi * worst;
  return pixelError(c, error, reach.x + reach.y);
}

}  // namespace

LensPixel detail::bentPixel(const CameraParts& c, const Sight<DoubleDouble>& sight) noexcept {
  const Seen seen = isSeen(*c.lens, sight);
  const LensPixel none{{kNaN, true}, {kNaN, true}, {false, seen.certain}};
  if (!seen.isSeen) return none;
  const auto [x, y, error] = finePixel(c, sight);
  if (!(std::isfinite(x.hi) && std::isfinite(y.hi))) return none;
  return {{rounded(x), roundsAlike(x, error)}, {rounded(y), roundsAlike(y, error)}, seen};
}

double detail::boundThroughLens(const Camera& camera, const Vec4& point, double pointError) noexcept {
  const CameraParts& c = parts(camera);
  const ScreenPoint p = worldToScreen(camera, point);
  if (p.status != PointStatus::inFront) return kInfinity;
  const double rounding = halfUlp(std::max(std::fabs(p.x), std::fabs(p.y))) * 2 * kExactUlps;
  const double turned = turnOf(c, point, pointError);
  if (p.certain && turned == 0) return rounding;
  return turned < kLargestTurn ? rounding + finePixel(c, exactSight(c, point), turned).error : kInfinity;
}

ErrorBound detail::boundInPictureThroughLens(const CameraParts& c) noexcept {
  const Vec2 reach = pictureReach(c);
  const double position = std::max(std::fabs(c.screen.centerX.hi) + reach.x, std::fabs(c.screen.centerY.hi) + reach.y);
  return {halfUlp(position) * 1.02 + errorInPicture(c), boundWithin(*c.pinhole, reach, Precision::exact).depth};
}

// Here, because projecting a point needs nothing else of lens.cpp and limit.cpp: who makes no lens links neither.
Camera withoutLens(const Camera& camera) noexcept {
  const auto& pinhole = parts(camera).pinhole;
  return pinhole ? Access::whole<Camera>(pinhole) : camera;
}

}  // namespace viewproj
