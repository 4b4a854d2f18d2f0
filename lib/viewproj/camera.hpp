// A camera: where it stands, what part of space it sees, the pixels of its picture, and the convention of its numbers.
//
// Pose, Projection and Camera are made whole or not at all, and cannot be changed afterwards: any number of threads may
// use and copy one at the same time. A copy shares its numbers.
//
// Every promise of this library rests on IEEE arithmetic: a thread that calls it rounds to the nearest, ties to even,
// and keeps subnormal numbers: no other fesetround, no flush-to-zero, no denormals-are-zero (which -ffast-math turns on
// in whatever is linked with it, for all of the program). makeCamera looks for it; what is called later does not.
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "viewproj/convention.hpp"
#include "viewproj/vectors.hpp"

namespace viewproj {

namespace detail {
struct Access;
struct PoseParts;
struct ProjectionParts;
struct CameraParts;
}  // namespace detail

/// Each number of a camera but its angles is 0 or between these in magnitude (the Planck length and the observable
/// universe lie well inside), and so are its window's width and height; far may also be infinite. Others are refused.
inline constexpr double kSmallestNumber = 1e-90, kLargestNumber = 1e90;

/// Thrown while a camera is described, never while points are projected.
class CameraError : public std::invalid_argument {
 public:
  /// field: the parameter at fault, named as in a camera file ("up", "far", "viewport.width", ...).
  CameraError(std::string field, const std::string& message)
      : std::invalid_argument(field + ": " + message), field_(std::move(field)), message_(message) {}

  const std::string& field() const noexcept { return field_; }
  const std::string& message() const noexcept { return message_; }

 private:
  std::string field_, message_;
};

// ---- Pose

/// x, y, z, w; need not be of unit length.
struct Quaternion {
  double x = 0, y = 0, z = 0, w = 1;
};

/// Where a camera stands and how it is turned. Held to more digits than doubles have.
class Pose {
 public:
  Pose(const Pose&) noexcept = default;
  Pose& operator=(const Pose&) noexcept = default;

  /// World coordinates. Of a view matrix the double nearest its eye.
  Vec3 eye() const noexcept;
  /// The camera's axes in the world, rounded: unit vectors, at right angles as far as kPoseOrthogonality allows.
  Vec3 right() const noexcept;
  Vec3 up() const noexcept;
  Vec3 forward() const noexcept;
  /// The handedness of the world that the axes fit.
  Handedness world() const noexcept;

 private:
  friend struct detail::Access;
  explicit Pose(std::shared_ptr<const detail::PoseParts> parts) noexcept : parts_(std::move(parts)) {}

  std::shared_ptr<const detail::PoseParts> parts_;
};

/// How far a pose matrix's 3x3 may be from orthogonal: the largest entry of M^T M - I.
inline constexpr double kPoseOrthogonality = 1e-3;

// Each of these throws CameraError naming the parameter that is not finite, zero or degenerate. Degeneracy is decided
// exactly, without an epsilon: a direction that differs from up by the last bit gives a valid camera. The axes come out
// within 2^-100 of the true ones, whatever the magnitudes.

/// Looks along direction, with up upwards in the picture. The sign of the right axis follows the world's handedness:
/// direction x up in a right-handed world, up x direction in a left-handed one.
Pose lookAlong(const Vec3& position, const Vec3& direction, const Vec3& up, Handedness world);

/// Looks at target; the difference target - position is exact.
Pose lookAt(const Vec3& position, const Vec3& target, const Vec3& up, Handedness world);

/// A rotation from the camera's axes to the world. Throws if axes has not the world's handedness.
Pose poseFromRotation(const Vec3& position, const Quaternion& worldFromCamera, CameraAxes axes, Handedness world);

/// A matrix from the camera's axes to the world, column vectors, last row 0 0 0 1. Used as given and inverted exactly.
Pose poseFromWorldFromCamera(const Mat4& worldFromCamera, CameraAxes axes, Handedness world);

/// The inverse of the above: a view matrix.
Pose poseFromCameraFromWorld(const Mat4& cameraFromWorld, CameraAxes axes, Handedness world);

/// From the camera's axes along the world's by three turns in degrees, each about an axis (0, 1, 2 for x, y, z) of the
/// camera as the turns before left it: about x from y towards z, and so on. Quarter turns are exact. Throws naming
/// "euler" where an axis or an angle is no such number, "rotation" if axes has not the world's handedness.
struct Turn {
  int axis = 0;
  double degrees = 0;
};
Pose poseFromTurns(const Vec3& position, const std::array<Turn, 3>& turns, CameraAxes axes, Handedness world);

/// The camera's x, y, z axes in the world and its eye where they come of arithmetic with more digits than doubles have.
/// Names "columns" and "position" where they are wrong. The inverse of the columns counts as exact from there on.
Pose poseFromColumns(const std::array<SplitVec3, 3>& columns, const SplitVec3& eye, CameraAxes axes, Handedness world);

/// The same axes at another eye. Throws naming "position" where it is not finite.
Pose movedTo(const Pose& pose, const Vec3& eye);

// ---- Viewport

/// The corner that screen y is counted from: downwards from the top left, upwards from the bottom left.
enum class Origin { topLeft, bottomLeft };

/// The rectangle of pixels a picture fills. Pixel values are positions: the centre of pixel (i, j) is
/// (i + pixelCenter, j + pixelCenter).
struct Viewport {
  double width = 0, height = 0;            ///< pixels, > 0
  double x = 0, y = 0;                     ///< where the corner of the picture lies on the screen
  double depthFirst = 0, depthSecond = 1;  ///< window depth of near and far; exchanged by reverseZ
  Origin origin = Origin::topLeft;
  double pixelCenter = 0.5;
};

/// A tile of a viewport's picture, in pixels from the picture's corner.
struct Crop {
  double x = 0, y = 0, width = 0, height = 0;
};

/// How many of its widths (heights) a viewport's corner, and its pixels' centre, may lie away from 0.
inline constexpr double kLargestCorner = 0x1p40;

/// The tile as a viewport of its own, whose corner lies where the whole picture's did.
Viewport cropped(const Viewport& viewport, const Crop& crop);

/// Screen positions of the picture's edges: of the corner that x and y are counted from, and of the one across.
struct PictureCorners {
  Vec2 first, last;
};
PictureCorners pictureCorners(const Viewport& viewport) noexcept;

// ---- Projection

/// What an angle of view spans: the picture's height, its width, or from corner to corner.
enum class Fov { vertical, horizontal, diagonal };

/// What part of space a camera sees: four window edges, near and far.
class Projection {
 public:
  Projection(const Projection&) noexcept = default;
  Projection& operator=(const Projection&) noexcept = default;

  bool isOrthographic() const noexcept;
  /// Edges are distances along the right and the up axis: in perspective on the plane at distance 1 from the eye
  /// (tangents), in orthographic anywhere. Rounded.
  double left() const noexcept;
  double right() const noexcept;
  double bottom() const noexcept;
  double top() const noexcept;
  /// Distances along the viewing axis. In perspective zNear may be 0, for no near plane, and zFar infinite.
  double zNear() const noexcept;
  double zFar() const noexcept;
  /// Width / height of the window, rounded.
  double aspect() const noexcept;
  /// In degrees, within an ulp for edges up to 1e150; of the two diagonals the wider one. NaN in orthographic.
  double fov(Fov of) const noexcept;

 private:
  friend struct detail::Access;
  explicit Projection(std::shared_ptr<const detail::ProjectionParts> parts) noexcept : parts_(std::move(parts)) {}

  std::shared_ptr<const detail::ProjectionParts> parts_;
};

inline constexpr double kInfiniteFar = std::numeric_limits<double>::infinity();

// Each function throws CameraError naming the parameter at fault. Perspective needs 0 <= zNear < zFar <= infinity,
// orthographic finite zNear < zFar. Edges come out within 2^-98 of the true ones, relative to the wider of the two.
// A perspective with zNear 0 has no near plane, and so no depth: its points have a pixel and a distance, and depth NaN.

/// A number alone is degrees. Nothing is rounded from one unit to the other.
struct Angle {
  constexpr Angle(double degrees) noexcept : value(degrees) {}  // NOLINT(google-explicit-constructor)
  static constexpr Angle radians(double radians) noexcept {
    Angle angle(radians);
    angle.isRadians = true;
    return angle;
  }

  double value;
  bool isRadians = false;
};

/// Width / height of a picture: the exact ratio, which 1920 / 1080 as a double is not.
struct Aspect {
  constexpr Aspect(double ratio) noexcept : width(ratio) {}  // NOLINT(google-explicit-constructor)
  constexpr Aspect(double pictureWidth, double pictureHeight) noexcept : width(pictureWidth), height(pictureHeight) {}
  // NOLINTNEXTLINE(google-explicit-constructor)
  constexpr Aspect(const Viewport& viewport) noexcept : width(viewport.width), height(viewport.height) {}

  double width, height = 1;
};

/// angle: the full one, above 0 and below 180 degrees. Names "fovY", "fovX" or "fovDiagonal" where it is not.
Projection perspective(Angle angle, Aspect aspect, double zNear, double zFar = kInfiniteFar, Fov of = Fov::vertical);

/// The window's width and height on the near plane (XMMatrixPerspectiveLH), with zNear above 0.
Projection perspectiveNearSize(double nearWidth, double nearHeight, double zNear, double zFar);

/// focalLength and the sensor's sides in one unit; a sensor side of 0 follows from the other and aspect.
Projection perspectiveFocalLength(double focalLength, double sensorWidth, double sensorHeight, Aspect aspect,
                                  double zNear, double zFar);

/// Edges on the near plane (glFrustum), with zNear above 0.
Projection frustum(double left, double right, double bottom, double top, double zNear, double zFar);

/// Edges on the plane at distance 1 from the eye: tangents.
Projection perspectiveWindow(double left, double right, double bottom, double top, double zNear, double zFar);

/// Edges anywhere along the view (glOrtho); zNear may be negative.
Projection orthographic(double left, double right, double bottom, double top, double zNear, double zFar);

/// Around the viewing axis, of this height or width; the other side follows from aspect.
Projection orthographicHeight(double height, Aspect aspect, double zNear, double zFar);
Projection orthographicWidth(double width, Aspect aspect, double zNear, double zFar);

/// Focal lengths and principal point in pixels of the viewport, as its origin and pixelCenter count them.
Projection intrinsics(double fx, double fy, double cx, double cy, const Viewport& viewport, double zNear, double zFar);

/// The picture moved right by dx and up by dy half-widths and half-heights (lens shift, jitter).
Projection shifted(const Projection& projection, double dx, double dy);

/// The window of a tile of the viewport's picture; its viewport is cropped(viewport, crop).
Projection cropped(const Projection& projection, const Viewport& viewport, const Crop& crop);

// ---- Camera

/// Pixels for a unit of the window, both above 0, and where the viewing axis meets the screen, as the viewport counts.
/// Each is rounded once; of a perspective, intrinsics(...) makes the projection again but for that rounding.
struct Intrinsics {
  double fx = 0, fy = 0, cx = 0, cy = 0;
};

/// Window depths, reverseZ taken into account: atInfinity, which orthographic has not, is the limit along the view.
/// What does not exist is NaN, all of it without a near plane.
struct WindowDepths {
  double atNear, atFar, atInfinity;
};

class Camera {
 public:
  Camera(const Camera&) noexcept = default;
  Camera& operator=(const Camera&) noexcept = default;

  Pose pose() const noexcept;
  Projection projection() const noexcept;
  const Viewport& viewport() const noexcept;
  const Convention& convention() const noexcept;

  Intrinsics intrinsics() const noexcept;
  WindowDepths depths() const noexcept;

 private:
  friend struct detail::Access;
  explicit Camera(std::shared_ptr<const detail::CameraParts> parts) noexcept : parts_(std::move(parts)) {}

  std::shared_ptr<const detail::CameraParts> parts_;
};

/// Throws CameraError where a number of the viewport is out of range, where the pose is not of the convention's
/// handedness, where window and viewport leave no doubles to tell pixels apart, and where this thread's arithmetic is
/// not IEEE's. Takes a few microseconds: build once, use for every point.
Camera makeCamera(const Pose& pose, const Projection& projection, const Viewport& viewport,
                  const Convention& convention = {});

/// The camera of a tile of the picture: window and viewport together.
Camera cropped(const Camera& camera, const Crop& crop);

}  // namespace viewproj
