#include "commands/inspect/calibration.hpp"

#include <cmath>

#include "camera/split_matrix.hpp"
#include "text/number.hpp"
#include "viewproj/camera.hpp"

namespace viewproj::cmd {

using namespace detail;
Calibration inspectCalibration(const WrittenMatrix& m) {
  const bool isK = m.columns == 3;
  std::array<double, 12> p{};
  for (std::size_t i = 0; i < 12; ++i)
    if (i % 4 < m.columns) p[i] = m.numbers[m.columns * (i / 4) + i % 4];
  if (isK && (p[4] != 0 || p[8] != 0 || p[9] != 0))
    throw CameraError("K", "has numbers below its diagonal: it is no K");
  if (isK && !(p[0] * p[10] > 0 && p[5] * p[10] > 0)) throw CameraError("K", "has a focal length that is not above 0");
  const SplitMatrix split = splitMatrix(p);
  const auto plain = [](DoubleDouble number) { return number.hi + 0.0; };
  Calibration c{
      plain(split.fx), plain(split.fy), plain(split.cx), plain(split.cy), plain(split.skew), {}, {}, {}, {}, {}};
  if (!isK) {
    c.eye = {plain(split.eye.x), plain(split.eye.y), plain(split.eye.z)};
    c.right = rounded(split.columns[0]);
    c.down = rounded(split.columns[1]);
    c.forward = rounded(split.columns[2]);
    c.notes.push_back(
        "P and any multiple of it, -P too, are the same camera: this is the one that looks along its forward.");
  }
  c.notes.push_back(
      "It says neither how large the picture is nor where a pixel's centre lies: in OpenCV at whole numbers "
      "(viewport.pixelCenter 0), elsewhere often at halves, half a pixel away.");
  if (hasSkew(split)) c.notes.push_back("Its skew is not 0, and pixels of a skewed grid are not modelled.");
  const auto seven = [](double number) { return formatDigits(std::fabs(number) < 1e-15 ? 0 : number, 7); };
  const auto three = [&](const Vec3& v) { return seven(v.x) + "," + seven(v.y) + "," + seven(v.z); };
  if (c.cx > 0 && c.cy > 0)
    c.notes.push_back("If the axis meets the picture's middle, it is " + formatDigits(2 * c.cx + 1, 5) + " x " +
                      formatDigits(2 * c.cy + 1, 5) + " pixels counted as OpenCV does, " + formatDigits(2 * c.cx, 5) +
                      " x " + formatDigits(2 * c.cy, 5) + " from halves.");
  std::string line = "viewproj matrix --to camera --convention opencv --fx " + seven(c.fx) + " --fy " + seven(c.fy) +
                     " --cx " + seven(c.cx) + " --cy " + seven(c.cy);
  if (!isK)
    line += " --position " + three(*c.eye) + " --direction " + three(c.forward) + " --up " +
            three({0 - c.down.x, 0 - c.down.y, 0 - c.down.z});
  c.notes.push_back(std::string("As a camera file, with ") +
                    (isK ? "a size, a near plane and a pose" : "a size and a near plane") + " of yours: " + line +
                    " --near 0.1 --viewport WxH");
  return c;
}

}  // namespace viewproj::cmd
