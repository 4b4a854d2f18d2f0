#include "lens/lens.hpp"

#include <string>

#include "camera/camera.hpp"
#include "camera/require.hpp"
#include "lens/map.hpp"
#include "numbers/degrees.hpp"

namespace viewproj {

using namespace detail;
namespace {

LensParts partsOf(LensModel model) {
  LensParts lens;
  lens.model = model;
  lens.isAngle = model == LensModel::fisheye || model == LensModel::fov;
  return lens;
}

Lens made(LensParts lens) {
  const auto check = [](std::span<double> numbers, const std::string& field) {
    for (std::size_t i = 0; i < numbers.size(); ++i)
      numbers[i] = checkedEntry(numbers[i], (field + "." + std::to_string(i)).c_str());
  };
  check(lens.k, "distortion.k");
  check(lens.p, "distortion.p");
  lens.xi = checkedEntry(lens.xi, "distortion.xi");
  lens.alpha = checkedEntry(lens.alpha, "distortion.alpha");
  requirePositive(lens.beta, "distortion.beta");
  if (!(lens.xi > -1)) throw CameraError("distortion.xi", "must be a number above -1");
  if (!(lens.statedRadius > 0 && lens.statedDegrees > 0))
    throw CameraError("distortion.limit", "must be a number above 0");
  const auto terms = [&](std::size_t first, std::size_t last) {
    while (last > first && lens.k[last - 1] == 0) --last;
    return last - first;
  };
  lens.numeratorTerms = terms(0, lens.isAngle ? 4 : 3);
  lens.denominatorTerms = lens.isAngle ? 0 : terms(3, 6);
  lens.tangential = std::sqrt(lens.p[0] * lens.p[0] + lens.p[1] * lens.p[1]) * (1 + 0x1p-50);
  lens.isBrown = !lens.isAngle && (lens.numeratorTerms > 0 || lens.denominatorTerms > 0 || lens.tangential > 0);
  lens.oneLessAlpha = twoDiff(1, lens.alpha);
  lens.scale = lens.isAngle ? DoubleDouble(1) / lens.across : twoSum(1, lens.xi);
  lens.isScaled = lens.scale.hi != 1 || lens.scale.lo != 0;
  setLimits(lens);
  return Access::whole<Lens>(share(lens));
}

}  // namespace

Lens brownLens(const std::array<double, 6>& k, const std::array<double, 2>& p, double largestRadius) {
  LensParts lens = partsOf(LensModel::brown);
  lens.k = k;
  lens.p = p;
  lens.statedRadius = largestRadius;
  return made(lens);
}

Lens fisheyeLens(const std::array<double, 4>& k, double largestDegrees) {
  LensParts lens = partsOf(LensModel::fisheye);
  for (std::size_t i = 0; i < k.size(); ++i) lens.k[i] = k[i];
  lens.statedDegrees = largestDegrees;
  return made(lens);
}

Lens unifiedLens(double alpha, double beta) {
  LensParts lens = partsOf(LensModel::unified);
  lens.alpha = alpha;
  lens.beta = beta;
  return made(lens);
}

Lens doubleSphereLens(double xi, double alpha) {
  LensParts lens = partsOf(LensModel::doubleSphere);
  lens.xi = xi;
  lens.alpha = alpha;
  return made(lens);
}

Lens omniLens(double xi, const std::array<double, 6>& k, const std::array<double, 2>& p) {
  LensParts lens = partsOf(LensModel::omni);
  lens.xi = xi;
  lens.k = k;
  lens.p = p;
  return made(lens);
}

Lens fovLens(double omega) {
  LensParts lens = partsOf(LensModel::fov);
  requireNumber(omega, "distortion.omega");
  const DoubleDouble tangent = tanHalfRadians(omega);
  if (!(omega > 0 && tangent.hi > 0 && tangent.hi < kLargestRadius))
    throw CameraError("distortion.omega", "must be an angle in radians between 0 and pi");
  lens.omega = omega;
  lens.across = tangent + tangent;
  return made(lens);
}

Lens limitedTo(const Lens& lens, double degrees) {
  LensParts limited = parts(lens);
  if (!(degrees >= limited.statedDegrees)) limited.statedDegrees = degrees;
  return made(limited);
}

Projection calibrated(const Projection& projection, const Lens& lens) {
  ProjectionParts p = parts(projection);
  if (p.orthographic) throw CameraError("distortion", "needs a perspective: orthographic has no lens");
  const LensParts& l = parts(lens);
  if (!l.isScaled && l.model != LensModel::fov) return projection;
  const DoubleDouble by = DoubleDouble(1) / slopeOnAxis(l);
  for (DoubleDouble* edge : {&p.left, &p.right, &p.bottom, &p.top, &p.width, &p.height}) *edge = *edge * by;
  p.reachX *= by.hi;
  p.reachY *= by.hi;
  return made(p);
}

LensModel Lens::model() const noexcept { return parts_->model; }
const std::array<double, 6>& Lens::k() const noexcept { return parts_->k; }
const std::array<double, 2>& Lens::p() const noexcept { return parts_->p; }
double Lens::xi() const noexcept { return parts_->xi; }
double Lens::alpha() const noexcept { return parts_->alpha; }
double Lens::beta() const noexcept { return parts_->beta; }
double Lens::omega() const noexcept { return parts_->omega; }
double Lens::limitDegrees() const noexcept { return parts_->limitDegrees; }
LimitCause Lens::limitCause() const noexcept { return parts_->cause; }

bool detail::isPinhole(const LensParts& lens) noexcept {
  return !lens.isAngle && !lens.isBrown && lens.xi == 0 && lens.alpha == 0 && lens.cause == LimitCause::none;
}

DoubleDouble detail::slopeOnAxis(const LensParts& lens) noexcept {
  return lens.model == LensModel::fov ? lens.across / DoubleDouble(lens.omega) : DoubleDouble(1) / lens.scale;
}

Vec2 distorted(const Lens& lens, const Vec3& direction) noexcept {
  const double size = maxAbs(direction);
  if (!(size > 0 && std::isfinite(size))) return {kNaN, kNaN};
  const DDVec3 d = scaleByPowerOfTwo(toDoubleDouble(direction), -std::ilogb(size));
  const Sight<DoubleDouble> at{d.x, d.y, d.z};
  const LensParts& l = parts(lens);
  if (!isSeen(l, at).isSeen) return {kNaN, kNaN};
  const PlanePoint<DoubleDouble> put = planeOf(l, mapOf(l, at));
  return {rounded(put.x), rounded(put.y)};
}

Vec3 undistorted(const Lens& lens, const Vec2& distorted) noexcept {
  const LensParts& l = parts(lens);
  const auto at = undistort(l, {DoubleDouble(distorted.x) / l.scale, DoubleDouble(distorted.y) / l.scale}).at;
  return {rounded(at.right), rounded(at.down), rounded(at.forward)};
}

Camera withLens(const Camera& camera, const Lens& lens) {
  const CameraParts& c = parts(camera);
  if (c.projection.orthographic) throw CameraError("distortion", "needs a perspective: orthographic has no lens");
  const Camera pinhole = withoutLens(camera);
  return isPinhole(parts(lens)) ? pinhole : withLens(pinhole, Access::shared(lens), parts(lens).scale);
}

std::optional<Lens> lensOf(const Camera& camera) noexcept {
  const auto& lens = parts(camera).lens;
  return lens ? std::optional(Access::whole<Lens>(lens)) : std::nullopt;
}

}  // namespace viewproj
