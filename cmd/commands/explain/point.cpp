#include <cmath>

#include "camera/camera.hpp"
#include "camera/convention.hpp"
#include "camera/read_camera.hpp"
#include "commands/explain/explain.hpp"
#include "commands/explain/stages.hpp"
#include "text/error.hpp"
#include "viewproj/clip.hpp"
#include "viewproj/matrices.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

bool dividesWeight(double w) { return w != 0 && w != 1; }

void explainWorld(Explanation& e, const Vec4& local, const std::optional<Mat4>& model, const Vec4& placed,
                  const Vec3& world) {
  e.stage("local", local.w == 0 ? "the direction given (w = 0)" : "the point given");
  const double coordinates[] = {local.x, local.y, local.z};
  const auto locals = components("local"), worlds = components("world");
  for (std::size_t i = 0; i < 3; ++i) e.given(locals[i], coordinates[i]);
  e.given("local.w", local.w);

  std::string weighted = "local";
  const double placedAt[] = {placed.x, placed.y, placed.z};
  if (model) {
    weighted = dividesWeight(local.w) ? "placed" : "world";
    e.stage(weighted, weighted + " = " + e.timesInWords("model", "local") + ", rounded to doubles once");
    e.matrix("model", *model);
    const auto names = components(weighted);
    for (std::size_t i = 0; i < 3; ++i)
      e.sum(names[i], e.product("model", i, {"local.x", "local.y", "local.z", "local.w"}), placedAt[i]);
  }
  if (weighted == "world") return;
  e.stage("world", dividesWeight(local.w) ? "the weight divided out" : "no model matrix: the same");
  const auto from = components(weighted);
  for (std::size_t i = 0; i < 3; ++i) {
    if (dividesWeight(local.w))
      e.quotient(worlds[i], from[i], "local.w", world[i]);
    else
      e.sum(worlds[i], {{from[i]}}, world[i]);
  }
}

void explainRelative(Explanation& e, const Vec3& relative, bool isDirection) {
  e.stage("relative", isDirection ? "a direction has no place: the eye does not matter"
                                  : "relative = world - eye, before anything is rotated or rounded");
  const auto names = components("relative"), worlds = components("world"), eyes = components("eye");
  for (std::size_t i = 0; i < 3; ++i) {
    if (isDirection)
      e.sum(names[i], {{worlds[i]}}, relative[i]);
    else
      e.sum(names[i], {{worlds[i]}, {"-1", eyes[i]}}, relative[i]);
  }
}

std::string axesInWords(ViewAxes axes) {
  return axes == ViewAxes::RUB   ? "x right, y up, z back"
         : axes == ViewAxes::RUF ? "x right, y up, z forward"
                                 : "x right, y down, z forward";
}

void explainView(Explanation& e, const Camera& camera, const PointStages& s, bool isDirection) {
  const ViewAxes axes = e.writing().view;
  e.stage("view", "view = " + e.timesInWords("V", "relative") +
                      ", V without its translation: the eye is subtracted already (" + axesInWords(axes) + ")");
  e.matrix("V", viewFromWorld(camera.pose(), e.writing()));
  const auto names = components("view");
  for (std::size_t i = 0; i < 3; ++i)
    e.sum(names[i], e.product("V", i, {"relative.x", "relative.y", "relative.z", ""}), s.view[i]);
  e.given("view.w", isDirection ? 0 : 1, isDirection ? "a direction" : "a point");
  if (isDirection) return;
  const bool back = axisSigns(axes).forward < 0;
  e.sum("viewDistance", {back ? Term{"-1", "view.z"} : Term{"view.z"}}, s.screen.viewDistance,
        "along the viewing axis");
}

/// Where w comes from.
std::string weightInWords(const Camera& camera, const Convention& c) {
  const std::string line = c.vectors == Vectors::row ? "the fourth column of P" : "the fourth row of P";
  if (camera.projection().isOrthographic()) return line + " is 0 0 0 1: w stays what it is";
  return line + " makes w = " + (axisSigns(c.view).forward < 0 ? "-z" : "z") + ", the distance along the view";
}

void explainClip(Explanation& e, const Camera& camera, const PointStages& s) {
  e.stage("clip", "clip = " + e.timesInWords("P", "view"));
  e.matrix("P", clipFromView(camera.projection(), e.writing()));
  const std::vector<std::string> view = {"view.x", "view.y", "view.z", "view.w"};
  e.sum("clip.x", e.product("P", 0, view), s.clip.x);
  e.sum("clip.y", e.product("P", 1, view), s.clip.y);
  e.sum("clip.z", e.product("P", 2, view), s.clip.z);
  e.sum("clip.w", e.product("P", 3, view), s.clip.w, weightInWords(camera, e.writing()));
}

void explainInequalities(Explanation& e, const PointStages& s) {
  const Convention& c = e.writing();
  e.stage("inequalities", std::string("how far inside each side; inside is from 0 on") +
                              (std::isnan(s.margins.far) ? "; far is infinite: no inequality" : ""));
  const auto margin = [&](const char* side, const std::string& axis, bool atLow, double value) {
    const std::string coordinate = "clip." + axis;
    const bool fromZero = axis == "z" && atLow && c.ndcZ == NdcZ::zeroToOne;
    std::vector<Term> terms = {{"clip.w"}, atLow ? Term{coordinate} : Term{"-1", coordinate}};
    if (fromZero) terms = {{coordinate}};
    e.sum(std::string("margin.") + side, std::move(terms), value,
          axis +
              (fromZero ? " >= 0"
               : atLow  ? " >= -w"
                        : " <= w") +
              (value >= 0  ? ": inside"
               : value < 0 ? ": OUTSIDE"
                           : ""));
  };
  const bool up = c.ndcY == NdcY::up;
  margin("left", "x", true, s.margins.left);
  margin("right", "x", false, s.margins.right);
  margin("bottom", "y", up, s.margins.bottom);
  margin("top", "y", !up, s.margins.top);
  margin("near", "z", !c.reverseZ, s.margins.near);
  if (!std::isnan(s.margins.far)) margin("far", "z", c.reverseZ, s.margins.far);
}

void explainDepth(Explanation& e, const Camera& camera, const Vec4& point, const PointStages& s) {
  const bool exchanged = e.writing().reverseZ != camera.convention().reverseZ;
  const std::vector<Term> terms = e.product("S", 2, {"ndc.x", "ndc.y", "ndc.z", "1"});
  if (!exchanged) {
    e.sum("depth", terms, s.screen.depth, "window depth");
    return;
  }
  // The file's own depth: near and far change places.
  const Viewport& v = camera.viewport();
  Convention exchange = camera.convention();
  exchange.reverseZ = e.writing().reverseZ;
  const Camera written = makeCamera(camera.pose(), camera.projection(), v, exchange);
  e.given("depth.first", v.depthFirst);
  e.given("depth.second", v.depthSecond);
  e.sum("depth.written", terms, worldToScreen(written, point).depth, "in the convention written");
  e.sum("depth", {{"depth.first"}, {"depth.second"}, {"-1", "depth.written"}}, s.screen.depth,
        "window depth: the file has reverseZ " + std::string(camera.convention().reverseZ ? "true" : "false"));
}

void explainScreen(Explanation& e, const Camera& camera, const Vec4& point, const PointStages& s) {
  if (std::isnan(s.ndc.x)) {
    e.remark(s.screen.status == PointStatus::behind
                 ? "w is not above 0: the point lies on or behind the plane through the eye, and nothing is divided"
                 : "w is 0: a direction has no picture in orthographic");
    return;
  }
  e.stage("ndc", "ndc = clip / w");
  e.quotient("ndc.x", "clip.x", "clip.w", s.ndc.x);
  e.quotient("ndc.y", "clip.y", "clip.w", s.ndc.y);
  e.quotient("ndc.z", "clip.z", "clip.w", s.ndc.z);
  e.stage("screen", "(screen.x, screen.y, depth) = " + e.timesInWords("S", "ndc") + ", the viewport's pixels");
  e.matrix("S", screenFromNdc(camera.viewport(), e.writing()));
  e.sum("screen.x", e.product("S", 0, {"ndc.x", "ndc.y", "ndc.z", "1"}), s.screen.x);
  e.sum("screen.y", e.product("S", 1, {"ndc.x", "ndc.y", "ndc.z", "1"}), s.screen.y);
  explainDepth(e, camera, point, s);
}

/// From view space straight to the pixel: without near there is neither clip space nor NDC.
void explainScreenOfView(Explanation& e, const Camera& camera, const PointStages& s) {
  if (std::isnan(s.screen.x)) {
    e.remark("the point lies on or behind the plane through the eye: it has no pixel");
    return;
  }
  const Intrinsics k = camera.intrinsics();
  const bool viewIsUp = axisSigns(e.writing().view).up > 0, screenIsUp = camera.viewport().origin == Origin::bottomLeft;
  e.stage("screen", "the pixel straight from view space; clip, NDC and depth need near, which this camera has not");
  e.given("fx", k.fx);
  e.given("fy", viewIsUp == screenIsUp ? k.fy : -k.fy,
          viewIsUp == screenIsUp ? "" : "negative: y of view and screen run opposite ways");
  e.given("cx", k.cx);
  e.given("cy", k.cy);
  e.quotient("slope.x", "view.x", "viewDistance", s.view[0] / s.screen.viewDistance);
  e.quotient("slope.y", "view.y", "viewDistance", s.view[1] / s.screen.viewDistance);
  e.sum("screen.x", {{"cx"}, {"fx", "slope.x"}}, s.screen.x);
  e.sum("screen.y", {{"cy"}, {"fy", "slope.y"}}, s.screen.y);
}

void giveResults(Explanation& e, const ScreenPoint& p) {
  static constexpr std::pair<Side, const char*> kSides[] = {{sideLeft, "left"},     {sideRight, "right"},
                                                            {sideBottom, "bottom"}, {sideTop, "top"},
                                                            {sideNear, "near"},     {sideFar, "far"}};
  e.result({"screen", {p.x, p.y}, {}, {}});
  e.result({"depth", {p.depth}, {}, {}});
  e.result({"viewDistance", {p.viewDistance}, {}, {}});
  e.result({"visible", {}, {}, p.visible()});
  std::vector<std::string> outside;
  if (p.status == PointStatus::behind) outside.push_back("behind");
  for (const auto& [side, name] : kSides)
    if (p.outside & side) outside.push_back(name);
  if (!outside.empty()) e.result({"outside", {}, outside, {}});
}

}  // namespace

void explainCamera(Explanation& e, const Camera& camera) {
  const Projection& p = camera.projection();
  e.stage("camera", p.isOrthographic() ? "as it was read; window edges are lengths"
                                       : "as it was read; window edges are tangents, at distance 1");
  const Vec3 eye = rounded(unroundedEye(parts(camera).pose));
  const auto names = components("eye");
  for (std::size_t i = 0; i < 3; ++i) e.given(names[i], eye[i]);
  e.given("window.left", p.left());
  e.given("window.right", p.right());
  e.given("window.bottom", p.bottom());
  e.given("window.top", p.top());
  if (hasDepth(p)) e.given("near", p.zNear());
  if (std::isfinite(p.zFar())) e.given("far", p.zFar());
}

Explanation explainPoint(const Camera& camera, const Convention& writing, const Vec4& local,
                         const std::optional<Mat4>& model) {
  const Vec4 placed = model ? toWorld(*model, local) : local;
  const PointStages s = pointStages(camera, placed, writing);
  if (s.screen.status == PointStatus::outOfRange)
    throw InputError(model && local.w == 0 ? "--model takes the direction to 0"
                                           : "--model takes the point out of the range of numbers");
  Explanation e(writing);
  explainCamera(e, camera);
  explainWorld(e, local, model, placed, s.world);
  explainRelative(e, s.relative, local.w == 0);
  explainView(e, camera, s, local.w == 0);
  if (hasDepth(camera.projection())) {
    explainClip(e, camera, s);
    explainInequalities(e, s);
    explainScreen(e, camera, placed, s);
  } else {
    explainScreenOfView(e, camera, s);
  }
  giveResults(e, s.screen);
  return e;
}

}  // namespace viewproj::cmd
