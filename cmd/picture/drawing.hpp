// The parts of a picture, each in a file of its own.
#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "picture/picture.hpp"
#include "picture/sheet.hpp"
#include "picture/view.hpp"

namespace viewproj::cmd {

/// The order in which names choose their places.
enum Rank { rankPixel, rankPoint, rankSegment, rankShape, rankOutside };

/// What lies outside the picture: triangles on the frame, each on its side.
class Markers {
 public:
  explicit Markers(const View& view) : view_(view) {}
  void add(const std::string& name, const Vec4& point);
  /// A place on the sheet, off the frame.
  void add(const std::string& name, const Vec2& at) {
    addTowards(name, {at.x - view_.middle().x, at.y - view_.middle().y}, false);
  }
  void draw(Sheet& sheet) const;

 private:
  struct Marker {
    std::string name;
    int side;   ///< 0 left, 1 right, 2 top, 3 bottom
    double at;  ///< along it
    bool isBehind;
  };
  void addTowards(const std::string& name, const Vec2& way, bool isBehind);

  const View& view_;
  std::vector<Marker> markers_;
};

struct Drawing {
  const View& view;
  Sheet& sheet;
  Markers& markers;
  std::set<std::string> namesOfPoints;  ///< a shape of the same name is not named again
  std::vector<Vec2> rim;                ///< of the picture: see rimOf
};

// shapes.cpp
void drawShape(const Drawing& drawing, const SceneObject& shape);
void drawSegment(const Drawing& drawing, const NamedSegment& segment);
void drawArea(const Drawing& drawing, const NamedArea& area);
/// From a point that is in the picture down to the ground.
void drawStem(const Drawing& drawing, const SceneObject& ground, const NamedPoint& point);
/// The pieces of an edge. Through a lens the edge is also drawn as it is without.
std::vector<Piece> drawEdge(const Drawing& drawing, const Vec3& a, const Vec3& b, const SceneObject* except = nullptr);

// faces.cpp
/// The picture's corners; through a lens many places on its edge, drawn in to the end of the lens.
std::vector<Vec2> rimOf(const View& view);
/// Of all shapes, far ones first.
void drawFaces(const Drawing& drawing);
/// Fills what a picture shows of something convex. outline: what it shows of its edge. meets: whether it is seen at a
/// place.
void fillConvex(const Drawing& drawing, Layer layer, const std::string& style, const std::vector<Piece>& outline,
                const std::function<bool(const Vec2&)>& meets);

// ground.cpp
/// Horizon and grid of a plane or of the Earth.
void drawGround(const Drawing& drawing, const SceneObject& ground);
/// The first plane or surface of the Earth.
const SceneObject* firstGround(const std::vector<SceneObject>& shapes);
/// The point of the ground below (or above) a point.
Vec3 groundPoint(const SceneObject& ground, const Vec3& point);

// marks.cpp
void drawPoint(const Drawing& drawing, const NamedPoint& point);
void drawPixel(const Drawing& drawing, const Vec2& pixel);
/// An arrow from the pixel of each record to the computed one.
void drawPairs(const Drawing& drawing, const std::vector<NamedPoint>& points);

// legend.cpp
/// Positions along the frame where x and y are counted from.
std::string ticksOf(const View& view);
std::vector<std::string> factsOf(const View& view);

/// The largest of 1, 2, 5 x 10^k that is not above this.
double roundedDown(double value);

}  // namespace viewproj::cmd
