// The parts of a picture, each in a file of its own.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "picture/ground.hpp"
#include "picture/picture.hpp"
#include "picture/sheet.hpp"

namespace viewproj::cmd {

/// The order in which names choose their places.
enum Rank { rankPixel, rankPoint, rankSegment, rankShape, rankOutside };

struct Drawing {
  const View& view;
  Sheet& sheet;
  std::vector<Vec2> rim;                ///< the picture's corners; through a lens many places on its edge
  std::set<std::string> namesOfPoints;  ///< a shape of the same name is not named again
  std::vector<std::string> notes;       ///< lines of the legend

  /// What lies outside the picture.
  struct Outside {
    std::string name;
    Vec2 way;  ///< on the sheet, from its middle
    bool isBehind = false;
  };
  std::vector<Outside> outside = {};
  std::size_t moreOutside = 0;  ///< those without a name

  double radiusOfDots = 4.5;
  bool namesPoints = true;
};

// shapes.cpp

/// Boxes, triangles and spheres.
void drawShapes(Drawing& drawing);
void drawSegment(Drawing& drawing, const NamedSegment& segment);
void drawArea(Drawing& drawing, const NamedArea& area);

// grounds.cpp

/// What a ray shows of the ground, be it nearer than near or beyond far.
std::optional<Vec3> pointUnder(const View& view, const Ground& ground, const Vec2& at);
/// Of each plane and surface of the Earth a tint, the horizon and a grid; from the points, stems down to the first.
void drawGrounds(Drawing& drawing, const std::vector<NamedPoint>& withStems);

// marks.cpp

/// Dots of many points are smaller, and have no names if those would cover the picture.
void settleDots(Drawing& drawing, const std::vector<NamedPoint>& points);
void drawPoint(Drawing& drawing, const NamedPoint& point);
void drawPixel(Drawing& drawing, const Vec2& pixel);
/// An arrow from the pixel of each record to the computed one.
void drawPairs(Drawing& drawing, const std::vector<NamedPoint>& points);
void addOutside(Drawing& drawing, const std::string& name, const Vec4& point);
/// Triangles on the frame, each on its side.
void drawOutside(Drawing& drawing);

// legend.cpp

/// Ticks along the frame; below it the facts of the camera, the symbols that occur, and the notes.
void drawLegend(const Drawing& drawing);

/// The largest of 1, 2, 5 x 10^k that is not above this.
double roundedDown(double value);

}  // namespace viewproj::cmd
