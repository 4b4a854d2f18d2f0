// Shapes as edges and the faces between them; segments and outlines.
#include <algorithm>
#include <functional>

#include "numbers/vectors.hpp"
#include "picture/drawing.hpp"
#include "viewproj/geodesy.hpp"

namespace viewproj::cmd {
namespace {

using detail::dot;

constexpr double kOfBelt = 0.5, kOfGhost = 0.3;

struct Face {
  const SceneObject* shape;
  const char* style;
  std::vector<Vec3> corners;
  Pieces outline;
  BoxFace side = BoxFace::none;
  double away = 0;  ///< from the eye
};

void append(Pieces& all, const Pieces& more) { all.insert(all.end(), more.begin(), more.end()); }

/// Through a lens also as it is without.
Pieces drawEdge(const Drawing& drawing, const Vec3& a, const Vec3& b) {
  Sheet& sheet = drawing.sheet;
  if (drawing.view.hasLens())
    for (const Piece& piece : piecesOf(drawing.view, a, b, {Extent::withoutLens})) {
      if (piece.isHidden) continue;
      sheet.addLine(Layer::lines, "ghost", piece.line);
      sheet.labels.addInk(piece.line, kOfGhost);
      sheet.explain("without the lens");
    }
  Pieces pieces = piecesOf(drawing.view, a, b);
  sheet.addPieces(pieces, "edge", 1);
  return pieces;
}

/// The light comes from above, the right of the eye and behind it.
const char* toneOf(const View& view, Vec3 normal, const Vec3& way) {
  const Pose pose = view.camera().pose();
  if (dot(normal, way) > 0) normal = scaled(normal, -1);
  const Vec3 light = unit(sum(sum(pose.up(), -0.75, pose.right()), -0.35, pose.forward()));
  const double dark = 0.5 - 0.5 * dot(normal, light);
  return dark > 0.6 ? "f3" : dark > 0.3 ? "f2" : dark > 0.16 ? "f1" : "f0";
}

/// Draws the edges of a box or a triangle. Adds its faces.
Pieces drawEdges(const Drawing& drawing, const SceneObject& shape, std::vector<Face>& faces) {
  using Ring = std::vector<std::size_t>;
  static const std::vector<Ring> kOfBox{{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                        {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}},
      kOfTriangle{{0, 1, 2}};
  const View& view = drawing.view;
  const std::vector<Vec3> corners = cornersOf(shape);
  const auto* const box = std::get_if<Box>(&shape.shape);
  bool isAround = box && !view.isParallel();
  for (std::size_t k = 0; box && k < 3; ++k)
    isAround = isAround && box->min[k] < view.eye()[k] && view.eye()[k] < box->max[k];
  std::map<std::pair<std::size_t, std::size_t>, Pieces> edges;
  Pieces all;
  int side = 0;
  for (const Ring& ring : box ? kOfBox : kOfTriangle) {
    Face face{&shape, "", {}, {}, box ? static_cast<BoxFace>(++side) : BoxFace::none};
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const std::size_t from = ring[i], to = ring[(i + 1) % ring.size()];
      face.corners.push_back(corners[from]);
      auto known = edges.find({to, from});
      if (known == edges.end()) {
        Pieces pieces = drawEdge(drawing, corners[from], corners[to]);
        append(all, pieces);
        append(face.outline, pieces);
        edges[{from, to}] = std::move(pieces);
      } else {  // of the neighbour, who went the other way
        for (auto piece = known->second.rbegin(); piece != known->second.rend(); ++piece)
          face.outline.push_back({piece->isHidden, {piece->line.rbegin(), piece->line.rend()}});
      }
    }
    const Vec3 normal =
        detail::crossOf(sum(face.corners[1], -1, face.corners[0]), sum(face.corners[2], -1, face.corners[0]));
    if (!(length(normal) > 0)) continue;
    const Vec3 middle = middleOf(face.corners);
    face.style = toneOf(view, unit(normal), view.wayTo(middle));
    face.away = isAround ? HUGE_VAL : apart(middle, view.eye());
    faces.push_back(std::move(face));
  }
  return all;
}

/// Draws the outline, and the belt across the axis that is most upright. Adds its face.
Pieces drawSphere(const Drawing& drawing, const SceneObject& shape, const Sphere& sphere, std::vector<Face>& faces) {
  constexpr int kCorners = 12;
  const View& view = drawing.view;
  auto outline = outlineOf(view, sphere);
  if (!outline) return {};
  Face face{&shape, "f1", {}, piecesOf(view, *outline, outline->steps(view), {.except = &shape})};
  drawing.sheet.addPieces(face.outline, "edge", 1);
  const Vec3 up = view.camera().pose().up();
  std::size_t axis = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (std::fabs(up[i]) > std::fabs(up[axis])) axis = i;
  Circle belt{sphere.center, {}, {}};
  belt.u[(axis + 1) % 3] = belt.v[(axis + 2) % 3] = sphere.radius;
  drawing.sheet.addPieces(piecesOf(view, belt, belt.steps(view)), "belt", kOfBelt);
  outline->turns = 0.5;
  for (int i = 0; i < kCorners; ++i) face.corners.push_back(*positionOf((*outline)(i / double(kCorners))));
  face.away = apart(middleOf(face.corners), view.eye());
  faces.push_back(face);
  return face.outline;
}

/// Whether the face is behind a shape, its own too, as far as its middle and places near its corners show.
bool isHidden(const View& view, const Face& face) {
  constexpr double kNearCorner = 0.9;
  const bool isRound = std::holds_alternative<Sphere>(face.shape->shape);
  const Vec3 middle = middleOf(face.corners);
  bool isInView = false;
  const auto isSeen = [&](const Vec3& probe) {
    const auto at = view.place(pointOf(probe));
    isInView = isInView || at;
    return at && !view.hides(probe, *at, isRound ? face.shape : nullptr);
  };
  const bool isFree = isSeen(middle) || std::any_of(face.corners.begin(), face.corners.end(), [&](const Vec3& corner) {
                        return isSeen(pointAlong(middle, corner, kNearCorner));
                      });
  return isInView && !isFree;
}

/// The outline, if its pieces join from end to end.
Line loopOf(const Pieces& outline) {
  constexpr double kJoin = 1;
  const std::vector<Line> lines = joined(outline);
  return lines.size() == 1 && distance(lines[0].back(), lines[0].front()) <= kJoin ? lines[0] : Line();
}

/// What a picture shows of something convex is convex without a lens: the hull of the pieces of its edge and of those
/// places of the picture's rim that it is seen at. So no polygon is clipped, and nothing behind the eye is divided by.
Line convexOutline(const Drawing& drawing, const Face& face) {
  Line corners = pointsOf(face.outline);
  for (const Vec2& at : drawing.rim) {
    const Hits hits = hitsOf(drawing.view.rayAt(at), *face.shape);
    if (hits.count > 0 && hits.hits[0].face == face.side) corners.push_back(at);
  }
  return hull(std::move(corners));
}

/// Far ones first, and first of all what the eye is in.
void fillFaces(const Drawing& drawing, std::vector<Face>& faces) {
  const View& view = drawing.view;
  std::stable_sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) { return a.away > b.away; });
  for (const Face& face : faces) {
    if (isHidden(view, face)) continue;
    const Line loop = view.hasLens() ? loopOf(face.outline) : Line();
    drawing.sheet.addFilled(Layer::faces, face.style, {loop.empty() ? convexOutline(drawing, face) : loop});
  }
}

bool isNamed(const Drawing& drawing, const std::string& name) {
  return !name.empty() && drawing.namesOfPoints.count(name) == 0;
}

/// On the shape, where the middle and both ends of the name lie on what is seen of it; else beside it.
void nameShape(Drawing& drawing, const SceneObject& shape, const Pieces& pieces, const Vec3& middleOfShape) {
  constexpr int kPlaces = 11;
  const View& view = drawing.view;
  if (!isNamed(drawing, shape.id)) return;
  const bool isFaint =
      !pieces.empty() && std::all_of(pieces.begin(), pieces.end(), [](const Piece& piece) { return piece.isHidden; });
  Pieces shown = pieces;
  std::erase_if(shown, [&](const Piece& piece) { return piece.isHidden != isFaint; });
  const auto isOn = [&](double x, double y) { return view.isSeenAt({x, y}, shape); };
  const Vec2 center = middleOf(view.frame());
  if (pieces.empty() && !isOn(center.x, center.y)) return addOutside(drawing, shape.id, pointOf(middleOfShape));
  const Rect seen = pieces.empty() ? view.frame() : boundsOf(pointsOf(shown));  // it may be around the eye
  Label label{shape.id, kOfShape, rankShape, isFaint};
  const auto [width, height] = label.size();
  const Vec2 middle = middleOf(seen), size{seen.right - seen.left, seen.bottom - seen.top};
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

/// The plane of a ring, or the surface of its height.
SceneObject groundWith(const std::vector<Vec3>& ring, bool worldIsEcef) {
  if (worldIsEcef) return {"", HeightSurface{ecefToGeodetic(ring[0]).height}};
  Vec3 normal;
  for (std::size_t i = 2; i < ring.size(); ++i)
    normal = sum(normal, 1, detail::crossOf(sum(ring[i - 1], -1, ring[0]), sum(ring[i], -1, ring[0])));
  return {"", Plane{ring[0], length(normal) > 0 ? unit(normal) : Vec3{0, 0, 1}}};
}

/// Whether a place of the ground is within an odd number of rings.
bool isWithin(const std::vector<std::vector<Vec3>>& rings, const Vec3& point, const Ground& ground) {
  const Vec2 place = ground.placeOf(point);
  bool isIn = false;
  for (const std::vector<Vec3>& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2 a = ground.way(place, ground.placeOf(ring[i]));
      const Vec2 b = sum(a, 1, ground.way(ground.placeOf(ring[i]), ground.placeOf(ring[(i + 1) % ring.size()])));
      if ((a.y > 0) != (b.y > 0) && a.x + (b.x - a.x) * a.y / (a.y - b.y) > 0) isIn = !isIn;
    }
  return isIn;
}

/// A place that is so far along a line, and the direction of the line there.
std::pair<Vec2, Vec2> placeAlong(const std::vector<Vec2>& line, double length) {
  std::size_t i = 1;
  for (; i + 1 < line.size() && length > distance(line[i - 1], line[i]); ++i) length -= distance(line[i - 1], line[i]);
  const Vec2 way = wayFrom(line[i - 1], line[i]);
  return {sum(line[i - 1], length, way), way};
}

}  // namespace

void drawShapes(Drawing& drawing) {
  std::vector<Face> faces;
  for (const SceneObject& shape : drawing.view.shapes()) {
    const auto* const sphere = std::get_if<Sphere>(&shape.shape);
    const std::vector<Vec3> corners = cornersOf(shape);
    if (!sphere && corners.empty()) continue;
    const Pieces pieces = sphere ? drawSphere(drawing, shape, *sphere, faces) : drawEdges(drawing, shape, faces);
    nameShape(drawing, shape, pieces, sphere ? sphere->center : middleOf(corners));
  }
  fillFaces(drawing, faces);
}

/// Named beside its longest piece that is seen.
void drawSegment(Drawing& drawing, const NamedSegment& segment) {
  const Pieces pieces = drawEdge(drawing, segment.a, segment.b);
  if (segment.name.empty()) return;
  if (pieces.empty()) return addOutside(drawing, segment.name, pointOf(pointAlong(segment.a, segment.b, 0.5)));
  const Piece& longest = *std::max_element(pieces.begin(), pieces.end(), [&](const Piece& a, const Piece& b) {
    return a.isHidden != b.isHidden ? a.isHidden : lengthOf(a.line) < lengthOf(b.line);
  });
  Label label{segment.name, kOfShape, rankSegment, longest.isHidden};
  const auto [width, height] = label.size();
  double cost = 0;
  for (const double share : {0.5, 0.38, 0.62, 0.25, 0.75, 0.12, 0.88}) {
    if (longest.line.size() < 2) break;
    const auto [at, way] = placeAlong(longest.line, share * lengthOf(longest.line));
    const Vec2 normal{way.y, -way.x};
    const double gap = std::fabs(normal.x) * width / 2 + std::fabs(normal.y) * height / 2 + 3;
    const double above = normal.y > 0 ? -gap : gap;
    label.addSpot(cost, sum(at, above, normal));
    label.addSpot(cost + 0.4, sum(at, -above, normal));
    cost += 0.7;
  }
  label.addSpotsAround(longest.line.back(), 6, 1);
  drawing.sheet.labels.add(std::move(label));
}

void drawArea(Drawing& drawing, const NamedArea& area) {
  if (area.rings.empty()) return;
  const auto& shapes = drawing.view.shapes();
  const auto ground = std::find_if(shapes.begin(), shapes.end(), isGround);
  const CurveOptions onGround{.except = ground == shapes.end() ? nullptr : &*ground};
  std::vector<Line> lines;
  Line largest;
  for (const std::vector<Vec3>& ring : area.rings) {
    Pieces outline;
    for (std::size_t i = 0; i < ring.size(); ++i)
      append(outline, piecesOf(drawing.view, ring[i], ring[(i + 1) % ring.size()], onGround));
    drawing.sheet.addPieces(outline, "rim", 1);
    const std::vector<Line> parts = joined(outline);
    lines.insert(lines.end(), parts.begin(), parts.end());
    if (Line points = pointsOf(outline); !(largerSide(boundsOf(points)) <= largerSide(boundsOf(largest))))
      largest = std::move(points);
  }
  const auto under = groundOf(groundWith(area.rings[0], drawing.view.worldIsEcef()), drawing.view.eye());
  const std::vector<Line> outlines = outlinesWithin(drawing.rim, lines, [&](const Vec2& at) {
    const auto point = under->holdsEye ? std::nullopt : pointUnder(drawing.view, *under, at);
    return point && isWithin(area.rings, *point, *under);
  });
  if (outlines.empty() && isNamed(drawing, area.name)) addOutside(drawing, area.name, pointOf(area.rings[0][0]));
  if (outlines.empty()) return;
  drawing.sheet.addFilled(Layer::areas, "area", outlines);
  drawing.sheet.explain("outline on the ground");
  if (!isNamed(drawing, area.name)) return;
  const Vec2 middle = middleOf(largest.empty() ? drawing.view.frame() : boundsOf(largest));
  Label label{area.name, kOfShape, rankShape};
  label.addSpot(0, middle);
  label.addSpotsAround(middle, 6, 1);
  drawing.sheet.labels.add(std::move(label));
}

}  // namespace viewproj::cmd
