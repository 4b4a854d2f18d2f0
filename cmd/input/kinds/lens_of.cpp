#include "input/kinds/lens_of.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "input/importers/importer.hpp"
#include "input/kinds/split_matrix.hpp"
#include "numbers/degrees.hpp"
#include "numbers/radians.hpp"
#include "text/format_number.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

struct Matrix3 {
  std::vector<double> m;
  double operator()(std::size_t i, std::size_t j) const { return m[3 * i + j]; }
};

std::optional<Matrix3> matrixK(const CameraPlace& camera) {
  auto numbers = camera.matrix("K", 3, 3);
  if (!numbers) return std::nullopt;
  const Matrix3 k{std::move(*numbers)};
  if (k(2, 0) != 0 || k(2, 1) != 0 || k(2, 2) != 1) {
    const bool looksTransposed = k(0, 2) == 0 && k(1, 2) == 0 && k(2, 2) == 1;
    camera.fail("K", std::string("has a last row that is not 0 0 1") + (looksTransposed ? "; transpose it" : ""));
  }
  if (k(1, 0) != 0) camera.fail("K", "is not fx s cx, 0 fy cy, 0 0 1");
  if (k(0, 1) != 0) {
    const Found found = *camera.find("K");
    const bool nested = found.value->is_array() && found.value->front().is_array();
    camera.fail("K", "has a skew of " + shortNumber(k(0, 1)) + ": pixels of a skewed grid are not modelled; --set " +
                         dotted(found.path) +
                         (nested                     ? ".0.1=0"
                          : found.value->is_object() ? ".data.1=0"
                                                     : ".1=0") +
                         " leaves it out");
  }
  return k;
}

/// Pixels in the sensor's unit of length.
DoubleDouble sensorUnit(const CameraPlace& camera, bool vertical, const Viewport& pixels) {
  const auto side = vertical ? camera.number("sensorHeight") : std::nullopt;
  const auto width = side ? side : camera.number("sensorWidth");
  if (!width) camera.fail("needs the sensor's width beside lengths on it");
  if (!(*width > 0)) camera.fail(side ? "sensorHeight" : "sensorWidth", "must be above 0");
  return DoubleDouble(side ? pixels.height : pixels.width) / DoubleDouble(*width);
}

/// What one of the row's units of focal lengths is in pixels.
DoubleDouble focalUnit(const CameraPlace& camera, bool vertical, const Viewport& pixels) {
  const std::string_view unit = camera.kind().word("focalIn");
  if (unit == "widths") return pixels.width;
  if (unit == "largerSides") return std::max(pixels.width, pixels.height);
  return unit == "sensor" ? sensorUnit(camera, vertical, pixels) : DoubleDouble(1);
}

/// Focal length in pixels: as such, or by the whole angle of view.
std::optional<DoubleDouble> focalLength(const CameraPlace& camera, bool vertical, const Viewport& pixels) {
  const char* const word = vertical ? "fy" : "fx";
  const char* const angleWord = vertical ? "fovY" : "fovX";
  auto given = camera.number(word);
  const auto angle = camera.number(angleWord);
  if (given && !(*given > 0)) camera.fail(word, "must be above 0");
  // A lens has one focal length in the sensor's unit: it stands for both where each side has its size.
  const bool hasSides = camera.kind().has("sensorWidth") && camera.kind().has("sensorHeight");
  if (!given && !angle && camera.kind().word("focalIn") == "sensor" && hasSides)
    given = camera.number(vertical ? "fx" : "fy");
  if (given) return DoubleDouble(*given) * focalUnit(camera, vertical, pixels);
  if (!angle) return std::nullopt;
  const bool inRadians = camera.kind().word("angles") == "radians";
  const DoubleDouble tangent = inRadians ? tanHalfRadians(*angle) : tanHalfDegrees(*angle);
  const char* const range = inRadians ? " an angle between 0 and pi radians" : " an angle between 0 and 180 degrees";
  if (!(tangent.hi > 0)) camera.fail(angleWord, std::string("must be") + range);
  return timesPowerOfTwo(DoubleDouble(vertical ? pixels.height : pixels.width), 0.5) / tangent;
}

double middle(double size, const Viewport& pixels) { return size / 2 + (pixels.pixelCenter - 0.5); }

double center(const CameraPlace& camera, bool vertical, const Viewport& pixels) {
  const double size = vertical ? pixels.height : pixels.width;
  const auto given = camera.number(vertical ? "cy" : "cx");
  if (!given) return middle(size, pixels);
  const std::string_view unit = camera.kind().word("centerIn");
  if (unit == "sensor")
    return (DoubleDouble(*given) * sensorUnit(camera, vertical, pixels)).hi + (pixels.pixelCenter - 0.5);
  if (unit == "shares") return *given * size + (pixels.pixelCenter - 0.5);
  if (unit == "largerSidesFromMiddle") return middle(size, pixels) + *given * std::max(pixels.width, pixels.height);
  return *given;
}

}  // namespace

PictureSize sizeOf(const CameraPlace& camera) {
  if (const auto size = camera.numbers("size", 2)) return {(*size)[0], (*size)[1]};
  return {camera.number("width"), camera.number("height")};
}

bool isPinhole(const CameraPlace& camera) {
  const auto found = camera.find("intrinsics");
  std::vector<double> numbers;
  return !found || !numbersOf(camera.document(), *found, numbers) || numbers.size() <= 4;
}

LensOf lensOf(const CameraPlace& camera, const Viewport& pixels) {
  if (!isPinhole(camera))
    camera.fail("intrinsics", "are those of a lens that is no pinhole, which has fx, fy, cx, cy: it cannot be read");
  if (const auto k = matrixK(camera)) return {(*k)(0, 0), (*k)(1, 1), (*k)(0, 2), (*k)(1, 2), "K"};
  if (const auto n = camera.numbers("intrinsics", 4)) return {(*n)[0], (*n)[1], (*n)[2], (*n)[3], "intrinsics"};
  if (const auto p = camera.matrix("P", 3, 4)) {
    try {
      const SplitMatrix split = splitMatrix(*p);
      requireNoSkew(split);
      return {split.fx, split.fy, rounded(split.cx), rounded(split.cy), "P"};
    } catch (const CameraError& e) {
      camera.fail("P", e.message());
    }
  }
  const auto fx = focalLength(camera, false, pixels), fy = focalLength(camera, true, pixels);
  if (!fx && !fy) {
    std::string names;
    for (const char* const word : kLensWords)
      if (const Where& where = camera.kind().at(word); !where.paths.empty())
        names += (names.empty() ? "" : " or ") + dotted(where.paths.front());
    camera.fail("has no focal length: " + names + " is expected" +
                (camera.kind().beside.empty() ? "" : ", there or beside it"));
  }
  const auto has = [&](const char* word) { return camera.kind().at(word).constant || camera.find(word); };
  return {fx ? *fx : *fy, fy ? *fy : *fx, center(camera, false, pixels), center(camera, true, pixels),
          has(fx ? "fx" : "fy") ? (fx ? "fx" : "fy") : (fx ? "fovX" : "fovY")};
}

bool countsInPixels(const CameraPlace& camera) {
  if (camera.find("K") || camera.find("intrinsics") || camera.find("P")) return true;
  return camera.kind().word("focalIn") == "pixels" && (camera.find("fx") || camera.find("fy"));
}

}  // namespace viewproj::cmd
