#include "output/camera_summary.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "camera/camera.hpp"
#include "camera/change_camera.hpp"
#include "camera/names.hpp"
#include "output/side_names.hpp"
#include "text/layout.hpp"
#include "text/number.hpp"
#include "viewproj/geodesy.hpp"
#include "viewproj/scene.hpp"
#include "viewproj/screen.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

class Page {
 public:
  explicit Page(int digits) : digits_(digits) {}

  std::string number(double value) const { return std::isinf(value) ? "infinite" : formatDigits(value + 0.0, digits_); }
  std::string numbers(std::initializer_list<double> values) const {
    std::string text;
    for (const double value : values) text += (text.empty() ? "" : ", ") + number(value);
    return text;
  }
  /// Without what is left of components that cancel.
  std::string numbers(const Vec3& v) const {
    const auto one = [&](double part) { return std::fabs(part) < kCancellation * maxAbs(v) ? 0 : part; };
    return numbers({one(v.x), one(v.y), one(v.z)});
  }

  void add(const std::string& name, const std::string& text) {
    constexpr std::size_t kNames = 18;
    out_ += paddedRight(name, kNames) + text + "\n";
  }
  void space() {
    if (!out_.empty()) out_ += "\n";
  }
  std::string text() const { return out_; }

 private:
  int digits_;
  std::string out_;
};

/// Clockwise from north, above the horizon, right side down.
HeadingPitchRoll turnOf(const Pose& pose, const Geodetic& place) {
  constexpr double kDegrees = 180 / std::numbers::pi;
  const double lat = place.lat / kDegrees, lon = place.lon / kDegrees;
  const Vec3 east{-std::sin(lon), std::cos(lon), 0};
  const Vec3 up{std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)};
  const Vec3 north{-std::sin(lat) * std::cos(lon), -std::sin(lat) * std::sin(lon), std::cos(lat)};
  const Vec3 forward = pose.forward();
  // Of what doubles leave, for people.
  const auto degrees = [&](double radians) { return std::round(radians * kDegrees * 1e12) / 1e12 + 0.0; };
  return {std::fmod(degrees(std::atan2(detail::dot(forward, east), detail::dot(forward, north))) + 360, 360),
          degrees(std::asin(std::clamp(detail::dot(forward, up), -1.0, 1.0))),
          degrees(std::atan2(-detail::dot(pose.right(), up), detail::dot(pose.up(), up)))};
}

void addPose(Page& page, const CameraFile& camera, CameraAxes axes) {
  const Pose& pose = *camera.pose;
  const bool right = camera.convention.world == Handedness::right;
  page.add("world", camera.worldIsEcef ? "right-handed, Earth-centred metres" : right ? "right-handed" : "left-handed");
  page.add("eye", page.numbers(pose.eye()));
  if (camera.worldIsEcef) {
    const Geodetic place = ecefToGeodetic(pose.eye());
    page.add("  place", "lat " + page.number(place.lat) + ", lon " + page.number(place.lon) + ", height " +
                            page.number(place.height));
    const HeadingPitchRoll turn = turnOf(pose, place);
    page.add("  turned", "heading " + page.number(turn.heading) + ", pitch " + page.number(turn.pitch) + ", roll " +
                             page.number(turn.roll) + " degrees");
  }
  page.add("right", page.numbers(pose.right()));
  page.add("up", page.numbers(pose.up()));
  page.add("forward", page.numbers(pose.forward()));
  const Vec3 r = pose.right(), u = pose.up(), f = pose.forward();
  const auto minus = [](const Vec3& v) { return Vec3{-v.x, -v.y, -v.z}; };
  const auto q = quaternionOf(axes == CameraAxes::FRU   ? std::array{f, r, u}
                              : axes == CameraAxes::RUF ? std::array{r, u, f}
                              : axes == CameraAxes::RUB ? std::array{r, u, minus(f)}
                                                        : std::array{r, minus(u), f});
  page.add("rotation", "x, y, z, w of " + std::string(nameOf(kCameraAxesNames, axes)) + ": " +
                           page.numbers({q[0], q[1], q[2], q[3]}));
}

void addLens(Page& page, const CameraFile& camera) {
  const ProjectionParts& p = parts(*camera.projection);
  const auto edges = "left " + page.number(p.left.hi) + ", right " + page.number(p.right.hi) + ", bottom " +
                     page.number(p.bottom.hi) + ", top " + page.number(p.top.hi);
  if (p.orthographic) {
    page.add("projection", "orthographic");
    page.add("window", edges);
  } else {
    page.add("projection", "perspective");
    const Projection& lens = *camera.projection;
    page.add("field of view", page.number(lens.fov(Fov::horizontal)) + " across, " +
                                  page.number(lens.fov(Fov::vertical)) + " down, " +
                                  page.number(lens.fov(Fov::diagonal)) + " from corner to corner, degrees");
    page.add("window", edges + ", at distance 1");
  }
  page.add("near, far", (hasDepth(*camera.projection) ? page.number(p.near) : "none") + ", " + page.number(p.far));
}

void addPicture(Page& page, const CameraFile& file) {
  const Viewport& v = *file.viewport;
  page.add("viewport", page.number(v.width) + " x " + page.number(v.height) + " pixels, corner at " +
                           page.numbers({v.x, v.y}) + ", counted from the " +
                           std::string(nameOf(kOriginNames, v.origin)) + "; centre of the first pixel at " +
                           page.numbers({v.pixelCenter, v.pixelCenter}));
}

void addWhole(Page& page, const CameraFile& file) {
  const Camera camera = makeCamera(file);
  const CameraParts& c = parts(camera);
  if (!c.projection.orthographic)
    page.add("focal length", page.numbers({std::fabs(c.screen.scaleX.hi), std::fabs(c.screen.scaleY.hi)}) + " pixels");
  page.add("axis", "meets the picture at " + page.numbers({c.screen.centerX.hi, c.screen.centerY.hi}));
  if (hasDepth(camera.projection()))
    page.add("depth", page.number(c.depthAtNear) + " at near, " + page.number(c.depthAtFar) + " at far");
  if (c.projection.orthographic) {
    const Vec2 size = pixelSize(camera, 1);
    page.add("a pixel spans", page.number(size.x) + " x " + page.number(size.y));
  } else {
    std::string spans;
    for (const double distance : {1.0, 10.0, 100.0}) {
      const Vec2 size = pixelSize(camera, distance);
      spans += (spans.empty() ? "" : "; ") + page.number(size.x) + " x " + page.number(size.y) + " at " +
               page.number(distance);
    }
    page.add("a pixel spans", spans);
  }
  page.space();
  page.add("planes", "a, b, c, d with a x + b y + c z + d >= 0 inside");
  const Frustum frustum = viewFrustum(camera);
  for (const FrustumPlane& plane : frustum.planes()) {
    const Vec4& e = plane.equation;
    page.add("  " + std::string(sideName(plane.side)), page.numbers({e.x, e.y, e.z, e.w}));
  }
}

}  // namespace

std::string summaryOf(const CameraFile& camera, CameraAxes axes, int digits) {
  Page page(digits);
  if (camera.pose) addPose(page, camera, axes);
  if (camera.projection) {
    page.space();
    addLens(page, camera);
  }
  if (camera.viewport) {
    page.space();
    addPicture(page, camera);
  }
  if (camera.pose && camera.projection && camera.viewport) addWhole(page, camera);
  return page.text();
}

}  // namespace viewproj::cmd
