// The outline of what a picture shows of the ground.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

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
    const char* cut;  ///< horizon or distance; null: a plane goes on beyond
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

struct OutlineVertex {
  Vec3 point;
  Vec2 place;
  std::optional<Vec2> pixel;  ///< nothing on a cut
};

struct OutlineRing {
  std::vector<OutlineVertex> vertices;  ///< clockwise as the camera sees it
  double area = 0;
  bool isHole = false;
};

/// Metres between the middles of a pixel's left and right side, and of its upper and lower side.
using GroundSampling = std::optional<std::array<double, 2>>;

struct Outline {
  std::vector<OutlineRing> rings;
  std::vector<std::string> cut;
  double area = 0, error = 0;
  std::optional<Ground::Seen> center;
  GroundSampling gsd;
  std::array<GroundSampling, 4> cornerGsd;  ///< top left, top right, bottom right, bottom left
};

/// error: how far the boundary may be from the straight line on the map between two vertices; 0: a thousandth of the
/// outline's extent. Throws InputError where the picture reaches the horizon of a plane, and beyond a million vertices.
Outline outlineOf(const Camera& camera, const Ground& ground, double most, double error);

}  // namespace viewproj::cmd
