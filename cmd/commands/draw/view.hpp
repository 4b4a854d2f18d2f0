// What a picture is drawn of: points, outlines and rays as the camera sees them.
#pragma once

#include <string>
#include <vector>

#include "commands/draw/outline.hpp"
#include "viewproj/screen.hpp"

namespace viewproj::cmd {

/// Points, and outlines, that are drawn one by one; those after them are counted.
inline constexpr std::size_t kMostDrawn = 5000;
/// No outline is drawn after this many lines.
inline constexpr std::size_t kMostLines = 20000;

struct DrawnPoint {
  std::string label;
  ScreenPoint screen;
  /// Where it has no screen position: the way to it, right and up in the picture.
  Vec2 toward = {};
};

/// A pixel, and what its ray hits.
struct DrawnPixel {
  Vec2 screen;
  std::string label, detail;
};

struct View {
  Camera camera;
  std::vector<DrawnPoint> points = {};
  std::vector<Outline> outlines = {};
  std::vector<DrawnPixel> pixels = {};
  std::size_t pointsRead = 0, outlinesRead = 0, lines = 0;
  std::vector<std::string> notes = {};  ///< what the picture leaves out
};

void addPoint(View& view, std::string label, const Vec4& point);

/// shape: a Segment, Box, Triangle, Sphere or Ellipsoid.
template <class Shape>
void addOutline(View& view, const Frustum& frustum, std::string label, const Shape& shape) {
  ++view.outlinesRead;
  if (view.outlines.size() >= kMostDrawn || view.lines >= kMostLines) return;
  Outline outline = outlineOf(frustum, shape);
  outline.label = std::move(label);
  if (!outline.fault.empty()) view.notes.push_back(outline.label + ": " + outline.fault);
  view.lines += outline.pieces.size();
  view.outlines.push_back(std::move(outline));
}

}  // namespace viewproj::cmd
