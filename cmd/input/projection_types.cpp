#include "input/projection_types.hpp"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "camera/camera.hpp"
#include "input/camera_fields.hpp"
#include "input/viewport_fields.hpp"
#include "text/names.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

constexpr const char* kAboveZero = "must be above 0";

double readFar(const ObjectReader& fields) { return fields.number(field::zFar).value_or(kInfiniteFar); }

std::optional<double> positive(const ObjectReader& fields, const Field& field) {
  const auto number = fields.number(field);
  if (number && !(*number > 0)) fields.fail(field, kAboveZero);
  return number;
}

const Viewport& requireViewport(const ObjectReader& fields, const std::optional<Viewport>& viewport, const char* why) {
  if (!viewport) fields.fail(std::string("needs a viewport ") + why + "; --viewport WIDTHxHEIGHT gives one");
  return *viewport;
}

ReadProjection readPerspective(const ObjectReader& f, const std::optional<Viewport>& viewport) {
  f.way(field::perspective);
  const double near = f.requireNumber(field::zNear);
  const double far = readFar(f);
  if (f.has(field::nearWidth))
    return {perspectiveNearSize(f.requireNumber(field::nearWidth), f.requireNumber(field::nearHeight), near, far),
            true};
  const auto sensorWidth = positive(f, field::sensorWidth), sensorHeight = positive(f, field::sensorHeight);
  const auto ownAspect = f.number(field::aspect);
  const bool ownShape = ownAspect || (sensorWidth && sensorHeight);
  const DoubleDouble aspect = ownAspect  ? DoubleDouble(*ownAspect)
                              : ownShape ? DoubleDouble(1)
                                         : viewportAspect(requireViewport(f, viewport, "or an aspect"));
  if (const auto fov = f.number(field::fovY)) return {perspectiveFovY(*fov, aspect, near, far), ownShape};
  if (const auto fov = f.number(field::fovX)) return {perspectiveFovX(*fov, aspect, near, far), ownShape};
  if (const auto fov = f.number(field::fovDiagonal)) return {perspectiveFovDiagonal(*fov, aspect, near, far), ownShape};
  return {perspectiveFocalLength(f.requireNumber(field::focalLength), sensorWidth.value_or(0), sensorHeight.value_or(0),
                                 aspect, near, far),
          ownShape};
}

ReadProjection readFrustum(const ObjectReader& f, const std::optional<Viewport>&) {
  const double left = f.requireNumber(field::left), right = f.requireNumber(field::right);
  const double bottom = f.requireNumber(field::bottom), top = f.requireNumber(field::top);
  const double near = f.requireNumber(field::zNear);
  return {frustum(left, right, bottom, top, near, readFar(f)), true};
}

ReadProjection readOrthographic(const ObjectReader& f, const std::optional<Viewport>& viewport) {
  f.way(field::orthographic);
  const double near = f.requireNumber(field::orthoNear);
  const double far = f.requireNumber(field::orthoFar);
  const auto width = positive(f, field::orthoWidth), height = positive(f, field::orthoHeight);
  if (width || height) {
    const double w = width.value_or(0) / 2, h = height.value_or(0) / 2;
    if (width && !(w > 0)) f.fail(field::orthoWidth, kAboveZero);
    if (height && !(h > 0)) f.fail(field::orthoHeight, kAboveZero);
    if (width && height) return {orthographic(-w, w, -h, h, near, far), true};
    const auto ownAspect = positive(f, field::aspect);
    const DoubleDouble aspect =
        ownAspect ? DoubleDouble(*ownAspect) : viewportAspect(requireViewport(f, viewport, "or an aspect"));
    const DoubleDouble halfWidth = width ? DoubleDouble(w) : DoubleDouble(h) * aspect;
    const DoubleDouble halfHeight = width ? DoubleDouble(w) / aspect : DoubleDouble(h);
    return {orthographic(-halfWidth, halfWidth, -halfHeight, halfHeight, near, far), ownAspect.has_value()};
  }
  const double left = f.requireNumber(field::left), right = f.requireNumber(field::right);
  const double bottom = f.requireNumber(field::bottom), top = f.requireNumber(field::top);
  return {orthographic(left, right, bottom, top, near, far), true};
}

ReadProjection readIntrinsics(const ObjectReader& f, const std::optional<Viewport>& viewport) {
  const double fx = f.requireNumber(field::fx), fy = f.requireNumber(field::fy);
  const double cx = f.requireNumber(field::cx), cy = f.requireNumber(field::cy);
  if (f.numberOr(field::skew, 0) != 0) f.fail(field::skew, "must be 0: pixels of a skewed grid are not modelled");
  const double near = f.requireNumber(field::zNear);
  return {
      intrinsics(fx, fy, cx, cy, requireViewport(f, viewport, "whose pixels fx, fy, cx, cy count"), near, readFar(f)),
      true, true};
}

/// x = cx + ax scrz X/Z, y = cy + ay scrz Y/Z. zMin and zMax, and where the picture lies, are the viewport's.
ReadProjection readPs2(const ObjectReader& f, const std::optional<Viewport>& viewport) {
  for (const Field* field : field::ps2.required) f.requireNumber(*field);
  const double scrz = *positive(f, field::scrz), ax = *positive(f, field::ax), ay = *positive(f, field::ay);
  const double cx = f.requireNumber(field::cx), cy = f.requireNumber(field::cy);
  const double near = f.requireNumber(field::zNear);
  const DoubleDouble fx = twoProd(ax, scrz), fy = twoProd(ay, scrz);
  for (const auto& [field, focal] : {std::pair(&field::ax, fx), std::pair(&field::ay, fy)})
    if (!(focal.hi > 0 && std::isfinite(focal.hi))) f.fail(*field, "times scrz leaves the range of doubles");
  return {intrinsics(fx, fy, cx, cy, requireViewport(f, viewport, "around cx, cy"), near, readFar(f)), true, true};
}

/// The frame lies around (cx, cy), and depth runs from zMax to zMin.
void placePs2Viewport(const ObjectReader& camera, const ObjectReader& f, Viewport& v) {
  const auto given = camera.object(field::viewport);
  for (const Field* field : {&field::x, &field::y, &field::depthRange})
    if (given->has(*field)) given->fail(*field, "is already given by the ps2 projection's cx, cy, zMin and zMax");
  v.x = f.requireNumber(field::cx) - v.width / 2;
  v.y = f.requireNumber(field::cy) - v.height / 2;
  v.depthFirst = f.requireNumber(field::zMin);
  v.depthSecond = f.requireNumber(field::zMax);
}

constexpr ProjectionType kTypes[] = {
    {kPerspective, field::perspective, readPerspective},
    {kFrustum, field::frustum, readFrustum},
    {kIntrinsics, field::intrinsics, readIntrinsics, true},
    {kOrthographic, field::orthographic, readOrthographic, false, nullptr, false, nullptr, "--orthographic"},
    {kPs2, field::ps2, readPs2, true, "ps2", true, placePs2Viewport},
};

}  // namespace

std::span<const ProjectionType> projectionTypes() { return kTypes; }

std::vector<std::string_view> projectionTypeNames() {
  std::vector<std::string_view> names;
  for (const ProjectionType& type : kTypes) names.push_back(type.name);
  return names;
}

Projection readProjection(const ObjectReader& fields, const ProjectionType& type,
                          const std::optional<Viewport>& viewport, bool allowStretch) {
  const ReadProjection read = type.read(fields, viewport);
  if (viewport && read.hasOwnShape && !read.hasOwnPixelShape && !allowStretch)
    requireShape(windowAspect(parts(read.projection)), *viewport, fields);
  const auto shift = fields.numbers(field::shift, 2, 2);
  return shift ? shifted(read.projection, (*shift)[0], (*shift)[1]) : read.projection;
}

const ProjectionType& requireProjectionType(const ObjectReader& fields) {
  std::vector<std::pair<std::string_view, const ProjectionType*>> table;
  for (const ProjectionType& type : kTypes) table.push_back({type.name, &type});
  const auto type = fields.choice(field::type, table);
  if (!type) fields.fail("needs a type: " + alternatives(projectionTypeNames()));
  fields.allow((*type)->form);
  return **type;
}

}  // namespace viewproj::cmd
