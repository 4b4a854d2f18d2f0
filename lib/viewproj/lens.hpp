// The lens: distortion, which bends the straight edges of a picture, between the pinhole's picture and the pixels.
//
// Tangents here are coordinates on the plane at distance 1 from the eye, x right and y down, as OpenCV has them: the
// pinhole's x = X / Z and y = Y / Z before the lens, (pixel - principal point) / focal length after it.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <utility>

#include "viewproj/camera.hpp"

namespace viewproj {

namespace detail {
struct LensParts;
}

enum class LensModel {
  brown,    ///< Brown-Conrady, rational
  fisheye,  ///< Kannala-Brandt, "equidistant"
};

/// What ends the part of the view that a lens maps.
enum class LimitCause {
  none,    ///< nothing: every point in front has a pixel
  fold,    ///< two points would have the same pixel
  pole,    ///< a denominator reaches 0
  stated,  ///< the calibration goes no further
};

/// Made whole by the functions below; a copy shares its numbers.
class Lens {
 public:
  Lens(const Lens&) noexcept = default;
  Lens& operator=(const Lens&) noexcept = default;

  LensModel model() const noexcept;
  /// k1 ... k6; of a fisheye k1 ... k4.
  const std::array<double, 6>& k() const noexcept;
  /// p1, p2; of a fisheye 0.
  const std::array<double, 2>& p() const noexcept;
  /// The angle off the axis from which on points have no pixel, below it no two points have the same one: proven, with
  /// the tangential terms, so that the true limit is this or a little more. Of a fisheye it may be beyond 90 degrees,
  /// though only what is in front of the camera is seen. Infinite where there is none.
  double limitDegrees() const noexcept;
  LimitCause limitCause() const noexcept;

 private:
  friend struct detail::Access;
  explicit Lens(std::shared_ptr<const detail::LensParts> parts) noexcept : parts_(std::move(parts)) {}

  std::shared_ptr<const detail::LensParts> parts_;
};

// Each throws CameraError naming "distortion.k.0" and so on, "distortion.p.0" or "distortion.limit" where a number is
// not finite or is out of a camera's range.

/// With u = x^2 + y^2 and g = (1 + k1 u + k2 u^2 + k3 u^3) / (1 + k4 u + k5 u^2 + k6 u^3):
///   x g + 2 p1 x y + p2 (u + 2 x^2),  y g + p1 (u + 2 y^2) + 2 p2 x y
/// largestRadius: how large hypot(x, y) was when the lens was calibrated.
Lens brownLens(const std::array<double, 6>& k, const std::array<double, 2>& p = {},
               double largestRadius = kInfiniteFar);

/// With t the angle off the axis: a point's direction from it in the picture stays, and its distance becomes
///   t (1 + k1 t^2 + k2 t^4 + k3 t^6 + k4 t^8).
/// All of k zero is a lens too.
Lens fisheyeLens(const std::array<double, 4>& k, double largestDegrees = kInfiniteFar);

/// Where the lens puts tangents, computed in double. NaN from the limit on, beyond 2^60, and for NaN.
Vec2 distorted(const Lens& lens, const Vec2& tangents) noexcept;

/// The tangents that the lens puts there, each the nearest double or one next to it; NaN where there are none. They are
/// certified: a solution is proven to be there, and to be the only one in front of the camera.
Vec2 undistorted(const Lens& lens, const Vec2& distorted) noexcept;

// ---- Cameras with a lens
//
// Points and pixels go through it: worldToScreen, screenToRay, screenToWorld, and the bounds of both. A point from the
// limit on has no pixel (PointStatus::beyondLens), and a pixel that no point has no ray: its direction is NaN. Depth,
// viewDistance, matrices, planes and what Projection tells are those of the pinhole. viewFrustum refuses such a camera,
// because straight edges are bent: viewFrustum(withoutLens(camera)) is the pinhole's.

/// In place of a lens it has. Throws CameraError naming "distortion" for orthographic cameras. A brown lens of zeros
/// without a limit leaves the pinhole.
Camera withLens(const Camera& camera, const Lens& lens);
Camera withoutLens(const Camera& camera) noexcept;
std::optional<Lens> lensOf(const Camera& camera) noexcept;

/// The largest distance in pixels, over 17 x 17 places of the picture with its corners, between a pixel that has a ray
/// and the same ray's pixel without the lens. 0 without a lens.
double largestShift(const Camera& camera) noexcept;

}  // namespace viewproj
