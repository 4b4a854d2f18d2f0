// A camera as a file describes it, its truth by the textbook formulas in 480 bits, and the library's camera of it.
//
// The truth is written another way round than the library on purpose: NDC first, then the viewport; shift and crop as
// moves of pixels; a quaternion by q v q*; a pose matrix inverted by Cramer's rule.
#pragma once

#include <string>

#include "random.hpp"
#include "reference/real.hpp"
#include "viewproj/viewproj.hpp"

namespace reference {

using ::Random;

enum class PoseKind { target, direction, rotation, worldFromCamera, cameraFromWorld };
enum class LensKind {
  fovY,
  fovX,
  fovDiagonal,
  nearSize,
  sensorBoth,
  sensorWidth,
  sensorHeight,
  sensorDiagonal,
  frustum,
  intrinsics,
  orthographic
};

inline constexpr PoseKind kPoseKinds[] = {PoseKind::target, PoseKind::direction, PoseKind::rotation,
                                          PoseKind::worldFromCamera, PoseKind::cameraFromWorld};
inline constexpr LensKind kLensKinds[] = {LensKind::fovY,         LensKind::fovX,           LensKind::fovDiagonal,
                                          LensKind::nearSize,     LensKind::sensorBoth,     LensKind::sensorWidth,
                                          LensKind::sensorHeight, LensKind::sensorDiagonal, LensKind::frustum,
                                          LensKind::intrinsics,   LensKind::orthographic};

struct Scene {
  PoseKind poseKind = PoseKind::target;
  viewproj::Vec3 position, target, up{0, 1, 0};  ///< target is the direction where poseKind says so
  viewproj::Quaternion rotation;
  viewproj::Mat4 matrix;
  viewproj::CameraAxes axes = viewproj::CameraAxes::RUB;

  LensKind lensKind = LensKind::fovY;
  double fov = 60, sensorWidth = 36, sensorHeight = 24, focalLength = 35;
  double left = -1, right = 1, bottom = -1, top = 1;  ///< frustum, orthographic; right and top also near size
  double fx = 1000, fy = 1000, cx = 960, cy = 540;
  double near = 0.1, far = 1000;
  double shiftX = 0, shiftY = 0;
  viewproj::Viewport viewport{1920, 1080};
  bool hasCrop = false;
  viewproj::Crop crop;
  viewproj::Convention convention;
};

viewproj::Camera build(const Scene& scene);

struct TruePose {
  Real3 eye;
  Real3 right, up, forward;                    ///< rows
  Real3 rightColumn, upColumn, forwardColumn;  ///< columns of the inverse
};

struct TrueLens {
  bool orthographic;
  Real left, right, bottom, top;  ///< of the whole frame, without shift
};

/// dot(normal, p) + offset, how far p lies inside; the normal has unit length.
struct TruePlane {
  Real3 normal;
  Real offset;

  Real distance(const Real3& p) const { return dot(normal, p) + offset; }
};

struct Truth {
  explicit Truth(const Scene& scene);

  /// Distances along the camera's axes.
  struct View {
    Real right, up, forward;
  };
  View view(const Real3& point) const;

  struct Screen {
    Real x, y, depth;
  };
  Screen screen(const View& view) const;

  /// The direction through a screen position, forward component 1 (perspective), and its offset in the window.
  struct Window {
    Real right, up;
  };
  Window window(const Real& x, const Real& y) const;
  Real3 direction(const Window& window) const;
  /// The world point at a window position and distance.
  Real3 pointAt(const Window& window, const Real& distance) const;
  /// The distance whose window depth is this.
  Real distanceAt(const Real& depth) const;
  /// left, right, bottom, top, near and far of a picture, crop and shift included. An infinite far has none.
  std::array<TruePlane, 6> planes(const viewproj::Viewport& picture) const;

  Scene scene;
  TruePose pose;
  TrueLens lens;
};

/// A camera of a random kind, lens and convention; its eye up to reach from the origin.
Scene randomScene(Random& random, double reach);

/// A point of the world whose true screen position is about a random one of the picture, enlarged by overscan, at a
/// distance between near and far (or near and 1e6 near).
viewproj::Vec3 pointInView(Random& random, const Truth& truth, double overscan = 1);

std::string describe(const Scene& scene);

inline Real3 toReal(const viewproj::Vec3& v) { return {v.x, v.y, v.z}; }

}  // namespace reference
