#include "input/projection_types.hpp"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "camera/camera.hpp"
#include "input/viewport_fields.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

double readFar(const ObjectReader& fields) { return fields.number("far").value_or(kInfiniteFar); }

const Viewport& requireViewport(const ObjectReader& fields, const std::optional<Viewport>& viewport, const char* why) {
  if (!viewport) fields.fail(std::string("needs a viewport ") + why + "; --viewport WIDTHxHEIGHT gives one");
  return *viewport;
}

ReadProjection readPerspective(const ObjectReader& f, const std::optional<Viewport>& viewport) {
  f.allow({"type", "fovY", "fovX", "fovDiagonal", "nearWidth", "nearHeight", "focalLength", "sensorWidth",
           "sensorHeight", "aspect", "near", "far", "shift"});
  static constexpr std::string_view kWays[] = {"fovY", "fovX", "fovDiagonal", "nearWidth", "focalLength"};
  std::string given;
  int ways = 0;
  for (std::string_view way : kWays)
    if (f.has(way) || (way == "nearWidth" && f.has("nearHeight"))) {
      ++ways;
      given += (given.empty() ? "" : " and ") + std::string(way);
    }
  const double near = f.requireNumber("near");
  const double far = readFar(f);
  const auto ownAspect = f.number("aspect");
  const auto sensorWidth = f.number("sensorWidth");
  const auto sensorHeight = f.number("sensorHeight");
  if (ways != 1)
    f.fail((ways == 0 ? "has no opening" : "has " + given) +
           "; one of fovY, fovX, fovDiagonal, nearWidth with nearHeight, focalLength with sensorWidth or "
           "sensorHeight is expected");
  if ((sensorWidth || sensorHeight) && !f.has("focalLength"))
    f.fail(sensorWidth ? "sensorWidth" : "sensorHeight", "goes with focalLength");

  if (f.has("nearWidth") || f.has("nearHeight")) {
    if (ownAspect) f.fail("aspect", "is already given by nearWidth and nearHeight");
    return {perspectiveNearSize(f.requireNumber("nearWidth"), f.requireNumber("nearHeight"), near, far), true};
  }
  const bool bothSides = sensorWidth && sensorHeight;
  if (bothSides && ownAspect) f.fail("aspect", "is already given by sensorWidth and sensorHeight");
  if (sensorWidth && !(*sensorWidth > 0)) f.fail("sensorWidth", "must be above 0");
  if (sensorHeight && !(*sensorHeight > 0)) f.fail("sensorHeight", "must be above 0");
  const DoubleDouble aspect = bothSides   ? DoubleDouble(1)
                              : ownAspect ? DoubleDouble(*ownAspect)
                                          : viewportAspect(requireViewport(f, viewport, "or an aspect"));
  const bool ownShape = ownAspect || bothSides;
  if (const auto fov = f.number("fovY")) return {perspectiveFovY(*fov, aspect, near, far), ownShape};
  if (const auto fov = f.number("fovX")) return {perspectiveFovX(*fov, aspect, near, far), ownShape};
  if (const auto fov = f.number("fovDiagonal")) return {perspectiveFovDiagonal(*fov, aspect, near, far), ownShape};
  return {perspectiveFocalLength(f.requireNumber("focalLength"), sensorWidth.value_or(0), sensorHeight.value_or(0),
                                 aspect, near, far),
          ownShape};
}

ReadProjection readFrustum(const ObjectReader& f, const std::optional<Viewport>&) {
  f.allow({"type", "left", "right", "bottom", "top", "near", "far", "shift"});
  const double left = f.requireNumber("left"), right = f.requireNumber("right");
  const double bottom = f.requireNumber("bottom"), top = f.requireNumber("top");
  const double near = f.requireNumber("near");
  return {frustum(left, right, bottom, top, near, readFar(f)), true};
}

ReadProjection readOrthographic(const ObjectReader& f, const std::optional<Viewport>&) {
  f.allow({"type", "left", "right", "bottom", "top", "width", "height", "near", "far", "shift"});
  const auto width = f.number("width");
  const auto height = f.number("height");
  const bool hasEdges = f.has("left") || f.has("right") || f.has("bottom") || f.has("top");
  const double near = f.requireNumber("near");
  const double far = f.requireNumber("far");
  if (width || height) {
    if (hasEdges) f.fail("has both edges and a width or height; either left, right, bottom, top or width, height");
    const double w = f.requireNumber("width") / 2, h = f.requireNumber("height") / 2;
    if (!(w > 0)) f.fail("width", "must be above 0");
    if (!(h > 0)) f.fail("height", "must be above 0");
    return {orthographic(-w, w, -h, h, near, far), true};
  }
  if (!hasEdges) f.fail("needs left, right, bottom, top or width, height");
  const double left = f.requireNumber("left"), right = f.requireNumber("right");
  const double bottom = f.requireNumber("bottom"), top = f.requireNumber("top");
  return {orthographic(left, right, bottom, top, near, far), true};
}

ReadProjection readIntrinsics(const ObjectReader& f, const std::optional<Viewport>& viewport) {
  f.allow({"type", "fx", "fy", "cx", "cy", "skew", "near", "far", "shift"});
  const double fx = f.requireNumber("fx"), fy = f.requireNumber("fy");
  const double cx = f.requireNumber("cx"), cy = f.requireNumber("cy");
  if (f.numberOr("skew", 0) != 0) f.fail("skew", "must be 0: pixels of a skewed grid are not modelled");
  const double near = f.requireNumber("near");
  return {
      intrinsics(fx, fy, cx, cy, requireViewport(f, viewport, "whose pixels fx, fy, cx, cy count"), near, readFar(f)),
      true, true};
}

/// x = cx + ax scrz X/Z, y = cy + ay scrz Y/Z. zMin and zMax, and where the picture lies, are the viewport's.
ReadProjection readPs2(const ObjectReader& f, const std::optional<Viewport>& viewport) {
  f.allow({"type", "scrz", "ax", "ay", "cx", "cy", "zMin", "zMax", "near", "far", "shift"});
  const double scrz = f.requireNumber("scrz");
  const double ax = f.requireNumber("ax"), ay = f.requireNumber("ay");
  const double cx = f.requireNumber("cx"), cy = f.requireNumber("cy");
  f.requireNumber("zMin");
  f.requireNumber("zMax");
  const double near = f.requireNumber("near");
  for (const char* name : {"scrz", "ax", "ay"})
    if (!(f.requireNumber(name) > 0)) f.fail(name, "must be above 0");
  const DoubleDouble fx = twoProd(ax, scrz), fy = twoProd(ay, scrz);
  for (const auto& [name, focal] : {std::pair("ax", fx), std::pair("ay", fy)})
    if (!(focal.hi > 0 && std::isfinite(focal.hi))) f.fail(name, "times scrz leaves the range of doubles");
  return {intrinsics(fx, fy, cx, cy, requireViewport(f, viewport, "around cx, cy"), near, readFar(f)), true, true};
}

/// The frame lies around (cx, cy), and depth runs from zMax to zMin.
void placePs2Viewport(const ObjectReader& camera, const ObjectReader& f, Viewport& v) {
  const auto given = camera.object("viewport");
  for (const char* name : {"x", "y", "depthRange"})
    if (given->has(name)) given->fail(name, "is already given by the ps2 projection's cx, cy, zMin and zMax");
  v.x = f.requireNumber("cx") - v.width / 2;
  v.y = f.requireNumber("cy") - v.height / 2;
  v.depthFirst = f.requireNumber("zMin");
  v.depthSecond = f.requireNumber("zMax");
}

constexpr ProjectionType kTypes[] = {
    {"perspective", readPerspective},
    {"frustum", readFrustum},
    {"intrinsics", readIntrinsics},
    {"orthographic", readOrthographic},
    {"ps2", readPs2, "ps2", true, placePs2Viewport},
};

}  // namespace

const ProjectionType& requireProjectionType(const ObjectReader& fields) {
  std::vector<std::pair<std::string_view, const ProjectionType*>> table;
  std::string names;
  for (const ProjectionType& type : kTypes) {
    table.push_back({type.name, &type});
    names += std::string(names.empty() ? "" : &type == std::end(kTypes) - 1 ? " or " : ", ") + std::string(type.name);
  }
  const auto type = fields.choice("type", table);
  if (!type) fields.fail("needs a type: " + names);
  return **type;
}

}  // namespace viewproj::cmd
