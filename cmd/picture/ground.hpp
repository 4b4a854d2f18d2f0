// The ground as one eye sees it: a plane, or a surface of the Earth.
#pragma once

#include <memory>
#include <optional>

#include "picture/flat.hpp"
#include "records/scene.hpp"

namespace viewproj::cmd {

inline Hits hitsOf(const Ray& ray, const SceneObject& object) {
  return std::visit([&](const auto& shape) { return intersect(ray, shape); }, object.shape);
}

/// Azimuths and elevations are those of the eye, in radians. A place is two numbers: longitude and latitude in degrees,
/// or distances from the eye's foot along the plane.
class Ground {
 public:
  virtual ~Ground() = default;

  struct Seen {
    Vec3 point;
    double distance;  ///< from the ray's origin
  };
  /// What a ray shows of it.
  virtual std::optional<Seen> hit(const Ray& ray) const = 0;
  struct Limit {
    Vec3 point;
    double elevation = 0;
    double distance = 0;        ///< infinite where a plane goes on beyond
    const char* cut = nullptr;  ///< horizon or distance; null: a plane goes on beyond
  };
  /// The farthest point that can be seen at an azimuth, at most so far away. Nothing if there is none.
  virtual std::optional<Limit> farthest(double azimuth, double most) const = 0;

  virtual Vec2 placeOf(const Vec3& point) const = 0;
  virtual Vec3 pointAt(const Vec2& place) const = 0;
  /// The difference of two places, by the shorter way round the Earth.
  virtual Vec2 way(const Vec2& from, const Vec2& to) const { return sum(to, -1, from); }
  /// The length of a unit of each number of a place.
  virtual Vec2 scaleAt(const Vec2&) const { return {1, 1}; }
  /// The area between a line of no matter which latitude and this place, for a unit of x.
  virtual double areaBelow(const Vec2& place) const { return place.y; }
  /// Of a ring: sum: the integral of areaBelow along it; turn: of x.
  virtual double areaOf(double sum, double) const { return std::fabs(sum); }

  double rise = 0;        ///< of the eye above it; below 0 from below the Earth's
  bool holdsEye = false;  ///< nothing has a size there
  /// Level at the eye, and away from the ground: azimuths grow from ahead to aside.
  Vec3 aside, ahead, up;
  bool isOnEarth = false;
  double height = 0;                                      ///< of the Earth's surface
  Vec2 foot;                                              ///< the place below the eye
  Vec2 origin;                                            ///< whence round numbers are counted
  Rect extent{-HUGE_VAL, -HUGE_VAL, HUGE_VAL, HUGE_VAL};  ///< the numbers that a place can have

  double azimuthOf(const Vec3& direction) const;
  Vec3 direction(double azimuth, double elevation) const;
  /// 1 if azimuths grow to the right along its horizon in a right-handed world, else -1.
  double turning() const { return rise < 0 ? -1 : 1; }
};

/// A plane or a surface of the Earth.
bool isGround(const SceneObject& shape);
/// Nothing if the shape is none.
std::unique_ptr<const Ground> groundOf(const SceneObject& shape, const Vec3& eye);

}  // namespace viewproj::cmd
