#include "commands/pasted/readings.hpp"

#include <algorithm>
#include <cmath>

#include "commands/pasted/reading_parts.hpp"

namespace viewproj::cmd {
Mat4 matrixOf(const PastedMatrix& pasted, MatrixLayout layout) {
  return laidOut(pasted, std::vector<double>(pasted.numbers.size()), layout).m;
}

MatrixReadings readingsOf(const PastedMatrix& pasted, bool isBesideK) {
  MatrixReadings result;
  for (const PrintedNumber& n : pasted.numbers)
    if (!std::isfinite(n.value)) {
      result.fault = "it has " + n.text + ", which is not a finite number";
      return result;
    }
  result.isFloat = areFloats(pasted.numbers);
  const std::vector<double> printed = printedErrors(pasted.numbers);
  const Mat4 written = matrixOf(pasted, MatrixLayout::asWritten);
  using enum MatrixLayout;
  std::vector<MatrixLayout> layouts{asWritten, transposed};
  if (pasted.rows == pasted.columns && written == viewproj::transposed(written)) layouts = {either};
  if (pasted.rows != pasted.columns) layouts = {pasted.rows < pasted.columns ? asWritten : transposed};
  if (pasted.isCss && pasted.rows == 4) layouts = {transposed};
  std::vector<Reading>& readings = result.readings;
  for (const MatrixLayout layout : layouts) {
    const LaidOut laid = laidOut(pasted, printed, layout);
    const std::string fault = addReadings(pasted, laid, result.isFloat, readings);
    if (result.fault.empty()) result.fault = fault;
    if (const std::string typed = typedWrong(laid); !typed.empty() && layout == layouts.front()) result.fault = typed;
  }
  // A camera without depth, and then a multiple of one, only where nothing else fits.
  prefer(readings, [](const Reading& r) { return !r.camera || !r.camera->lens || r.camera->lens->depthFault.empty(); });
  prefer(readings, [](const Reading& r) {
    return !r.camera || !r.camera->lens || r.camera->lens->orthographic || r.camera->scale == 1;
  });
  KindHint hint = hintOf(pasted);
  hint.areAxesOfK = !hint.axes && isBesideK;
  if (hint.areAxesOfK) hint.axes = ViewAxes::RDF;
  // An inverse where a name says so, or where nothing usual fits and the inverse is usual.
  const bool isNamed = hint.kind == ReadingKind::projectionInverse || hint.kind == ReadingKind::viewProjectionInverse;
  if (pasted.rows == 4 && pasted.columns == 4 &&
      (isNamed || std::all_of(readings.begin(), readings.end(), isStrange))) {
    for (const MatrixLayout layout : layouts)
      addInverses(pasted, laidOut(pasted, printed, layout), result.isFloat, readings);
    if (!isNamed) std::erase_if(readings, [](const Reading& r) { return isInverse(r) && isStrange(r); });
  }
  if (pasted.rows == 4 && pasted.columns == 4)
    for (const Mat4& m : {written, viewproj::transposed(written)})
      if (const std::string disparity = disparityOf(m); !disparity.empty()) {
        readings.clear();
        result.fault = disparity;
      }
  if (!readings.empty()) result.fault.clear();
  sortByCost(readings, hint, pasted);
  return result;
}

bool fitsButVectors(const Reading& reading, const Convention& c) {
  if (!reading.camera) return true;
  const MatrixCamera& r = *reading.camera;
  if (r.lens && ((r.lens->depthFault.empty() && c.ndcZ != r.convention.ndcZ) || c.ndcY != r.convention.ndcY))
    return false;
  return r.kind == MatrixKind::viewProjection || c.view == r.convention.view;
}

bool fits(const Reading& reading, const Convention& c, bool isInMemoryOrder) {
  if (!reading.camera || !fitsButVectors(reading, c)) return !reading.camera;
  const bool isTurned = reading.layout == MatrixLayout::transposed, isOfRows = c.vectors == Vectors::row;
  return reading.layout == MatrixLayout::either || (isOfRows != (c.storage == Storage::columnMajor)) == isTurned ||
         (!isInMemoryOrder && isOfRows == isTurned);
}

std::vector<std::string> differences(const Reading& r, const Convention& c) {
  std::vector<std::string> names;
  if (!r.camera) return names;
  if (r.camera->kind != MatrixKind::projection && c.world != r.camera->convention.world) names.emplace_back("world");
  if (r.camera->lens && r.camera->lens->depthFault.empty() && c.reverseZ != r.camera->convention.reverseZ)
    names.emplace_back("reverseZ");
  return names;
}

std::vector<Reading> readingsIn(std::vector<Reading> readings, const Convention& c, bool isInMemoryOrder) {
  if (std::any_of(readings.begin(), readings.end(), [&](const Reading& r) { return fits(r, c, isInMemoryOrder); }))
    std::erase_if(readings, [&](const Reading& r) { return !fits(r, c, isInMemoryOrder); });
  else
    std::erase_if(readings, [&](const Reading& r) { return !fitsButVectors(r, c) || !differences(r, c).empty(); });
  const auto isOwn = [&](const Reading& r) { return differences(r, c).empty(); };
  std::array<bool, std::size(kReadingKinds)> haveOwn{};
  const auto has = [&](const Reading& r) -> bool& { return haveOwn[static_cast<std::size_t>(r.kind)]; };
  for (const Reading& r : readings) has(r) = has(r) || isOwn(r);
  std::erase_if(readings, [&](const Reading& r) { return has(r) && !isOwn(r); });
  return readings;
}

Mat4 converted(const Reading& reading, const Mat4& m, const Convention& to) {
  if (!reading.camera) {
    const bool isRotation = reading.kind == ReadingKind::rotation;
    throw CameraError("", isRotation ? "is a rotation, which is the same in every convention"
                                     : "is a calibration in pixels, and has no form in other conventions; matrix FILE "
                                       "reads one in a file of its format");
  }
  const Convention& from = reading.camera->convention;
  // V' = X V, P' = N P X, with X the signs of the view's axes, and N those and the range of NDC:
  //   1 0 0  0       Inverses are X P^-1 N^-1.
  //   0 s 0  0       Ones and zeros copy what does not change.
  //   0 0 by offset
  //   0 0 0  1
  const auto is = [](const Convention& c, ViewAxes view) { return c.view == view; };
  const Mat4 axes = diagonal(1, is(from, ViewAxes::RDF) != is(to, ViewAxes::RDF) ? -1 : 1,
                             is(from, ViewAxes::RUB) != is(to, ViewAxes::RUB) ? -1 : 1, 1);
  if (reading.kind == ReadingKind::view) return product(axes, m);
  if (reading.kind == ReadingKind::pose) return product(m, axes);
  if (!reading.camera->lens->depthFault.empty()) throw CameraError("", reading.camera->lens->depthFault);
  const auto ends = [](const Convention& c) {
    const double first = c.ndcZ == NdcZ::zeroToOne ? 0 : -1;
    return c.reverseZ ? std::pair(1.0, first) : std::pair(first, 1.0);
  };
  const auto [nearFrom, farFrom] = ends(from);
  const auto [nearTo, farTo] = ends(to);
  const double byZ = (farTo - nearTo) / (farFrom - nearFrom);
  Mat4 ndc = diagonal(1, from.ndcY != to.ndcY ? -1 : 1, byZ, 1);
  ndc[2][3] = nearTo - byZ * nearFrom;
  const bool hasAxes = reading.camera->kind == MatrixKind::projection;
  if (isInverse(reading)) return product(hasAxes ? product(axes, m) : m, *inverseOf(ndc));
  return product(ndc, hasAxes ? product(m, axes) : m);
}

}  // namespace viewproj::cmd
