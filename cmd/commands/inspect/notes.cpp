#include "commands/inspect/notes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "text/number.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

bool isAffine(const MatrixCamera& r) { return !r.lens || r.lens->orthographic; }

/// The two differ in nothing but the range of depth.
bool differInNdcZ(const MatrixCamera& a, const MatrixCamera& b) {
  Convention c = a.convention;
  c.ndcZ = b.convention.ndcZ;
  return a.lens && b.lens && a.kind == b.kind && a.layout == b.layout && a.lens->orthographic == b.lens->orthographic &&
         a.convention.ndcZ != b.convention.ndcZ && c == b.convention;
}

std::string depthNote(const MatrixCamera& centred, const MatrixCamera& half) {
  const std::string text = "Depth: made for -1..1 and used as 0..1, it cuts off all ";
  if (half.lens->zNear.value > centred.lens->zNear.value)
    return text + "nearer than " + shortestWithin(half.lens->zNear) + " instead of " +
           shortestWithin(centred.lens->zNear) + ".";
  return text + "beyond " + shortestWithin(half.lens->zFar) + " instead of " + shortestWithin(centred.lens->zFar) + ".";
}

}  // namespace

std::string shortestWithin(const PlaneDistance& e) {
  if (std::isinf(e.value)) return "infinite";
  if (!std::isfinite(e.low) || !std::isfinite(e.high)) return formatNumber(e.value);
  // A number that the entries leave wide open is told near its middle, a sharp one as it was probably meant.
  constexpr double kWide = 0.01;
  const bool isWide = e.high / 2 - e.low / 2 > kWide * std::fabs(e.value);
  const double low = isWide ? e.low / 2 + e.value / 2 : e.low, high = isWide ? e.high / 2 + e.value / 2 : e.high;
  for (int digits = 0;; ++digits) {
    char text[40];
    std::snprintf(text, sizeof text, "%.*e", digits, e.value);
    const double number = std::strtod(text, nullptr);
    if (digits == 16 || (low <= number && number <= high)) return formatNumber(number);
  }
}

std::vector<std::string> notesOn(const std::vector<MatrixCamera>& readings) {
  std::vector<std::string> notes;
  const auto any = [&](auto what) { return std::any_of(readings.begin(), readings.end(), what); };
  const auto all = [&](auto what) { return !readings.empty() && std::all_of(readings.begin(), readings.end(), what); };
  const auto isKind = [](MatrixKind kind) { return [kind](const MatrixCamera& r) { return r.kind == kind; }; };
  const auto isPose = [](const MatrixCamera& r) { return !r.lens; };

  const auto isLaidOut = [](MatrixLayout layout) {
    return [layout](const MatrixCamera& r) { return r.layout == layout; };
  };
  if (any(isLaidOut(MatrixLayout::asWritten)))
    notes.push_back("As written: the rows of column vectors (row-major), or the columns of row vectors.");
  if (any(isLaidOut(MatrixLayout::transposed)))
    notes.push_back(
        "Transposed: the rows of row vectors (row-major), or the columns of column vectors (column-major).");
  if (const auto scaled =
          std::find_if(readings.begin(), readings.end(), [](const MatrixCamera& r) { return r.scale != 1; });
      scaled != readings.end())
    notes.push_back("All sixteen numbers are " + formatNumber(scaled->scale) +
                    " times the usual ones, or the world is scaled so; the picture is the same.");
  if (any(isKind(MatrixKind::view)) && any(isKind(MatrixKind::worldFromView)))
    notes.push_back("A view and a camera's pose look alike: the reading whose eye is right tells which it is.");
  if (any(isPose))
    notes.push_back(
        "The axes of view space are not in it: read with z forward instead of back, the camera looks the other way, "
        "and "
        "in a world of the other hand.");
  if (any(isPose) && !any([](const MatrixCamera& r) { return r.lens.has_value(); }))
    notes.push_back("An orthographic view-projection of a window 2 wide and 2 high has such numbers too.");
  for (const MatrixCamera& centred : readings) {
    if (centred.convention.ndcZ != NdcZ::minusOneToOne) continue;
    const auto half =
        std::find_if(readings.begin(), readings.end(), [&](const MatrixCamera& r) { return differInNdcZ(centred, r); });
    if (half == readings.end()) continue;
    notes.push_back(depthNote(centred, *half));
    break;
  }
  const auto hasNdcY = [](NdcY y) { return [y](const MatrixCamera& r) { return r.lens && r.convention.ndcY == y; }; };
  if (any(hasNdcY(NdcY::up)) && any(hasNdcY(NdcY::down)))
    notes.push_back(
        all(isKind(MatrixKind::viewProjection))
            ? "A right-handed world with NDC y up and a left-handed one with y down, or the other way round, "
              "have the same numbers; taken the wrong way the picture is upside down. --read-as picks."
            : "NDC y up and down are both possible; taken the wrong way the picture is upside down.");
  const auto needs = [](bool back) {
    return [back](const MatrixCamera& r) {
      return r.kind == MatrixKind::projection && !isAffine(r) && (r.convention.view == ViewAxes::RUB) == back;
    };
  };
  if (all(needs(true)))
    notes.push_back(
        "It needs a view whose z points back (RUB). With one whose z points forward, all in front of the camera has "
        "w < 0: the picture is empty, or shows what is behind.");
  if (all(needs(false)))
    notes.push_back(
        "It needs a view whose z points forward (RUF, RDF). With one whose z points back, all in front of the camera "
        "has w < 0: the picture is empty, or shows what is behind.");
  if (all([](const MatrixCamera& r) { return r.lens && r.convention.reverseZ; }))
    notes.push_back(
        "Depth is reversed: clear it to the low end and test for greater. With less the farthest shows, or nothing.");
  if (any([](const MatrixCamera& r) {
        if (!r.lens || r.lens->orthographic) return false;
        constexpr double kFarOff = 4;  // widths and heights
        const auto isFarOff = [](double low, double high) {
          return std::fabs(low + high) > 2 * kFarOff * (high - low);
        };
        return isFarOff(r.lens->left, r.lens->right) && isFarOff(r.lens->bottom, r.lens->top);
      }))
    notes.push_back(
        "The window lies more than four times its own size off the viewing axis: a matrix with the viewport folded in "
        "looks like that.");
  if (any([](const MatrixCamera& r) { return r.lens && r.lens->beyondInfinity; }))
    notes.push_back("Infinity lies a little inside the depth range: a tweaked infinite projection.");
  if (any([](const MatrixCamera& r) { return r.pose && !isEyeKnown(r); }))
    notes.push_back(
        "Orthographic: where the eye is, is not in it; edges, near and far are counted from the world's origin.");
  return notes;
}

}  // namespace viewproj::cmd
