#include "lens/lens.hpp"

#include <string>

#include "camera/camera.hpp"
#include "camera/require.hpp"

namespace viewproj {

using namespace detail;
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr DoubleDouble kDegreesPerRadian{0x1.ca5dc1a63c1f8p+5, -0x1.1e7ab456405f9p-49};

/// stated: the calibration's, as limit is.
Lens made(LensParts lens, double stated) {
  const auto require = [](std::span<const double> numbers, const std::string& field) {
    for (std::size_t i = 0; i < numbers.size(); ++i)
      requireNumber(numbers[i], (field + "." + std::to_string(i)).c_str());
  };
  require(lens.k, "distortion.k");
  require(lens.p, "distortion.p");
  if (!(stated > 0)) throw CameraError("distortion.limit", "must be a number above 0");
  const bool isBrown = lens.model == LensModel::brown;
  const auto terms = [&](std::size_t first, std::size_t last) {
    while (last > first && lens.k[last - 1] == 0) --last;
    return last - first;
  };
  lens.numeratorTerms = terms(0, isBrown ? 3 : 4);
  lens.denominatorTerms = isBrown ? terms(3, 6) : 0;
  lens.tangential = std::sqrt(lens.p[0] * lens.p[0] + lens.p[1] * lens.p[1]) * (1 + 0x1p-50);
  const Limit limit = limitOf(lens);
  lens.limit = std::fmin(limit.value, stated);
  lens.cause = stated < limit.value ? LimitCause::stated : limit.cause;
  if (isBrown) {
    lens.end = std::fmin(lens.limit, kLargestTangent);
    const DoubleDouble r = lens.end, u = r * r;
    const DoubleDouble edge = r * series(lens.numerator(), u) / series(lens.denominator(), u);
    const double outer = (edge.hi + 3 * lens.tangential * u.hi) * (1 + 0x1p-30);
    // Next to a pole there is no bound.
    lens.outerEdge = lens.limit < kInfinity && outer > 0 ? outer : kInfinity;
  } else {
    const DoubleDouble angle = lens.limit < kQuarterTurn.hi ? DoubleDouble(lens.limit) : kQuarterTurn;
    lens.end = lens.limit < kQuarterTurn.hi ? lens.limit : 2;
    lens.outerEdge = (angle * series(lens.numerator(), angle * angle)).hi;
  }
  return Access::whole<Lens, LensParts>(std::make_shared<const LensParts>(lens));
}

}  // namespace

Lens brownLens(const std::array<double, 6>& k, const std::array<double, 2>& p, double largestRadius) {
  LensParts lens;
  lens.k = k;
  lens.p = p;
  return made(lens, largestRadius);
}

Lens fisheyeLens(const std::array<double, 4>& k, double largestDegrees) {
  LensParts lens;
  lens.model = LensModel::fisheye;
  for (std::size_t i = 0; i < k.size(); ++i) lens.k[i] = k[i];
  return made(lens, largestDegrees < 180    ? (DoubleDouble(largestDegrees) / kDegreesPerRadian).hi
                    : largestDegrees >= 180 ? kInfinity
                                            : largestDegrees);
}

LensModel Lens::model() const noexcept { return parts_->model; }
const std::array<double, 6>& Lens::k() const noexcept { return parts_->k; }
const std::array<double, 2>& Lens::p() const noexcept { return parts_->p; }
LimitCause Lens::limitCause() const noexcept { return parts_->cause; }

double Lens::limitDegrees() const noexcept {
  const double limit = parts_->limit;
  if (std::isinf(limit)) return limit;
  return ((parts_->model == LensModel::brown ? arctangent(DoubleDouble(limit)) : limit) * kDegreesPerRadian).hi;
}

Vec2 distorted(const Lens& lens, const Vec2& tangents) noexcept {
  const auto at = distort<double>(parts(lens), {tangents.x, tangents.y});
  return {at.x, at.y};
}

Vec2 undistorted(const Lens& lens, const Vec2& distorted) noexcept {
  const auto at = undistort(parts(lens), {distorted.x, distorted.y}).at;
  return {rounded(at.x), rounded(at.y)};
}

Camera withLens(const Camera& camera, const Lens& lens) {
  const CameraParts& c = parts(camera);
  if (c.projection.orthographic) throw CameraError("distortion", "needs a perspective: orthographic has no lens");
  const LensParts& l = parts(lens);
  const Camera pinhole = withoutLens(camera);
  const bool isPinhole =
      l.model == LensModel::brown && l.cause == LimitCause::none && l.tangential == 0 && l.k == std::array<double, 6>{};
  return isPinhole ? pinhole : withLens(pinhole, Access::shared(lens));
}

Camera withoutLens(const Camera& camera) noexcept {
  const auto& pinhole = parts(camera).pinhole;
  return pinhole ? Access::whole<Camera, CameraParts>(pinhole) : camera;
}

std::optional<Lens> lensOf(const Camera& camera) noexcept {
  const auto& lens = parts(camera).lens;
  return lens ? std::optional(Access::whole<Lens, LensParts>(lens)) : std::nullopt;
}

}  // namespace viewproj
