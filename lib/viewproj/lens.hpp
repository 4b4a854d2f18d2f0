// Lens distortion, between the picture of an ideal pinhole camera and the pixels.
//
// Tangents are coordinates on the plane at distance 1 from the eye, x right and y down, as in OpenCV. Before the lens
// they are the pinhole's x = X / Z and y = Y / Z; after it they are (pixel - principal point) / focal length.
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

/// Why a lens maps only a part of the view.
enum class LimitCause {
  none,    ///< it maps every point in front
  fold,    ///< two points would have the same pixel
  pole,    ///< a denominator reaches 0
  stated,  ///< the calibration states a limit
};

/// Made by the functions below. A copy shares its numbers.
class Lens {
 public:
  Lens(const Lens&) noexcept = default;
  Lens& operator=(const Lens&) noexcept = default;

  LensModel model() const noexcept;
  /// k1 ... k6; for a fisheye k1 ... k4.
  const std::array<double, 6>& k() const noexcept;
  /// p1, p2; 0 for a fisheye.
  const std::array<double, 2>& p() const noexcept;
  /// Points at this angle off the axis or more have no pixel. Below it, no two points share a pixel: this is proven,
  /// with the tangential terms, so the true limit is this angle or slightly more. A fisheye's may be above 90 degrees,
  /// though only points in front of the camera are seen. Infinite if there is no limit.
  double limitDegrees() const noexcept;
  LimitCause limitCause() const noexcept;

 private:
  friend struct detail::Access;
  explicit Lens(std::shared_ptr<const detail::LensParts> parts) noexcept : parts_(std::move(parts)) {}

  std::shared_ptr<const detail::LensParts> parts_;
};

// Each throws a CameraError naming "distortion.k.0" (1, ...), "distortion.p.0" (1) or "distortion.limit" if a number is
// not finite or out of range.

/// With u = x^2 + y^2 and g = (1 + k1 u + k2 u^2 + k3 u^3) / (1 + k4 u + k5 u^2 + k6 u^3):
///   x g + 2 p1 x y + p2 (u + 2 x^2),  y g + p1 (u + 2 y^2) + 2 p2 x y
/// largestRadius: the largest hypot(x, y) that the calibration covered.
Lens brownLens(const std::array<double, 6>& k, const std::array<double, 2>& p = {},
               double largestRadius = kInfiniteFar);

/// With t the angle off the axis: a point keeps its direction from the axis in the picture, and its distance becomes
///   t (1 + k1 t^2 + k2 t^4 + k3 t^6 + k4 t^8).
/// A lens whose k are all zero still distorts.
Lens fisheyeLens(const std::array<double, 4>& k, double largestDegrees = kInfiniteFar);

/// Where the lens puts these tangents, in double. NaN at the limit and beyond, for tangents beyond 2^60, and for NaN.
Vec2 distorted(const Lens& lens, const Vec2& tangents) noexcept;

/// The tangents that the lens puts there, each the nearest double or its neighbour. NaN if there are none. The solution
/// is proven to exist and to be the only one in front of the camera.
Vec2 undistorted(const Lens& lens, const Vec2& distorted) noexcept;

// ---- Cameras with a lens
//
// The lens applies to points and pixels: worldToScreen, screenToRay, screenToWorld, and their bounds. A point at the
// limit or beyond has no pixel (PointStatus::beyondLens). A pixel without a point has no ray: its direction is NaN.
// Depth, viewDistance, matrices, planes and Projection are the pinhole's. viewFrustum refuses such a camera because
// straight edges are bent; viewFrustum(withoutLens(camera)) is the pinhole's.

/// Replaces the camera's lens. Throws CameraError naming "distortion" for an orthographic camera. A brown lens of zeros
/// without a limit gives the pinhole camera.
Camera withLens(const Camera& camera, const Lens& lens);
Camera withoutLens(const Camera& camera) noexcept;
std::optional<Lens> lensOf(const Camera& camera) noexcept;

/// The largest shift in pixels that the lens causes, over 17 x 17 positions of the picture with its corners: the
/// distance from a pixel that has a ray to the same ray's pixel without the lens. 0 without a lens.
double largestShift(const Camera& camera) noexcept;

}  // namespace viewproj
