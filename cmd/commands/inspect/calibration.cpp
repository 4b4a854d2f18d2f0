#include "commands/inspect/calibration.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "input/kinds/split_matrix.hpp"
#include "input/readings/matrix_parts.hpp"
#include "text/format_number.hpp"
#include "viewproj/camera.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

constexpr std::size_t kParameters = 8;
using Parameters = std::array<DoubleDouble, kParameters>;
using Twelve = std::array<double, 12>;

Parameters parametersOf(const SplitMatrix& s) { return {s.fx, s.fy, s.cx, s.cy, s.skew, s.eye.x, s.eye.y, s.eye.z}; }

}  // namespace

Calibration inspectCalibration(const WrittenMatrix& m, EntryPrecision precision, bool isExact) {
  const bool isK = m.columns == 3;
  Twelve p{};
  std::array<std::size_t, 12> from{};  // its place among the numbers, or past the end
  for (std::size_t i = 0; i < 12; ++i) {
    from[i] = isK ? (i % 4 < 3 ? 3 * (i / 4) + i % 4 : 12) : i;
    if (from[i] < 12) p[i] = m.numbers[from[i]];
  }
  if (isK && (p[4] != 0 || p[8] != 0 || p[9] != 0))
    throw CameraError("K", "has numbers below its diagonal: it is no K");
  if (isK && !(p[0] * p[10] > 0 && p[5] * p[10] > 0)) throw CameraError("K", "has a focal length that is not above 0");
  const SplitMatrix split = splitMatrix(p);
  const Parameters values = parametersOf(split);
  std::array<double, kParameters> spread{};
  for (std::size_t i = 0; i < 12; ++i) {
    if (from[i] >= 12 || (isK && p[i] == 0)) continue;
    const double typed = isExact ? 0 : m.within[from[i]];
    const bool isWord = typed == 0 && (p[i] == 0 || std::fabs(p[i]) == 1);
    const double step = isWord ? 0 : halfSteps(std::fabs(p[i]), precision, typed).up;
    if (step == 0) continue;
    // By a double that there is, and then by the share of it.
    const double moving = std::max(step, 2 * halfSteps(std::fabs(p[i]), EntryPrecision::float64).up);
    std::array<double, kParameters> most{};
    for (const double end : {-moving, moving}) {
      Twelve moved = p;
      moved[i] += end;
      const Parameters there = parametersOf(splitMatrix(moved));
      for (std::size_t k = 0; k < kParameters; ++k)
        most[k] = std::max(most[k], std::fabs((there[k] - values[k]).hi) * (step / moving));
    }
    for (std::size_t k = 0; k < kParameters; ++k) spread[k] += most[k];
  }
  const auto estimate = [&](std::size_t k) {
    const double value = values[k].hi + 0.0;
    if (spread[k] == 0) return Estimate{value, value, value};
    return Estimate{value, std::nextafter(value - spread[k], -INFINITY), std::nextafter(value + spread[k], INFINITY)};
  };
  Calibration c{estimate(0), estimate(1), estimate(2), estimate(3), estimate(4), std::nullopt, {}, {}, {}, {}};
  if (!isK) {
    c.eye = {estimate(5), estimate(6), estimate(7)};
    c.right = rounded(split.columns[0]);
    c.down = rounded(split.columns[1]);
    c.forward = rounded(split.columns[2]);
    c.notes.push_back(
        "P and any multiple of it, -P too, are the same camera: this is the one that looks along its forward.");
  }
  c.notes.push_back(
      "It says neither how large the picture is nor where a pixel's centre lies: in OpenCV at whole numbers "
      "(viewport.pixelCenter 0), elsewhere often at halves, half a pixel away.");
  if (c.skew.low > 0 || c.skew.high < 0)
    c.notes.push_back("Its skew is not 0, and pixels of a skewed grid are not modelled.");
  const double cx = values[2].hi, cy = values[3].hi;
  const auto seven = [](double number) { return formatDigits(std::fabs(number) < 1e-15 ? 0 : number, 7); };
  const auto three = [&](const Vec3& v) { return seven(v.x) + "," + seven(v.y) + "," + seven(v.z); };
  if (cx > 0 && cy > 0)
    c.notes.push_back("If the axis meets the picture's middle, it is " + formatDigits(2 * cx + 1, 5) + " x " +
                      formatDigits(2 * cy + 1, 5) + " pixels counted as OpenCV does, " + formatDigits(2 * cx, 5) +
                      " x " + formatDigits(2 * cy, 5) + " from halves.");
  std::string line = "viewproj matrix --to camera --convention opencv --fx " + seven(values[0].hi) + " --fy " +
                     seven(values[1].hi) + " --cx " + seven(cx) + " --cy " + seven(cy);
  if (!isK)
    line += " --position " + three({values[5].hi, values[6].hi, values[7].hi}) + " --direction " + three(c.forward) +
            " --up " + three({0 - c.down.x, 0 - c.down.y, 0 - c.down.z});
  c.notes.push_back(std::string("As a camera file, with ") +
                    (isK ? "a size, a near plane and a pose" : "a size and a near plane") + " of yours: " + line +
                    " --near 0.1 --viewport WxH");
  return c;
}

}  // namespace viewproj::cmd
