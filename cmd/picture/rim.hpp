// The outer edge of a picture.
#pragma once

#include "viewproj/screen.hpp"

namespace viewproj::cmd {

/// Clockwise as one sees it. Where the lens ends before, the end of the lens on the way to the picture's centre.
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
  const Camera& camera_;
  Vec2 topLeft_, bottomRight_;
};

}  // namespace viewproj::cmd
