// What a picture shows of something convex is convex: the hull of the pieces of its edge and of the picture's corners
// where it is seen. So no polygon is clipped, and nothing behind the eye is divided by.
#include <algorithm>
#include <array>

#include "numbers/vectors.hpp"
#include "picture/drawing.hpp"

namespace viewproj::cmd {
namespace {

using detail::dot;

struct Face {
  const SceneObject* shape;
  std::vector<Vec3> corners;
  Vec3 normal;  ///< towards the eye
  std::vector<std::vector<Piece>> edges;
  BoxFace side = BoxFace::none;
  bool isAround = false;  ///< the eye is in the box

  Vec3 middle() const {
    Vec3 all;
    for (const Vec3& corner : corners) all = sum(all, 1.0 / static_cast<double>(corners.size()), corner);
    return all;
  }
};

/// From f0, the lightest, to f3: the light comes from above, the right of the eye and behind it.
std::string toneOf(const View& view, const Vec3& normal) {
  const Pose pose = view.camera().pose();
  const Vec3 light = unit(sum(sum(pose.up(), -0.75, pose.right()), -0.35, pose.forward()));
  const double dark = 0.5 - 0.5 * dot(normal, light);
  return dark > 0.6 ? "f3" : dark > 0.3 ? "f2" : dark > 0.16 ? "f1" : "f0";
}

Vec3 wayTo(const View& view, const Vec3& point) {
  return view.isParallel() ? view.camera().pose().forward() : sum(point, -1, view.eye());
}

std::vector<Piece> reversed(std::vector<Piece> pieces) {
  std::reverse(pieces.begin(), pieces.end());
  for (Piece& piece : pieces) std::reverse(piece.line.begin(), piece.line.end());
  return pieces;
}

void addBox(const View& view, const SceneObject& shape, const Box& box, std::vector<Face>& faces) {
  const CurveOptions plain{.findsHidden = false};
  std::array<std::array<std::vector<Piece>, 8>, 8> edges;
  for (const int axis : {1, 2, 4})
    for (int i = 0; i < 8; ++i)
      if (const int j = i | axis; j != i) {
        const auto from = static_cast<std::size_t>(i), to = static_cast<std::size_t>(j);
        edges[from][to] = piecesOf(view, cornerOf(box, i), cornerOf(box, j), plain);
        edges[to][from] = reversed(edges[from][to]);
      }
  const Vec3 eye = view.eye();
  bool isAround = !view.isParallel();
  for (std::size_t k = 0; k < 3; ++k) isAround = isAround && box.min[k] < eye[k] && eye[k] < box.max[k];
  for (int k = 0; k < 3; ++k)
    for (int high = 0; high < 2; ++high) {
      const int axis = 1 << k, u = 1 << (k + 1) % 3, v = 1 << (k + 2) % 3, first = high * axis;
      const std::array<int, 4> ring{first, first | u, first | u | v, first | v};
      Face face{&shape, {}, {}, {}, static_cast<BoxFace>(1 + 2 * k + high), isAround};
      face.normal[static_cast<std::size_t>(k)] = (high == 1) == isAround ? -1 : 1;
      if (dot(face.normal, wayTo(view, cornerOf(box, first))) >= 0) continue;
      for (std::size_t i = 0; i < 4; ++i) {
        face.corners.push_back(cornerOf(box, ring[i]));
        face.edges.push_back(edges[static_cast<std::size_t>(ring[i])][static_cast<std::size_t>(ring[(i + 1) % 4])]);
      }
      faces.push_back(std::move(face));
    }
}

void addTriangle(const View& view, const SceneObject& shape, const Triangle& t, std::vector<Face>& faces) {
  Vec3 normal = detail::crossOf(sum(t.b, -1, t.a), sum(t.c, -1, t.a));
  if (!(length(normal) > 0)) return;
  normal = sum({}, dot(normal, wayTo(view, t.a)) > 0 ? -1 : 1, unit(normal));
  Face face{&shape, {t.a, t.b, t.c}, normal, {}};
  for (const auto& [a, b] : {std::pair(t.a, t.b), {t.b, t.c}, {t.c, t.a}})
    face.edges.push_back(piecesOf(view, a, b, {.findsHidden = false}));
  faces.push_back(std::move(face));
}

void addSphere(const View& view, const SceneObject& shape, const Sphere& sphere, std::vector<Face>& faces) {
  constexpr int kCorners = 12;
  const auto outline = outlineOf(view, sphere);
  if (!outline) return;
  Circle circle = *outline;
  circle.turns = 0.5;
  Face face{&shape, {}, {}, {piecesOf(view, circle, outline->steps(view), {.findsHidden = false})}};
  for (int i = 0; i < kCorners; ++i) {
    const Vec4 p = circle(i / double(kCorners));
    face.corners.push_back({p.x, p.y, p.z});
  }
  faces.push_back(std::move(face));
}

/// Whether the face is behind other shapes, as far as its middle and places near its corners tell.
bool isHidden(const View& view, const Face& face) {
  constexpr double kNearCorner = 0.9;
  const Vec3 middle = face.middle();
  std::vector<Vec3> probes{middle};
  for (const Vec3& corner : face.corners) probes.push_back(pointAlong(middle, corner, kNearCorner));
  bool isInView = false;
  for (const Vec3& probe : probes)
    if (const auto at = view.place(pointOf(probe))) {
      if (!view.hides(probe, *at, face.shape)) return false;
      isInView = true;
    }
  return isInView;
}

/// The outline in order, if every edge is one piece from end to end.
std::vector<Vec2> wholeOutline(const Face& face) {
  constexpr double kJoin = 1;
  std::vector<Vec2> loop;
  for (const auto& edge : face.edges) {
    if (edge.size() != 1) return {};
    if (!loop.empty() && distance(loop.back(), edge[0].line.front()) > kJoin) return {};
    loop.insert(loop.end(), edge[0].line.begin(), edge[0].line.end());
  }
  return !loop.empty() && distance(loop.back(), loop.front()) <= kJoin ? loop : std::vector<Vec2>();
}

}  // namespace

std::vector<Vec2> rimOf(const View& view) {
  constexpr int kOfLens = 256, kHalvings = 30;
  const Rect& f = view.frame();
  const int count = view.hasLens() ? kOfLens : 4;
  std::vector<Vec2> rim;
  for (int k = 0; k < count; ++k) {
    const double side = 4.0 * k / count, along = side - std::floor(side);
    const Vec2 corners[] = {{f.left, f.top}, {f.right, f.top}, {f.right, f.bottom}, {f.left, f.bottom}};
    const auto first = static_cast<std::size_t>(side);
    const Vec2 at = between(corners[first], corners[(first + 1) % 4], along);
    const auto hasRay = [&](double t) { return !std::isnan(view.rayAt(between(view.middle(), at, t)).direction.x); };
    double inner = 0, outer = 1;
    if (!hasRay(1))
      for (int i = 0; i < kHalvings; ++i) {
        const double t = (inner + outer) / 2;
        (hasRay(t) ? inner : outer) = t;
      }
    rim.push_back(between(view.middle(), at, outer < 1 ? inner : 1));
  }
  return rim;
}

void fillConvex(const Drawing& drawing, Layer layer, const std::string& style, const std::vector<Piece>& outline,
                const std::function<bool(const Vec2&)>& meets) {
  std::vector<Vec2> corners;
  for (const Piece& piece : outline) corners.insert(corners.end(), piece.line.begin(), piece.line.end());
  for (const Vec2& at : drawing.rim)
    if (meets(at)) corners.push_back(at);
  drawing.sheet.addFilled(layer, style, hull(std::move(corners)));
}

void drawFaces(const Drawing& drawing) {
  const View& view = drawing.view;
  std::vector<Face> faces;
  for (const SceneObject& shape : view.shapes()) {
    if (const auto* box = std::get_if<Box>(&shape.shape)) addBox(view, shape, *box, faces);
    if (const auto* triangle = std::get_if<Triangle>(&shape.shape)) addTriangle(view, shape, *triangle, faces);
    if (const auto* sphere = std::get_if<Sphere>(&shape.shape)) addSphere(view, shape, *sphere, faces);
  }
  // Far ones first, and first of all what the eye is in.
  std::vector<std::pair<double, const Face*>> order;
  for (const Face& face : faces)
    order.emplace_back(face.isAround ? HUGE_VAL : length(sum(face.middle(), -1, view.eye())), &face);
  std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  for (const auto& [away, face] : order) {
    if (isHidden(view, *face)) continue;
    const std::string style = std::holds_alternative<Sphere>(face->shape->shape) ? "f1" : toneOf(view, face->normal);
    const auto loop = view.hasLens() ? wholeOutline(*face) : std::vector<Vec2>();
    if (!loop.empty()) {
      drawing.sheet.addFilled(Layer::faces, style, loop);
      continue;
    }
    std::vector<Piece> outline;
    for (const auto& edge : face->edges) outline.insert(outline.end(), edge.begin(), edge.end());
    fillConvex(drawing, Layer::faces, style, outline, [&, face = face](const Vec2& at) {
      const Ray ray = view.rayAt(at);
      const Hits hits = hitsOf(ray, *face->shape);
      return std::any_of(hits.begin(), hits.end(), [&](const Hit& hit) { return hit.face == face->side; });
    });
  }
}

}  // namespace viewproj::cmd
