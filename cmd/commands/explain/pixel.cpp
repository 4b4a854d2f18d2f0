#include <cmath>

#include "camera/camera.hpp"
#include "camera/convention.hpp"
#include "camera/read_camera.hpp"
#include "commands/explain/explain.hpp"
#include "commands/explain/stages.hpp"
#include "text/error.hpp"
#include "text/number.hpp"
#include "viewproj/matrices.hpp"
#include "viewproj/screen.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

Term signedTerm(double sign, const std::string& name) { return sign < 0 ? Term{"-1", name} : Term{name}; }

void explainWindow(Explanation& e, const Camera& camera, const Vec2& pixel, const PixelStages& s) {
  const bool orthographic = camera.projection().isOrthographic();
  e.stage("pixel", "the pixel given");
  e.given("pixel.x", pixel.x);
  e.given("pixel.y", pixel.y);
  e.stage("fromCenter", "from where the viewing axis meets the screen");
  e.given("center.x", parts(camera).screen.centerX.hi);
  e.given("center.y", parts(camera).screen.centerY.hi);
  e.sum("fromCenter.x", {{"pixel.x"}, {"-1", "center.x"}}, s.fromCenter.x);
  e.sum("fromCenter.y", {{"pixel.y"}, {"-1", "center.y"}}, s.fromCenter.y);
  e.stage("window", orthographic ? "lengths right and up; scale = pixels per unit of length, viewport / (right - left)"
                                 : "tangents right and up; scale = pixels per tangent, viewport / (right - left)");
  e.given("scale.x", parts(camera).screen.scaleX.hi);
  e.given("scale.y", parts(camera).screen.scaleY.hi,
          parts(camera).screen.scaleY.hi < 0 ? "screen y runs downwards" : "");
  e.quotient("window.x", "fromCenter.x", "scale.x", s.window.x, "right");
  e.quotient("window.y", "fromCenter.y", "scale.y", s.window.y, "up");
}

/// In view space, and from there to the world.
void explainRay(Explanation& e, const Camera& camera, const PixelStages& s) {
  const bool orthographic = camera.projection().isOrthographic();
  const AxisSigns sign = axisSigns(e.writing().view);
  e.stage("view", orthographic ? "the ray's place in view space, and its direction along the viewing axis"
                               : "the point of the ray at distance 1, in view space");
  e.sum("view.x", {{"window.x"}}, s.window.x);
  e.sum("view.y", {signedTerm(sign.up, "window.y")}, sign.up * s.window.y + 0.0);
  e.given("view.z", sign.forward, sign.forward < 0 ? "z points back" : "z points forward");
  e.stage("toward", "toward = " + e.timesInWords("W", orthographic ? "(0, 0, view.z)" : "view") +
                        ", W without its translation: in world axes");
  e.matrix("W", worldFromView(camera.pose(), e.writing()));
  const std::vector<std::string> view = {orthographic ? "" : "view.x", orthographic ? "" : "view.y", "view.z", ""};
  const auto toward = components("toward");
  for (std::size_t i = 0; i < 3; ++i) e.sum(toward[i], e.product("W", i, view), s.toward[i]);

  e.stage("ray", "origin = eye" + (orthographic ? " + " + e.timesInWords("W", "(view.x, view.y, 0)") : "") +
                     "; direction = toward / its length");
  const auto origins = components("origin"), directions = components("direction"), eyes = components("eye");
  for (std::size_t i = 0; i < 3; ++i) {
    std::vector<Term> terms = {{eyes[i]}};
    if (orthographic)
      for (const Term& term : e.product("W", i, {"view.x", "view.y", "", ""})) terms.push_back(term);
    e.sum(origins[i], terms, s.ray.origin[i]);
  }
  e.root("length", {{toward[0], toward[0]}, {toward[1], toward[1]}, {toward[2], toward[2]}}, s.length);
  for (std::size_t i = 0; i < 3; ++i) e.quotient(directions[i], toward[i], "length", s.ray.direction[i]);
}

void explainPointBehind(Explanation& e, const Camera& camera, double depth, const DepthStages& d) {
  const bool orthographic = camera.projection().isOrthographic();
  e.stage("distance", orthographic ? "distance = offset + scale * depth, along the viewing axis"
                                   : "1 / distance = offset + scale * depth, linear in depth as 1/z is on the screen");
  e.given("depth", depth);
  e.given("offset", d.offset);
  e.given("scale", d.scale);
  e.sum(orthographic ? "distance" : "reciprocal", {{"offset"}, {"scale", "depth"}}, d.sum);
  if (d.point.status == DepthStatus::infinity) {
    e.remark("the window depth of infinity: a direction, no point");
    return;
  }
  if (!orthographic) e.quotient("distance", "1", "reciprocal", d.distance);
  e.stage("point", orthographic ? "point = origin + distance * toward" : "point = eye + distance * toward");
  const auto points = components("point"), toward = components("toward"), from = components("origin");
  for (std::size_t i = 0; i < 3; ++i) e.sum(points[i], {{from[i]}, {"distance", toward[i]}}, d.point.position[i]);
}

std::vector<double> numbers(const Vec3& v) { return {v.x, v.y, v.z}; }

}  // namespace

Explanation explainPixel(const Camera& camera, const Convention& writing, const Vec2& pixel,
                         std::optional<double> depth) {
  const PixelStages s = pixelStages(camera, pixel);
  Explanation e(writing);
  explainCamera(e, camera);
  explainWindow(e, camera, pixel, s);
  explainRay(e, camera, s);
  e.result({"origin", numbers(s.ray.origin), {}, {}});
  e.result({"direction", numbers(s.ray.direction), {}, {}});
  if (!depth) return e;
  if (!hasDepth(camera.projection()))
    throw InputError("--pixel: a window depth needs a camera with near; --near gives it");
  const DepthStages d = depthStages(camera, pixel, *depth);
  if (d.point.status == DepthStatus::beyond)
    throw InputError("--pixel: depth " + formatNumber(*depth) + " lies beyond infinity, whose window depth is " +
                     formatNumber(parts(camera).depthAtInfinity) + ": no point in front of the eye has it");
  explainPointBehind(e, camera, *depth, d);
  e.result({"point", numbers(d.point.position), {}, {}});
  return e;
}

}  // namespace viewproj::cmd
