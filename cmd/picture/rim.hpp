// The outer edge of a picture.
#pragma once

#include <optional>

#include "viewproj/lens.hpp"
#include "viewproj/screen.hpp"

namespace viewproj::cmd {

/// Clockwise as one sees it. Where the lens ends before, the end of the lens on the way to its axis, or to what the
/// picture shows nearest to the axis.
class Rim {
 public:
  explicit Rim(const Camera& camera);

  struct Place {
    Vec2 pixel;
    Ray ray;
    bool isDrawnIn = false;  ///< to the end of the lens
  };
  /// s: from 0 to 4, whole at the corners, from the top left one on.
  Place at(double s) const;
  Vec2 center() const { return {(topLeft_.x + bottomRight_.x) / 2, (topLeft_.y + bottomRight_.y) / 2}; }
  /// A corner of the picture moved in by this many pixels, in x and in y.
  Vec2 corner(int which, double in = 0) const;

 private:
  /// On the lens's plane, y down.
  Vec2 cornerOnPlane(int which) const;
  /// The direction in which the lens ends, so far round its axis, in radians from right to down: right, down, forward.
  Vec3 lastDirection(double turn) const;
  /// Where the lens puts it.
  Vec2 endAt(double turn) const;
  /// The turn, between two others, at which the lens ends on the line from one place of its plane to another.
  double turnOnLine(const Vec2& from, const Vec2& to, double low, double high) const;
  /// On the line from the axis.
  double turnTowards(const Vec2& to) const;

  const Camera& camera_;
  Vec2 topLeft_, bottomRight_;
  std::optional<Lens> lens_;
  double sine_ = 0, cosine_ = 1;  ///< of the angle at which the lens ends
  Vec2 inmost_;                   ///< on the lens's plane: what the picture shows nearest to the axis
  double turnOfInmost_ = 0;
  bool isBlind_ = false;  ///< the lens ends before the picture begins
};

}  // namespace viewproj::cmd
