// A camera from its view and projection matrices: the closed forms of matrices.cpp, solved for the window.
#include <cmath>

#include "camera/camera.hpp"
#include "camera/depth.hpp"
#include "viewproj/matrices.hpp"

namespace viewproj {

using namespace detail;
namespace {

[[noreturn]] void fail(const char* what) { throw CameraError("clipFromView", what); }

/// h where scale h + offset = out.
DoubleDouble solved(double out, DoubleDouble scale, DoubleDouble offset) noexcept {
  return (DoubleDouble(out) - offset) / scale;
}

/// The distance between two numbers of this size that differ in the last place: of floats, if every entry is one.
double lastPlaceOf(const Mat4& m) noexcept {
  bool areFloats = true;
  for (const auto& row : m.m)
    for (const double entry : row) areFloats = areFloats && double{static_cast<float>(entry)} == entry;
  return areFloats ? 0x1p-23 : 0x1p-52;
}

Projection projectionOf(const Mat4& m, const Convention& convention) {
  //                | x.scale  0        x.offset  |                  | x.scale  0        0        x.offset |
  // perspective  k | 0        y.scale  y.offset  |  orthographic  k | 0        y.scale  0        y.offset |
  //                | 0        0        a       b |                  | 0        0        b        a        |
  //                | 0        0        1       0 |                  | 0        0        0        1        |
  // with the columns X, Y, W, 1 that view space has up to the signs of its axes
  const AxisSigns sign = axisSigns(convention.view);
  ProjectionParts p;
  p.orthographic = m[3][2] == 0;
  const double divisor = p.orthographic ? m[3][3] : m[3][2] * sign.forward;
  if (divisor < 0 && m[3][0] == 0 && m[3][1] == 0 && m[3][3] == 0)
    fail("has the last row of a convention whose view z points the other way");
  if (!(divisor > 0) || m[3][0] != 0 || m[3][1] != 0 || (!p.orthographic && m[3][3] != 0))
    fail("has a last row that is not 0 0 0 1, or 0 0 1 0 with the convention's sign of view z");
  const std::size_t atOffset = p.orthographic ? 3 : 2, others = p.orthographic ? 2 : 3;
  if (m[0][1] != 0 || m[1][0] != 0 || m[0][others] != 0 || m[1][others] != 0 || m[2][0] != 0 || m[2][1] != 0)
    fail("has an entry that a projection without skew does not have");
  const auto entry = [&](std::size_t i, std::size_t j, double axisSign) {
    return DoubleDouble(m[i][j] * axisSign) / DoubleDouble(divisor);
  };
  const double ofOffset = p.orthographic ? 1 : sign.forward, down = convention.ndcY == NdcY::down ? -1 : 1;
  const DoubleDouble scaleX = entry(0, 0, 1), scaleY = entry(1, 1, sign.up * down);
  const DoubleDouble offsetX = entry(0, atOffset, ofOffset), offsetY = entry(1, atOffset, ofOffset * down);
  if (scaleX.hi > 0 && scaleY.hi < 0) fail("has the y of a convention whose ndcY, or view y, points the other way");
  if (!(scaleX.hi > 0 && scaleY.hi > 0)) fail("mirrors x, or has no width or height");
  p.left = solved(-1, scaleX, offsetX);
  p.right = solved(1, scaleX, offsetX);
  p.bottom = solved(-1, scaleY, offsetY);
  p.top = solved(1, scaleY, offsetY);
  p.width = DoubleDouble(2) / scaleX;
  p.height = DoubleDouble(2) / scaleY;
  p.reachX = (1 + std::fabs(offsetX.hi)) / scaleX.hi;
  p.reachY = (1 + std::fabs(offsetY.hi)) / scaleY.hi;

  const auto [atNear, atFar] = ndcDepths(convention);
  const DoubleDouble ofForward = entry(2, 2, sign.forward), constant = entry(2, 3, 1);
  if (p.orthographic) {
    p.near = solved(atNear, ofForward, constant).hi;
    p.far = solved(atFar, ofForward, constant).hi;
  } else {
    const DoubleDouble toFar = DoubleDouble(atFar) - ofForward;
    p.near = (constant / (DoubleDouble(atNear) - ofForward)).hi;
    p.far = std::fabs(toFar.hi) <= lastPlaceOf(m) ? kInfiniteFar : (constant / toFar).hi;
  }
  if (!(p.near < p.far && (p.orthographic || p.near > 0)))
    fail("has a depth row that does not fit the convention's ndcZ and reverseZ");
  return made(p);
}

Pose poseOf(const Mat4& viewFromWorld, const Convention& convention) {
  constexpr CameraAxes kAxes[] = {CameraAxes::RUB, CameraAxes::RUF, CameraAxes::RDF};  // in the order of ViewAxes
  try {
    const Pose pose = poseFromCameraFromWorld(viewFromWorld, kAxes[static_cast<std::size_t>(convention.view)]);
    if (pose.world() != convention.world) throw CameraError("", "is of a world of the other handedness");
    return pose;
  } catch (const CameraError& e) {
    throw CameraError("viewFromWorld", e.message());
  }
}

}  // namespace

Camera cameraFromMatrices(const Mat4& viewFromWorld, const Mat4& clipFromView, const Viewport& viewport,
                          const Convention& convention) {
  for (const auto& row : clipFromView.m)
    for (const double entry : row)
      if (!std::isfinite(entry)) fail("has an entry that is not a finite number");
  return makeCamera(poseOf(viewFromWorld, convention), projectionOf(clipFromView, convention), viewport, convention);
}

Camera cameraFromMatrices(std::span<const double, 16> view, std::span<const double, 16> projection,
                          const Viewport& viewport, const Convention& c) {
  return cameraFromMatrices(fromStorageOrder(view, c), fromStorageOrder(projection, c), viewport, c);
}
Camera cameraFromMatrices(std::span<const float, 16> view, std::span<const float, 16> projection,
                          const Viewport& viewport, const Convention& c) {
  return cameraFromMatrices(fromStorageOrder(view, c), fromStorageOrder(projection, c), viewport, c);
}

Camera cameraFromMatrices(const double* view, const double* projection, const Viewport& viewport, const Convention& c) {
  return cameraFromMatrices(std::span<const double, 16>(view, 16), std::span<const double, 16>(projection, 16),
                            viewport, c);
}
Camera cameraFromMatrices(const float* view, const float* projection, const Viewport& viewport, const Convention& c) {
  return cameraFromMatrices(std::span<const float, 16>(view, 16), std::span<const float, 16>(projection, 16), viewport,
                            c);
}

}  // namespace viewproj
