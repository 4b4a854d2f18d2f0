// Lens distortion, between the picture of an ideal pinhole camera and the pixels.
//
// Coordinates are OpenCV's: X right, Y down, Z forward of the eye. A lens maps a direction (X, Y, Z) to a point of the
// plane (x, y), and the pixel is the principal point + (focal length) (x, y). Every lens sees a cone about its axis, in
// which it is proven one-to-one: a direction has a pixel if and only if it is nearer to the axis than limitDegrees,
// which may be up to 180 degrees.
//
// With R = hypot(X, Y), d = hypot(R, Z) and Brown's polynomials
//   F(x, y) = (x g + 2 p1 x y + p2 (u + 2 x^2),  y g + p1 (u + 2 y^2) + 2 p2 x y),   u = x^2 + y^2,
//   g = (1 + k1 u + k2 u^2 + k3 u^3) / (1 + k4 u + k5 u^2 + k6 u^3)
// the models are
//   brown          F(X / Z, Y / Z)
//   omni           F(X / k, Y / k)                                  k = Z + xi d
//   double-sphere  (X, Y) / (alpha hypot(R, k) + (1 - alpha) k)     k = Z + xi d
//   unified        (X, Y) / (alpha sqrt(beta R^2 + Z^2) + (1 - alpha) Z)
//   fisheye        (X, Y) / R t (1 + k1 t^2 + k2 t^4 + k3 t^6 + k4 t^8)   t = atan2(R, Z)
//   fov            (X, Y) / R t / omega                                   t = atan2(2 tan(omega / 2) R, Z)
//
// Focal lengths of a calibration belong to these formulas. Their slope on the axis is not 1 for omni and double-sphere,
// 1 / (1 + xi), and for fov. The pinhole camera that agrees with the lens there has the focal lengths times the slope:
// calibrated() makes it. A MEI camera made without it is wrong by a factor of 1 + xi.
//
// Example:
//   const Viewport picture{.width = 1280, .height = 800};
//   const Lens lens = fisheyeLens({0, 0, 0, 0});
//   const Projection file = intrinsics(400, 400, 640, 400, picture, 0, kInfiniteFar);  // a calibration's numbers
//   const Pose pose = lookAlong({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, Handedness::right);
//   const Camera camera = withLens(makeCamera(pose, calibrated(file, lens), picture), lens);
//   std::printf("%.4f", worldToScreen(camera, Vec3{1, 0, 0}).x);  // prints 1268.3185
#pragma once

#include <array>
#include <optional>
#include <utility>

#include "viewproj/camera.hpp"

namespace viewproj {

namespace detail {
struct LensParts;
}

enum class LensModel {
  brown,         ///< Brown-Conrady, rational
  fisheye,       ///< Kannala-Brandt, "equidistant"
  unified,       ///< UCM, and with beta EUCM
  doubleSphere,  ///< DS
  omni,          ///< MEI, "omni-radtan", OpenCV's omnidir
  fov,           ///< Devernay-Faugeras, ATAN
};

/// Why a lens sees only a part of all directions.
enum class LimitCause {
  none,    ///< it sees all, a brown lens all in front
  fold,    ///< two directions would have the same pixel
  pole,    ///< a denominator reaches 0
  stated,  ///< the calibration states a limit
};

/// Made by the functions below. A copy shares its numbers.
class Lens {
 public:
  Lens(const Lens&) noexcept = default;
  Lens& operator=(const Lens&) noexcept = default;

  LensModel model() const noexcept;
  /// k1 ... k6 of brown and omni, k1 ... k4 of a fisheye, p1, p2; 0 of others, as all that follow.
  const std::array<double, 6>& k() const noexcept;
  const std::array<double, 2>& p() const noexcept;
  double xi() const noexcept;
  double alpha() const noexcept;
  /// 1 of others.
  double beta() const noexcept;
  double omega() const noexcept;
  /// Directions at this angle off the axis or more have no pixel. Below it, no two have the same pixel: this is proven,
  /// with the tangential terms, so the true limit is this angle or slightly more. Infinite if there is no limit.
  double limitDegrees() const noexcept;
  LimitCause limitCause() const noexcept;

 private:
  friend struct detail::Access;
  explicit Lens(const detail::Shared<detail::LensParts>& parts) noexcept : parts_(parts) {}

  detail::Shared<detail::LensParts> parts_;
};

// Each throws a CameraError naming "distortion.k.0" (1, ...), "distortion.p.0" (1), "distortion.xi" (alpha, beta,
// omega) or "distortion.limit" if a number is not finite or out of range.

/// largestRadius: the largest hypot(X / Z, Y / Z) that the calibration covered.
Lens brownLens(const std::array<double, 6>& k, const std::array<double, 2>& p = {},
               double largestRadius = kInfiniteFar);

/// A lens whose k are all zero still distorts. largestDegrees: the largest angle that the calibration covered.
Lens fisheyeLens(const std::array<double, 4>& k, double largestDegrees = kInfiniteFar);

/// beta > 0.
Lens unifiedLens(double alpha, double beta = 1);

/// xi > -1.
Lens doubleSphereLens(double xi, double alpha);
Lens omniLens(double xi, const std::array<double, 6>& k = {}, const std::array<double, 2>& p = {});

/// omega in radians, between 0 and pi.
Lens fovLens(double omega);

/// The same lens, which ends at this angle too if it does not end before. 180 degrees or more change nothing.
Lens limitedTo(const Lens& lens, double degrees);

/// The pinhole's projection for a calibration's, which has the focal lengths of the lens's formula: the same window,
/// seen by a pinhole that agrees with the lens on the axis. A perspective. The same for brown, fisheye and unified.
Projection calibrated(const Projection& projection, const Lens& lens);

/// Where the lens puts a direction, times that pinhole's focal lengths: (pixel - principal point) / its focal length,
/// the formulas above divided by their slope on the axis. Each the nearest double or its neighbour. NaN if the lens
/// does not see it, and for NaN.
Vec2 distorted(const Lens& lens, const Vec3& direction) noexcept;

/// The direction that the lens puts there, of unit length, within 2^-53 + 2^-56 radians. NaN if there is none. It is
/// proven to exist and to be the only one that the lens sees.
Vec3 undistorted(const Lens& lens, const Vec2& distorted) noexcept;

// ---- Cameras with a lens
//
// The lens applies to points and pixels: worldToScreen, screenToRay, screenToWorld, and their bounds. A point that the
// lens does not see has no pixel: its status is beyondLens in front of the eye plane, behind on or behind it. A point
// that it sees may lie behind the eye plane: it has a pixel, a viewDistance that is not above 0, and no depth. It is
// beyond the near plane if the camera has one; leave near out for a lens that looks past 90 degrees. A pixel without a
// direction has no ray: NaN. Depth, viewDistance, matrices, planes and Projection are the pinhole's. viewFrustum
// refuses such a camera because straight edges are bent; viewFrustum(withoutLens(camera)) is the pinhole's.

/// Replaces the camera's lens. The camera is the pinhole that agrees with the lens on the axis. Throws CameraError
/// naming "distortion" for an orthographic camera. A lens that distorts nothing, of zeros and without a limit, gives
/// the pinhole camera.
Camera withLens(const Camera& camera, const Lens& lens);
Camera withoutLens(const Camera& camera) noexcept;
std::optional<Lens> lensOf(const Camera& camera) noexcept;

/// The largest shift in pixels that the lens causes, over 17 x 17 positions of the picture with its corners: the
/// distance from a pixel that has a ray in front of the camera to the same ray's pixel without the lens; and how many
/// of these 289 positions have a ray that is not in front. 0 without a lens.
struct LensShift {
  double largest = 0;
  int behind = 0;
};
LensShift lensShift(const Camera& camera) noexcept;

}  // namespace viewproj
