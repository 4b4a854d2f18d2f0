// What a camera sees of points and shapes, on the sheet.
#pragma once

#include <optional>
#include <vector>

#include "camera/plain_vectors.hpp"
#include "picture/flat.hpp"
#include "picture/sphere_tree.hpp"
#include "records/scene.hpp"
#include "viewproj/lens.hpp"

namespace viewproj::cmd {

inline Vec4 pointOf(const Vec3& a) { return {a.x, a.y, a.z, 1}; }
inline Vec4 directionOf(const Vec3& a) { return {a.x, a.y, a.z, 0}; }
/// Nothing of a direction.
inline std::optional<Vec3> positionOf(const Vec4& p) {
  return p.w == 0 ? std::nullopt : std::optional(Vec3{p.x / p.w, p.y / p.w, p.z / p.w});
}

/// Which points count as in the picture: those in view, those at any distance (nearer than near and beyond far as
/// well), or those that the pinhole camera has in view.
enum class Extent { view, anyDistance, withoutLens };

class View {
 public:
  /// ids of shapes: as the picture shows them. The longer side of the frame is 960.
  View(const Camera& camera, std::vector<SceneObject> shapes, bool worldIsEcef);

  const Camera& camera() const { return camera_; }
  const std::vector<SceneObject>& shapes() const { return shapes_; }
  bool worldIsEcef() const { return worldIsEcef_; }
  bool isParallel() const { return camera_.projection().isOrthographic(); }
  bool hasLens() const { return lensOf(camera_).has_value(); }
  Vec3 eye() const { return eye_; }
  /// From the eye to a point, or the direction of all rays.
  Vec3 wayTo(const Vec3& point) const { return isParallel() ? camera_.pose().forward() : sum(point, -1, eye_); }
  const Rect& frame() const { return frame_; }
  bool isFromTop() const { return camera_.viewport().origin == Origin::topLeft; }
  double scale() const { return scale_; }

  Vec2 onSheet(const Vec2& screen) const;
  Vec2 offSheet(const Vec2& at) const;
  /// Where a point is on the sheet, in the frame or not; nothing where it has no pixel.
  std::optional<Vec2> pixelOf(const Vec4& point) const;
  /// Where a point is on the sheet; nothing where it is not in the picture.
  std::optional<Vec2> place(const Vec4& point, Extent extent = Extent::view) const;

  /// From near on, where the camera has it.
  Ray rayAt(const Vec2& at) const;
  /// Whether a shape, or the Earth, lies in front of a point that is seen there. except: a shape that does not count.
  bool hides(const Vec3& point, const Vec2& at, const SceneObject* except = nullptr) const;
  /// The shape that is seen there.
  const SceneObject* shapeAt(const Vec2& at) const;
  /// Whether it is this one.
  bool isSeenAt(const Vec2& at, const SceneObject& shape) const;

  /// The largest angle between the viewing axis and what the picture shows, in radians.
  double reach() const { return reach_; }
  /// Planes of the view without its lens.
  const Frustum& frustum() const { return frustum_; }

 private:
  /// Where a ray first hits a shape; infinite where it does not.
  double distanceTo(std::size_t shape, const Ray& ray) const;

  Camera camera_, pinhole_;
  std::vector<SceneObject> shapes_;
  bool worldIsEcef_;
  Vec3 eye_;
  Vec2 first_;  ///< the screen position of the picture's corner
  double scale_, reach_;
  Rect frame_;
  Frustum frustum_;
  SphereTree tree_;  ///< of the shapes
};

/// The corners of a box, in the order of the bits of x, y and z, or of a triangle; none of other shapes.
std::vector<Vec3> cornersOf(const SceneObject& shape);
Vec3 middleOf(const std::vector<Vec3>& points);

/// A circle, or a part of it that holds all that the picture shows of it.
struct Circle {
  Vec3 middle, u, v;
  double turns = 0.5;  ///< so far to both sides of u
  double weight = 1;   ///< 0: of directions
  double stretch = 1;  ///< of z

  /// t from 0 to 1.
  Vec4 operator()(double t) const;
  /// So many that none is longer than a quarter of the picture.
  int steps(const View& view) const;
};

/// The circle in which rays from the eye touch a sphere. stretch: of the sphere's z about 0. Nothing if the eye is
/// within it.
std::optional<Circle> outlineOf(const View& view, const Sphere& sphere, double stretch = 1);
/// The directions along a plane: its horizon.
Circle horizonOf(const View& view, const Vec3& normal);

}  // namespace viewproj::cmd
