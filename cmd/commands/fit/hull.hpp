// What of many things matters to a camera that shall show them all, in room that does not grow with their number.
#pragma once

#include "camera/camera.hpp"
#include "numbers/wide.hpp"
#include "viewproj/scene.hpp"

namespace viewproj::cmd {

/// Shares of the picture, from its left and its lower side, that things are to lie between.
struct Room {
  double left = 0, right = 1, bottom = 0, top = 1;
};

/// What of a perspective's direction and room the things push against: planes through the eye, each moved outwards as
/// far as they reach. The camera may move, and the planes with it.
///
/// With X, Y, W along right, up and forward from the eye, r and l the window's edges of the room, and the camera moved
/// by x and z along right and forward, all is in front of the right and the left plane where
///   R = max(X - r W) <= x - r z   and   L = max(l W - X) <= l z - x,
/// so that z <= -(R + L) / (r - l) is all there is to it, and x may be anything between the two. Of a sphere the
/// maximum is that of its middle and its radius times the length of right - r forward. In orthographic r and l are 0,
/// and R and L how far the things reach to either side.
class Hull {
 public:
  Hull(const Camera& camera, const Room& room);

  void add(const Vec3& point) { add(point, 0); }
  void add(const Sphere& sphere) { add(sphere.center, sphere.radius); }
  void add(const Box& box);
  void add(const Triangle& triangle);

  bool isEmpty() const { return isEmpty_; }

  /// Of the things, along the view.
  struct Range {
    double nearest, farthest;
  };
  /// From where the camera is.
  Range range() const { return {double(nearest_), double(farthest_)}; }

  struct Place {
    Vec3 eye;
    Range range;                               ///< from there
    enum class By { width, height, near } by;  ///< what keeps it from going on
  };
  /// Nearest along the view, and in the middle of what is left across it. Where the things fit from as near as one
  /// likes, up to a point that is one of them, the nearest of them comes to lie on near. All is within the room of the
  /// camera with this eye of doubles, its axes turned by as much as `turn` radians.
  Place place(double turn = 0) const;

  /// Orthographic: how far the things reach.
  struct Reach {
    detail::DoubleDouble left, right, bottom, top;
  };
  Reach reach() const;

 private:
  void add(const Vec3& middle, double radius);

  /// A plane's push: the most of along - edge W, or with the signs changed.
  struct Push {
    const detail::DDVec3* row;
    detail::DoubleDouble residual;
    detail::DoubleDouble edge;
    bool upwards;         ///< along - edge W, and not the other way round
    detail::Wide length;  ///< of row - edge forward
    detail::Wide most = {};
  };

  const detail::CameraParts* camera_;
  Camera owner_;
  Push right_, left_, top_, bottom_;
  detail::Wide forwardLength_, nearest_, farthest_;
  bool isEmpty_ = true;
};

}  // namespace viewproj::cmd
