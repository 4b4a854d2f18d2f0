// The ground as one eye sees it: a surface of the Earth, or a plane.
#pragma once

#include <memory>
#include <optional>

#include "viewproj/screen.hpp"

namespace viewproj::cmd {

/// A surface as one eye sees it. Places on it are longitude and latitude in degrees, or metres across a plane; azimuths
/// are radians.
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
    double elevation = 0;       ///< radians above the level plane at the eye
    double distance = 0;        ///< infinite where a plane goes on beyond
    const char* cut = nullptr;  ///< horizon or distance; null: a plane goes on beyond
  };
  /// The farthest point that can be seen at an azimuth, at most so far away. Nothing if there is none.
  virtual std::optional<Limit> farthest(double azimuth, double most) const = 0;
  virtual double azimuthOf(const Vec3& direction) const = 0;
  /// 1 if azimuths grow to the right along its horizon in a right-handed world, else -1.
  virtual double turning() const = 0;
  virtual Vec2 placeOf(const Vec3& point) const = 0;
  /// From one place to another, by the shorter way round the Earth.
  virtual Vec2 way(const Vec2& from, const Vec2& to) const = 0;
  /// Metres in a unit of each number of a place.
  virtual Vec2 scaleAt(const Vec2& place) const = 0;
  /// The area between a line of no matter which latitude and this place, for a unit of x.
  virtual double areaBelow(const Vec2& place) const = 0;
  /// Of a ring: sum: the integral of areaBelow along it; turn: of x.
  virtual double areaOf(double sum, double turn) const = 0;
};

/// The surface of a height above the Earth's ellipsoid. From below, the Earth hides a part of it. Throws InputError if
/// the eye is on it.
std::unique_ptr<Ground> groundOfHeight(double height, const Vec3& eye);
/// normal . p + offset = 0, both sides. Throws InputError if the eye is on it.
std::unique_ptr<Ground> groundOfPlane(const Vec3& normal, double offset, const Vec3& eye);

}  // namespace viewproj::cmd
