// The sheet a view is drawn on: where its pixels lie, and the frame, grid and axes around them.
#pragma once

#include <string>

#include "output/svg.hpp"
#include "viewproj/camera.hpp"
#include "viewproj/vectors.hpp"

namespace viewproj::cmd {

struct Sheet {
  Viewport viewport;
  svg::Box frame;
  bool stretched = false;  ///< pixels are not drawn square

  /// From screen positions to the sheet.
  Vec2 operator()(const Vec2& screen) const;
  Vec2 middle() const { return {(frame.left + frame.right) / 2, (frame.top + frame.bottom) / 2}; }
};

/// A view more than this many times longer than it is wide is drawn so.
inline constexpr double kLongestSheet = 10;

/// top: where the sheet begins, below what stands above it.
Sheet makeSheet(const Viewport& viewport, double top);

/// Grid lines at round pixels, with their numbers along the two sides that meet in the origin.
std::string gridOf(const Sheet& sheet);

/// Where the sheet ends, its numbers included.
double bottomOf(const Sheet& sheet);

}  // namespace viewproj::cmd
