// Ticks along the frame, and the facts of the camera below it.
#include <algorithm>
#include <cmath>

#include "camera/plain_camera.hpp"
#include "picture/drawing.hpp"
#include "picture/svg.hpp"
#include "text/number.hpp"
#include "viewproj/geodesy.hpp"

namespace viewproj::cmd {
namespace {

/// With so many decimals at most.
std::string degrees(double angle, int decimals) {
  const double unit = std::pow(10, decimals);
  return formatDigits(std::round(angle * unit) / unit + 0.0, 10) + "°";
}

/// In the order of LensModel.
constexpr const char* kLenses[] = {"brown", "fisheye", "unified", "double-sphere", "omni", "fov"};

}  // namespace

std::string ticksOf(const View& view) {
  constexpr double kTicks = 8, kSize = 5;
  const Viewport& v = view.camera().viewport();
  const Rect& f = view.frame();
  const bool isFromTop = view.isFromTop();
  const Vec2 first = view.offSheet({f.left, isFromTop ? f.top : f.bottom});
  std::string out;
  for (const bool isX : {true, false}) {
    const double start = isX ? first.x : first.y, size = isX ? v.width : v.height;
    const double step = roundedDown(size / (isX ? kTicks : std::max(2.0, kTicks * v.height / v.width)));
    for (double k = std::ceil(start / step - 1e-9); k * step <= start + size * (1 + 1e-9); ++k) {
      const Vec2 at = view.onSheet(isX ? Vec2{k * step, first.y} : Vec2{first.x, k * step});
      const Vec2 end = isX ? Vec2{at.x, at.y + (isFromTop ? -kSize : kSize)} : Vec2{at.x - kSize, at.y};
      const Vec2 text = isX ? Vec2{at.x, at.y + (isFromTop ? -8 : 17)} : Vec2{at.x - 8, at.y + 4};
      out += svg::path("tick", svg::line({at, end})) +
             svg::text("num", text, isX ? "middle" : "end", formatDigits(k * step + 0.0, 6));
    }
  }
  return out;
}

std::vector<std::string> factsOf(const View& view) {
  const Camera& camera = view.camera();
  const Viewport& v = camera.viewport();
  const Projection p = camera.projection();
  const auto digits = [](double value) { return formatDigits(value, 4); };
  std::vector<std::string> facts{formatDigits(v.width, 6) + " × " + formatDigits(v.height, 6) + " px, y " +
                                 (view.isFromTop() ? "down from the top left" : "up from the bottom left")};
  if (view.isParallel())
    facts.push_back(digits(p.right() - p.left()) + " × " + digits(p.top() - p.bottom()) + " wide, orthographic");
  else
    facts.push_back("fov " + formatDigits(p.fov(Fov::horizontal), 3) + "° × " + formatDigits(p.fov(Fov::vertical), 3) +
                    "°" + (view.hasLens() ? " without the lens" : ""));
  if (const auto lens = lensOf(camera))
    facts.push_back(std::string(kLenses[static_cast<std::size_t>(lens->model())]) + " lens" +
                    (std::isfinite(lens->limitDegrees())
                         ? ", ends " + formatDigits(lens->limitDegrees(), 3) + "° off the axis"
                         : ""));
  const Vec3 eye = view.eye();
  if (view.worldIsEcef()) {
    const Geodetic place = ecefToGeodetic(eye);
    const HeadingPitchRoll angles = headingPitchRollOf(plainPose(camera.pose()), true);
    facts.push_back(degrees(place.lat, 4) + " " + degrees(place.lon, 4) + ", " + formatDigits(place.height, 5) +
                    " m; heading " + degrees(std::fmod(angles.heading.value + 360, 360), 2) + ", pitch " +
                    degrees(angles.pitch.value, 2) +
                    (std::fabs(angles.roll.value) > 0.005 ? ", roll " + degrees(angles.roll.value, 2) : ""));
  } else {
    facts.push_back("eye " + digits(eye.x) + ", " + digits(eye.y) + ", " + digits(eye.z));
  }
  if (view.isParallel() || p.zNear() > 0) {
    const std::string far = std::isfinite(p.zFar()) ? digits(p.zFar()) : "infinite";
    if (!view.worldIsEcef()) facts.push_back("near " + digits(p.zNear()) + ", far " + far);
  }
  if (!view.worldIsEcef()) {
    const Convention& c = camera.convention();
    facts.push_back(std::string(c.world == Handedness::right ? "right" : "left") + "-handed world" +
                    (c.view == ViewAxes::RDF ? ", camera y down" : ""));
  }
  return facts;
}

}  // namespace viewproj::cmd
