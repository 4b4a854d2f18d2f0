#include <algorithm>

#include "picture/drawing.hpp"
#include "picture/svg.hpp"

namespace viewproj::cmd {
namespace {

constexpr double kOfBelt = 0.5, kOfStem = 0.5, kOfGhost = 0.3;

/// Points of the pieces that are seen; of all if none is, which isHidden tells.
std::vector<Vec2> pointsOf(const std::vector<Piece>& pieces, bool& isHidden) {
  isHidden = std::all_of(pieces.begin(), pieces.end(), [](const Piece& piece) { return piece.isHidden; });
  std::vector<Vec2> points;
  for (const Piece& piece : pieces)
    if (piece.isHidden == isHidden) points.insert(points.end(), piece.line.begin(), piece.line.end());
  return points;
}

/// On the shape, where the middle and both ends of the name lie on what is seen of it; else beside it.
void nameShape(const Drawing& drawing, const SceneObject& shape, const std::vector<Piece>& pieces,
               const Vec3& middleOfShape) {
  constexpr int kPlaces = 11;
  const View& view = drawing.view;
  const std::string& name = shape.id;
  if (name.empty() || drawing.namesOfPoints.count(name) > 0) return;
  bool isHidden = false;
  Rect seen = boundsOf(pointsOf(pieces, isHidden));
  if (pieces.empty()) {
    if (view.shapeAt(view.middle()) != &shape) return drawing.markers.add(name, pointOf(middleOfShape));
    seen = view.frame();  // it is around the eye
  }
  Label label{name, kOfShape, rankShape};
  label.isFaint = !pieces.empty() && isHidden;
  const auto [width, height] = label.size();
  const Vec2 size{seen.right - seen.left, seen.bottom - seen.top};
  const Vec2 middle{seen.left + size.x / 2, seen.top + size.y / 2};
  const auto isOn = [&](double x, double y) { return view.shapeAt({x, y}) == &shape; };
  for (int i = 0; i < kPlaces && size.x > width / 2 && size.y > height / 2; ++i)
    for (int j = 0; j < kPlaces; ++j) {
      const double across = (i + 0.5) / kPlaces, down = (j + 0.5) / kPlaces;
      const double x = seen.left + across * size.x, y = seen.top + down * size.y;
      const int hits = isOn(x - width / 2, y) + isOn(x, y) + isOn(x + width / 2, y);
      if (hits > 1) label.addSpot(12 * (3 - hits) + 6 * std::hypot(across - 0.5, down - 0.5), {x, y});
    }
  label.addSpot(8, {middle.x, seen.top - height / 2 - 3});
  label.addSpot(9, {middle.x, seen.bottom + height / 2 + 3});
  label.addSpot(10, {seen.right + width / 2 + 5, middle.y});
  label.addSpot(10.5, {seen.left - width / 2 - 5, middle.y});
  label.addSpotsAround(middle, 6, 1);
  drawing.sheet.labels.add(std::move(label));
}

void drawBox(const Drawing& drawing, const SceneObject& shape, const Box& box) {
  std::vector<Piece> pieces;
  for (const int axis : {1, 2, 4})
    for (int i = 0; i < 8; ++i)
      if ((i & axis) == 0)
        for (Piece& piece : drawEdge(drawing, cornerOf(box, i), cornerOf(box, i | axis)))
          pieces.push_back(std::move(piece));
  nameShape(drawing, shape, pieces, pointAlong(box.min, box.max, 0.5));
}

void drawTriangle(const Drawing& drawing, const SceneObject& shape, const Triangle& t) {
  std::vector<Piece> pieces;
  for (const auto& [a, b] : {std::pair(t.a, t.b), {t.b, t.c}, {t.c, t.a}})
    for (Piece& piece : drawEdge(drawing, a, b, &shape)) pieces.push_back(std::move(piece));
  nameShape(drawing, shape, pieces, sum(sum(sum({}, 1 / 3.0, t.a), 1 / 3.0, t.b), 1 / 3.0, t.c));
}

/// Its outline, and the belt across the axis that is most upright.
void drawSphere(const Drawing& drawing, const SceneObject& shape, const Sphere& sphere) {
  const View& view = drawing.view;
  const auto outline = outlineOf(view, sphere);
  std::vector<Piece> pieces;
  if (outline) {
    pieces = piecesOf(view, *outline, outline->steps(view), {.except = &shape});
    drawing.sheet.addLines(pieces, "edge", 1);
    const Vec3 up = view.camera().pose().up();
    std::size_t axis = 0;
    for (std::size_t i = 1; i < 3; ++i)
      if (std::fabs(up[i]) > std::fabs(up[axis])) axis = i;
    Circle belt{sphere.center, {}, {}};
    belt.u[(axis + 1) % 3] = belt.v[(axis + 2) % 3] = sphere.radius;
    drawing.sheet.addLines(piecesOf(view, belt, belt.steps(view)), "belt", kOfBelt);
  }
  nameShape(drawing, shape, pieces, sphere.center);
}

}  // namespace

std::vector<Piece> drawEdge(const Drawing& drawing, const Vec3& a, const Vec3& b, const SceneObject* except) {
  Sheet& sheet = drawing.sheet;
  if (drawing.view.hasLens())
    for (const Piece& piece : piecesOf(drawing.view, a, b, {Extent::withoutLens, true, except})) {
      if (piece.isHidden) continue;
      sheet.add(Layer::lines, svg::path("ghost", svg::line(piece.line)));
      sheet.labels.addInk(piece.line, kOfGhost);
      sheet.explain(Symbol::ghost);
    }
  std::vector<Piece> pieces = piecesOf(drawing.view, a, b, {.except = except});
  sheet.addLines(pieces, "edge", 1);
  return pieces;
}

void drawShape(const Drawing& drawing, const SceneObject& shape) {
  if (const auto* box = std::get_if<Box>(&shape.shape)) return drawBox(drawing, shape, *box);
  if (const auto* triangle = std::get_if<Triangle>(&shape.shape)) return drawTriangle(drawing, shape, *triangle);
  if (const auto* sphere = std::get_if<Sphere>(&shape.shape)) return drawSphere(drawing, shape, *sphere);
  drawGround(drawing, shape);
}

void drawSegment(const Drawing& drawing, const NamedSegment& segment) {
  const std::vector<Piece> pieces = drawEdge(drawing, segment.a, segment.b);
  if (segment.name.empty()) return;
  if (pieces.empty()) return drawing.markers.add(segment.name, pointOf(pointAlong(segment.a, segment.b, 0.5)));
  // Beside its longest piece that is seen.
  const auto lengthOf = [](const Piece& piece) {
    double total = 0;
    for (std::size_t i = 1; i < piece.line.size(); ++i) total += distance(piece.line[i - 1], piece.line[i]);
    return total;
  };
  const Piece& longest = *std::max_element(pieces.begin(), pieces.end(), [&](const Piece& a, const Piece& b) {
    return a.isHidden != b.isHidden ? a.isHidden : lengthOf(a) < lengthOf(b);
  });
  const std::vector<Vec2>& line = longest.line;
  Label label{segment.name, kOfShape, rankSegment};
  label.isFaint = longest.isHidden;
  const auto [width, height] = label.size();
  const double total = lengthOf(longest);
  Vec2 at = line.front();
  double cost = 0;
  for (const double share : {0.5, 0.38, 0.62, 0.25, 0.75, 0.12, 0.88}) {
    double rest = share * total;
    std::size_t i = 1;
    for (; i + 1 < line.size() && rest > distance(line[i - 1], line[i]); ++i) rest -= distance(line[i - 1], line[i]);
    const Vec2 &a = line[i - 1], &b = line[line.size() > 1 ? i : 0];
    const double size = distance(a, b);
    at = size > 0 ? between(a, b, rest / size) : a;
    const Vec2 normal = size > 0 ? Vec2{(a.y - b.y) / size, (b.x - a.x) / size} : Vec2{0, 1};
    const double gap = std::fabs(normal.x) * width / 2 + std::fabs(normal.y) * height / 2 + 3;
    const double above = normal.y > 0 ? -gap : gap;
    label.addSpot(cost, {at.x + above * normal.x, at.y + above * normal.y});
    label.addSpot(cost + 0.4, {at.x - above * normal.x, at.y - above * normal.y});
    cost += 0.7;
  }
  label.addSpotsAround(at, 6, 1);
  drawing.sheet.labels.add(std::move(label));
}

void drawStem(const Drawing& drawing, const SceneObject& ground, const NamedPoint& point) {
  const Vec4& p = point.point;
  if (p.w == 0 || !drawing.view.place(p)) return;
  const Vec3 top{p.x / p.w, p.y / p.w, p.z / p.w};
  drawing.sheet.addLines(piecesOf(drawing.view, top, groundPoint(ground, top)), "stem", kOfStem);
  drawing.sheet.explain(Symbol::stem);
}

void drawArea(const Drawing& drawing, const NamedArea& area) {
  bool isWhole = true;
  std::vector<Vec2> corners;
  for (std::size_t i = 0; i < area.corners.size(); ++i) {
    const auto edge = piecesOf(drawing.view, area.corners[i], area.corners[(i + 1) % area.corners.size()]);
    drawing.sheet.addLines(edge, "rim", 1);
    isWhole = isWhole && !edge.empty();
    for (const Piece& piece : edge) corners.insert(corners.end(), piece.line.begin(), piece.line.end());
  }
  if (corners.empty()) {
    if (!area.name.empty() && !area.corners.empty()) drawing.markers.add(area.name, pointOf(area.corners[0]));
    return;
  }
  drawing.sheet.addFilled(Layer::areas, "area", isWhole ? corners : hull(corners));
  drawing.sheet.explain(Symbol::area);
  if (area.name.empty() || drawing.namesOfPoints.count(area.name) > 0) return;
  const Rect seen = boundsOf(corners);
  const Vec2 middle{(seen.left + seen.right) / 2, (seen.top + seen.bottom) / 2};
  Label label{area.name, kOfShape, rankShape};
  label.addSpot(0, middle);
  label.addSpotsAround(middle, 6, 1);
  drawing.sheet.labels.add(std::move(label));
}

}  // namespace viewproj::cmd
