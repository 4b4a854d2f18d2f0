#include <algorithm>
#include <cmath>
#include <numbers>

#include "camera/plain_vectors.hpp"
#include "commands/pasted/reading_parts.hpp"
#include "numbers/vectors.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {

using detail::dot;
using detail::maxAbs;
namespace {

/// Significant digits of the roundest number in the interval.
double digitsWithin(const PlaneDistance& d) {
  if (std::isinf(d.value) || (d.low <= 0 && d.high >= 0)) return 0;
  for (int digits = 1; digits < 17; ++digits)
    if (const double round = toDigits(d.value, digits); d.low <= round && round <= d.high) return digits;
  return 17;
}

bool holdsPowerOfTen(const PlaneDistance& d) {
  for (int k = -6; k < 6; ++k)
    if (d.low <= std::pow(10.0, k) && std::pow(10.0, k) <= d.high) return true;
  return false;
}

double decimalsWithin(double value, double error) {
  constexpr int kMost = 12;
  for (int k = 0; k < kMost; ++k)
    if (std::fabs(std::round(value * std::pow(10.0, k)) / std::pow(10.0, k) - value) <= error) return k;
  return kMost;
}

double costOfDepth(const Reading& r) {
  const MatrixLens& lens = *r.camera->lens;
  const Convention& c = r.camera->convention;
  double cost = (c.reverseZ ? 4 : 0) + (lens.orthographic ? 1 : 0) + (r.isUniform ? 12 : 0);
  const double pixels = std::min(2 / (lens.right - lens.left), 2 / (lens.top - lens.bottom));
  if (!lens.orthographic && pixels > kFewestPixels) cost += 25;
  if (!lens.depthFault.empty()) return cost;
  cost += 0.5 * (digitsWithin(lens.zNear) + digitsWithin(lens.zFar));
  if (lens.zNear.value > 0 && !holdsPowerOfTen(lens.zNear)) cost += 0.4;
  // OpenGL's depth looks along -z, Direct3D's along +z.
  const bool isGl = c.ndcZ == NdcZ::minusOneToOne;
  return cost + (!r.camera->pose ? ((c.view == ViewAxes::RUB) != isGl ? 0.6 : 0) : isGl ? 0 : 0.3);
}

/// Whether the world's origin lies behind the camera, which is upside down where z is up. Where y is down, up is -y.
bool isUpsideDown(const Pose& pose) {
  return dot(pose.forward(), pose.eye()) > 0 && -pose.up().z > std::fabs(pose.up().y);
}

double costOf(const Reading& r, const std::vector<Reading>& all, const KindHint& hint, const PastedMatrix& m) {
  using enum ReadingKind;
  constexpr double kUsual[] = {0, 1, 2, 3, 0, 0, 4, 0, 3};  // in the order of ReadingKind
  double cost = kUsual[static_cast<std::size_t>(r.kind)];
  const bool isHinted = r.kind == hint.kind || (r.kind == p && (hint.kind == k || hint.kind == projection));
  if (hint.kind && !isHinted) cost += hint.weight;
  if (r.kind == k && r.pixels->fx < kFewestPixels && hint.kind != k) cost += 5;
  if (m.isByColumns && r.layout == MatrixLayout::asWritten) cost += 6;
  if (r.camera && r.camera->lens) cost += costOfDepth(r);
  if (isStrange(r) && std::any_of(all.begin(), all.end(), isInverse)) cost += 2 * kSpoken;
  // A camera's turn as it is named: of a view its rows are the camera's axes, of a pose its columns.
  if (r.kind == rotation && hint.kind == (r.layout == MatrixLayout::asWritten ? pose : view)) cost += 1;
  if (r.isCentred) cost -= 3;
  if (r.rise != 0) cost -= r.rise > 0 ? 1.5 : 1.25;
  if (r.scaledBy != 1 && r.kind == view) cost += 3;
  if (hint.isTransposed && r.layout == MatrixLayout::asWritten) cost += 6;
  // The picture of RDF has y down, where the projection flips nothing.
  if (hint.isTransposed && hint.axes == ViewAxes::RDF && r.kind == viewProjection &&
      r.camera->convention.ndcY != NdcY::down)
    cost += 0.3;
  if (r.kind != view && r.kind != pose) return cost;
  if (hint.axes && r.camera->convention.view != hint.axes) cost += 0.3;
  if (hint.areAxesOfK && r.camera->convention.view == hint.axes && isUpsideDown(*r.camera->pose)) cost += 0.3;
  if ((hint.kind == view || hint.kind == pose) && hint.weight == kSpoken) return cost;
  double error = 1e-300;
  for (const Reading& other : all)
    if ((other.kind == view || other.kind == pose) && other.layout == r.layout)
      error = std::max({error, maxAbs(other.camera->eyeError), 1e-9 * maxAbs(other.camera->pose->eye())});
  const Vec3 eye = r.camera->pose->eye();
  for (std::size_t i = 0; i < 3; ++i) cost += 0.34 * decimalsWithin(eye[i], error);
  return cost;
}

/// Whether presets have all of a reading but for its world or reverseZ, and none has all of it.
bool isPresetExcept(const Reading& r, bool isInMemoryOrder) {
  bool isAlmost = false;
  for (const ConventionPreset& preset : conventionPresets()) {
    if (!fits(r, preset.convention, isInMemoryOrder)) continue;
    if (differences(r, preset.convention).empty()) return false;
    isAlmost = true;
  }
  return isAlmost;
}

void sortByCost(std::vector<Reading>& readings) {
  std::stable_sort(readings.begin(), readings.end(),
                   [](const Reading& a, const Reading& b) { return a.cost < b.cost; });
}

}  // namespace

bool isInverse(const Reading& r) {
  return r.kind == ReadingKind::projectionInverse || r.kind == ReadingKind::viewProjectionInverse;
}

bool isStrange(const Reading& r) {
  if (!r.camera || !r.camera->lens || r.camera->lens->orthographic) return false;
  const double fov = (std::atan(r.camera->lens->top) - std::atan(r.camera->lens->bottom)) * 180 / std::numbers::pi;
  return !r.camera->lens->depthFault.empty() || r.camera->scale != 1 || !(fov >= kNarrowFov && fov <= kWideFov);
}

void sortByCost(std::vector<Reading>& readings, const KindHint& hint, const PastedMatrix& matrix) {
  constexpr double kTie = 0.2;
  for (Reading& r : readings)
    r.cost = costOf(r, readings, hint, matrix) + (r.camera && isPresetExcept(r, matrix.isInMemoryOrder) ? kTie : 0);
  sortByCost(readings);
}

void orderBeside(std::vector<Reading>& readings, const std::vector<Reading>& lens) {
  const auto isLens = [](const Reading& r) { return r.kind == ReadingKind::projection; };
  const auto cheapest = std::find_if(lens.begin(), lens.end(), isLens);
  if (cheapest == lens.end()) return;
  for (Reading& r : readings) {
    if (r.kind != ReadingKind::view && r.kind != ReadingKind::pose) continue;
    const auto ofAxes = std::find_if(lens.begin(), lens.end(), [&](const Reading& l) {
      return isLens(l) && l.camera->convention.view == r.camera->convention.view;
    });
    r.cost += ofAxes == lens.end() ? kSpoken / 2 : ofAxes->cost - cheapest->cost;
  }
  sortByCost(readings);
}

}  // namespace viewproj::cmd
