// A camera: its pose, the part of space it sees, the pixels of its picture, and the convention of its numbers.
//
// Pose, Projection and Camera are complete when constructed and cannot change afterwards. Any number of threads may use
// and copy one at the same time. A copy shares its numbers.
//
// The library's accuracy depends on IEEE arithmetic. A thread that calls it must round to nearest, ties to even, and
// keep subnormal numbers: no other fesetround mode, no flush-to-zero and no denormals-are-zero (-ffast-math in any
// linked file turns those on for the whole program). makeCamera checks this; later calls do not.
//
// Example:
//   const Viewport picture{.width = 640, .height = 480};
//   std::optional<Camera> camera;  // a Camera is complete, or there is none
//   try {
//     const Pose pose = lookAt({3, 2, 5}, {0, 0, 0}, {0, 1, 0}, Handedness::right);
//     camera = makeCamera(pose, perspective(60, picture, 0.1, 1000), picture);
//   } catch (const CameraError& error) {
//     std::printf("%s\n", error.what());
//   }
//   const Intrinsics k = camera->intrinsics();
//   std::printf("%.4f %g %g", k.fx, k.cx, k.cy);  // prints 415.6922 320 240
#pragma once

#include <array>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "viewproj/convention.hpp"
#include "viewproj/shared.hpp"
#include "viewproj/vectors.hpp"

namespace viewproj {

namespace detail {
struct Access;
struct PoseParts;
struct ProjectionParts;
struct CameraParts;
}  // namespace detail

/// Every number of a camera except angles is 0 or between these in magnitude, and so are the window's width and height.
/// far may also be infinite. A larger number is refused. So is a smaller one, but in a position, direction, rotation,
/// matrix or lens it counts as 0. The Planck length and the observable universe lie inside.
inline constexpr double kSmallestNumber = 1e-45, kLargestNumber = 1e45;

/// Thrown only while a camera is being described, never while points are projected.
class CameraError : public std::invalid_argument {
 public:
  /// field: the wrong parameter, named as in a camera file ("up", "far", "viewport.width", ...).
  CameraError(std::string field, const std::string& message)
      : std::invalid_argument(field + ": " + message), field_(std::move(field)), message_(message) {}

  const std::string& field() const noexcept { return field_; }
  const std::string& message() const noexcept { return message_; }

 private:
  std::string field_, message_;
};

// ---- Pose

/// A plain number is in degrees. Radians are used directly, without rounding to degrees.
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

/// x, y, z, w of a rotation; any length but 0.
struct Quaternion {
  double x = 0, y = 0, z = 0, w = 1;
  friend constexpr bool operator==(const Quaternion&, const Quaternion&) = default;
};

/// How far a camera may be from the true one: its eye in world units, its axes in radians. Bounds include it, and
/// numbers do not change.
struct PoseError {
  double eye = 0, angle = 0;
};

/// The position and orientation of a camera, kept to more digits than doubles have.
class Pose {
 public:
  Pose(const Pose&) noexcept = default;
  Pose& operator=(const Pose&) noexcept = default;

  /// Position in world coordinates. For a view matrix, the double nearest to its exact eye.
  Vec3 eye() const noexcept;
  /// The camera's axes in the world, rounded to unit vectors. They are at right angles within kPoseOrthogonality.
  Vec3 right() const noexcept;
  Vec3 up() const noexcept;
  Vec3 forward() const noexcept;
  /// The handedness of the world that these axes fit.
  Handedness world() const noexcept;
  PoseError error() const noexcept;

 private:
  friend struct detail::Access;
  explicit Pose(const detail::Shared<detail::PoseParts>& parts) noexcept : parts_(parts) {}

  detail::Shared<detail::PoseParts> parts_;
};

/// The largest entry of M^T M - I that is allowed for the 3x3 part M of a pose matrix.
inline constexpr double kPoseOrthogonality = 1e-3;

// Each of these functions throws a CameraError that names the parameter that is not finite, zero or degenerate.
// Degeneracy is decided exactly, without an epsilon: a direction that differs from up in the last bit gives a valid
// camera. The axes are within 2^-100 of the true ones, whatever the magnitudes. Where axes are given, they say which
// handedness the world has: RUB, RDF, FLU and FRD are right-handed, RUF and FRU left-handed, and a mirroring changes
// it.

/// Looks along direction, with up pointing up in the picture. The right axis is direction x up in a right-handed world
/// and up x direction in a left-handed one.
Pose lookAlong(const Vec3& position, const Vec3& direction, const Vec3& up, Handedness world);

/// Looks at target. The difference target - position is exact.
Pose lookAt(const Vec3& position, const Vec3& target, const Vec3& up, Handedness world);

/// A rotation from the camera's axes to the world.
Pose poseFromRotation(const Vec3& position, const Quaternion& worldFromCamera, CameraAxes axes);

/// A matrix from the camera's axes to the world, for column vectors, with last row 0 0 0 1. It is inverted exactly.
Pose poseFromWorldFromCamera(const Mat4& worldFromCamera, CameraAxes axes);

/// A view matrix: the inverse of the matrix above.
Pose poseFromCameraFromWorld(const Mat4& cameraFromWorld, CameraAxes axes);

/// Three turns, each about the camera's own axis (0, 1, 2 for x, y, z) as the turns before left it. The camera's axes
/// start along the world's. Positive turns go from y to z about x, and so on. Quarter turns in degrees are exact.
/// Throws naming "euler" if an axis is invalid or an angle is not finite or above 1e6 radians.
struct Turn {
  int axis = 0;
  Angle angle = 0;
};
Pose poseFromTurns(const Vec3& position, const std::array<Turn, 3>& turns, CameraAxes axes);

/// The camera's x, y, z axes and its eye in the world, from arithmetic with more digits than doubles have. Throws
/// naming "columns" or "position". The rounded inverse of the columns counts as exact afterwards.
Pose poseFromColumns(const std::array<SplitVec3, 3>& columns, const SplitVec3& eye, CameraAxes axes);

/// The same axes at another eye: bit for bit, whatever they were made from. With the eye at 0 0 0 it is the camera for
/// points that the eye was subtracted from, as float32 needs at planet scale. Throws naming "position" if the eye is
/// not finite or out of range.
Pose movedTo(const Pose& pose, const Vec3& eye);

/// The same pose, known only to this. A number that is not >= 0 counts as infinite.
Pose withError(const Pose& pose, const PoseError& error);

// ---- Viewport

/// The corner where screen y starts: y runs down from the top left, or up from the bottom left.
enum class Origin { topLeft, bottomLeft };

/// The rectangle of pixels that a picture fills. Pixel values are positions:
/// the centre of pixel (i, j) is (i + pixelCenter, j + pixelCenter).
struct Viewport {
  double width = 0, height = 0;            ///< pixels, > 0
  double x = 0, y = 0;                     ///< screen position of the picture's corner
  double depthFirst = 0, depthSecond = 1;  ///< window depth of near and far; reverseZ swaps them
  Origin origin = Origin::topLeft;
  double pixelCenter = 0.5;
  friend constexpr bool operator==(const Viewport&, const Viewport&) = default;
};

/// A picture of this size whose pixels have their centres where the preset has them: OpenCV's at whole numbers. The
/// preset's up and cameraAxes are for lookAt and for poses.
constexpr Viewport viewportOf(double width, double height, const ConventionPreset& preset) noexcept {
  Viewport viewport;
  viewport.width = width;
  viewport.height = height;
  viewport.pixelCenter = preset.pixelCenter;
  return viewport;
}

/// A tile of a viewport's picture, in pixels from the picture's corner.
struct Crop {
  double x = 0, y = 0, width = 0, height = 0;
  friend constexpr bool operator==(const Crop&, const Crop&) = default;
};

/// Largest distance from 0 of a viewport's corner and of its pixel centre, in widths (heights) of the viewport.
inline constexpr double kLargestCorner = 0x1p40;

/// The tile as a viewport of its own. Its corner is the corner of the whole picture.
Viewport cropped(const Viewport& viewport, const Crop& crop);

/// Screen positions of two opposite corners of the picture; x and y are counted from first.
struct PictureCorners {
  Vec2 first, last;
};
PictureCorners pictureCorners(const Viewport& viewport) noexcept;

// ---- Projection

/// The extent that an angle of view spans: the picture's height, its width or its diagonal.
enum class Fov { vertical, horizontal, diagonal };

/// The part of space that a camera sees: four window edges, near and far.
class Projection {
 public:
  Projection(const Projection&) noexcept = default;
  Projection& operator=(const Projection&) noexcept = default;

  bool isOrthographic() const noexcept;
  /// Edges are distances along the right and up axes, rounded. In perspective they lie on the plane at distance 1 from
  /// the eye (tangents); in orthographic they are the same at every distance.
  double left() const noexcept;
  double right() const noexcept;
  double bottom() const noexcept;
  double top() const noexcept;
  /// Distances along the viewing axis. In perspective zNear may be 0 (no near plane) and zFar may be infinite.
  double zNear() const noexcept;
  double zFar() const noexcept;
  /// Width / height of the window, rounded.
  double aspect() const noexcept;
  /// Angle of view in degrees, within an ulp for edges up to 1e150; the larger diagonal. NaN in orthographic.
  double fov(Fov of) const noexcept;

 private:
  friend struct detail::Access;
  explicit Projection(const detail::Shared<detail::ProjectionParts>& parts) noexcept : parts_(parts) {}

  detail::Shared<detail::ProjectionParts> parts_;
};

inline constexpr double kInfiniteFar = std::numeric_limits<double>::infinity();

// Each function throws a CameraError that names the wrong parameter. Perspective needs 0 <= zNear < zFar <= infinity,
// orthographic needs finite zNear < zFar. Edges are within 2^-98 of the true ones, relative to the larger of each pair.
// A perspective with zNear 0 has no near plane and no depth: points have a pixel and a distance, but depth NaN.

/// Width / height of a picture as an exact ratio. 1920 / 1080 as a double would be rounded.
struct Aspect {
  constexpr Aspect(double ratio) noexcept : width(ratio) {}  // NOLINT(google-explicit-constructor)
  constexpr Aspect(double pictureWidth, double pictureHeight) noexcept : width(pictureWidth), height(pictureHeight) {}
  // NOLINTNEXTLINE(google-explicit-constructor)
  constexpr Aspect(const Viewport& viewport) noexcept : width(viewport.width), height(viewport.height) {}

  double width, height = 1;
};

/// angle: the full angle, above 0 and below 180 degrees. Otherwise throws naming "fovY", "fovX" or "fovDiagonal".
Projection perspective(Angle angle, Aspect aspect, double zNear, double zFar = kInfiniteFar, Fov of = Fov::vertical);

/// The size of a sensor: width and height; or one of the three, the others 0, and the picture's aspect says the rest.
struct SensorSize {
  double width = 0, height = 0, diagonal = 0;
};

/// focalLength and sensor are in one unit: of a phone's 26 mm equivalent, 26 and a diagonal of 43.2666.
Projection perspectiveFocalLength(double focalLength, const SensorSize& sensor, Aspect aspect, double zNear,
                                  double zFar);

/// Edges on the near plane (glFrustum; XMMatrixPerspectiveLH has half its width and height). zNear must be above 0.
Projection frustum(double left, double right, double bottom, double top, double zNear, double zFar);

/// Edges on the plane at distance 1 from the eye: tangents.
Projection perspectiveWindow(double left, double right, double bottom, double top, double zNear, double zFar);

/// Edges at any distance (glOrtho). zNear may be negative.
Projection orthographic(double left, double right, double bottom, double top, double zNear, double zFar);

/// A window of this height or width, centred on the viewing axis. The other side is computed from aspect.
Projection orthographicHeight(double height, Aspect aspect, double zNear, double zFar);
Projection orthographicWidth(double width, Aspect aspect, double zNear, double zFar);

/// Focal lengths and principal point in pixels. The viewport's origin and pixelCenter apply to the principal point.
Projection intrinsics(double fx, double fy, double cx, double cy, const Viewport& viewport, double zNear, double zFar);

/// The same in pixels of a picture of another size that has the viewport's corners (a resized picture).
Projection intrinsics(double fx, double fy, double cx, double cy, const Vec2& size, const Viewport& viewport,
                      double zNear, double zFar);

/// x = cx + ax scrz X/Z and y = cy + ay scrz Y/Z, as ps2sdk's create_view_screen has it. Names "scrz", "ax" or "ay".
Projection ps2Intrinsics(double scrz, double ax, double ay, double cx, double cy, const Viewport& viewport,
                         double zNear, double zFar);

/// Moves the picture right by dx half-widths and up by dy half-heights (lens shift, jitter).
Projection shifted(const Projection& projection, double dx, double dy);

/// The window of a tile of the viewport's picture. The tile's viewport is cropped(viewport, crop).
Projection cropped(const Projection& projection, const Viewport& viewport, const Crop& crop);

// ---- Camera

/// fx, fy: pixels per unit of the window, above 0. cx, cy: the screen position of the viewing axis. Each is rounded
/// once. In perspective, intrinsics(...) makes the same projection from them, apart from that rounding.
struct Intrinsics {
  double fx = 0, fy = 0, cx = 0, cy = 0;
  friend constexpr bool operator==(const Intrinsics&, const Intrinsics&) = default;
};

/// Window depths, with reverseZ applied. atInfinity is the limit along the viewing axis, NaN in orthographic. All are
/// NaN without a near plane.
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
  explicit Camera(const detail::Shared<detail::CameraParts>& parts) noexcept : parts_(parts) {}

  detail::Shared<detail::CameraParts> parts_;
};

/// Throws CameraError if a number of the viewport is out of range, if the pose does not fit the convention's
/// handedness, or if this thread's arithmetic is not IEEE's. Takes a few microseconds: reuse the camera.
Camera makeCamera(const Pose& pose, const Projection& projection, const Viewport& viewport,
                  const Convention& convention = {});

/// The camera of a tile of the picture, with the tile's window and viewport.
Camera cropped(const Camera& camera, const Crop& crop);

/// The same camera elsewhere, its lens included. Throws CameraError naming "pose" if the pose is of a world of the
/// other handedness.
Camera withPose(const Camera& camera, const Pose& pose);

}  // namespace viewproj
