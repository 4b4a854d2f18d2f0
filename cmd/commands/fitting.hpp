// A camera that shows all of many things, in memory that does not grow with their number.
#pragma once

#include <array>
#include <cmath>

#include "camera/read_camera.hpp"
#include "viewproj/scene.hpp"

namespace viewproj::cmd {

class Fitting {
 public:
  /// margin: the share of the picture that stays free on each side. isFree: an orthographic window need not have the
  /// picture's shape.
  Fitting(const CameraFile& camera, double margin, bool isFree = false);

  void add(const Sphere& sphere);
  void add(const Vec3& point) { add(Sphere{point, 0}); }
  void add(const Box& box);
  void add(const Triangle& triangle);

  /// The camera's document with its eye as far along the view as all things allow, near and the margin too, and in the
  /// middle of the room that is left across it. Throws InputError where something lies beyond far. The eye of an
  /// orthographic camera moves across the view alone, and its box is made to fit: but what options have typed.
  Document byPlace() const;
  /// The same with the eye as it is, and the window as narrow as all things allow: of a perspective about the viewing
  /// axis, of an orthographic camera around the things. Throws InputError for what is not between near and far.
  Document byWindow() const;

 private:
  struct Side {
    Vec3 normal;             ///< of a plane through the eye, inwards, of unit length
    double room = HUGE_VAL;  ///< how far the plane can move inwards until it touches something
  };

  void requireSomething() const;
  Document openedPerspective() const;
  Document box(bool movesEye) const;
  [[noreturn]] void failCut() const;

  /// Edges, in the window's units from the viewing axis.
  struct Window {
    double left, right, bottom, top;
  };
  /// Of the camera, without a share of it on each side.
  Window windowWithin(double margin) const;
  /// How far an edge of what is seen may be off, because screen boxes are rounded; share: of the window's size that is
  /// seen.
  double rounding(double share) const;

  CameraFile file_;
  Camera camera_;
  double margin_;
  bool isFree_;
  Camera open_;                ///< sees all in front of the eye, orthographic behind it too, near and far or not
  std::array<Side, 4> sides_;  ///< left, right, bottom, top, the margin taken off
  Side ahead_;                 ///< straight ahead
  double unit_ = 1;            ///< the camera's, along the view: 1 of a true rotation
  double nearest_ = HUGE_VAL, farthest_ = -HUGE_VAL;       ///< along the view, in the camera's unit
  Window seen_{HUGE_VAL, -HUGE_VAL, HUGE_VAL, -HUGE_VAL};  ///< of all things
};

}  // namespace viewproj::cmd
