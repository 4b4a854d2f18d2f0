// Planes and the Earth: a tint, the horizon, and a grid of round numbers that thins out with distance.
#include <algorithm>
#include <numbers>
#include <optional>

#include "numbers/vectors.hpp"
#include "picture/drawing.hpp"
#include "picture/svg.hpp"
#include "text/number.hpp"
#include "viewproj/geodesy.hpp"

namespace viewproj::cmd {
namespace {

using detail::crossOf;
using detail::dot;

constexpr double kDegrees = std::numbers::pi / 180;

/// A surface with two coordinates.
struct Surface {
  std::string name, unit;
  std::function<Vec3(double u, double v)> at;
  std::function<Vec2(const Vec3& point)> coordinatesOf;
  std::function<bool(const Vec2& at, Vec3& point)> hit;  ///< where the ray of a place on the sheet hits it
  Vec2 foot;                                             ///< below the eye
  Vec2 size{1, 1};                                       ///< of a step of 1, in the world
  double height = 0;                                     ///< of the eye
  std::optional<Vec2> limits = {};                       ///< |u|, and |v| from the foot
};

/// The ground's width under a sixth of the picture, low in its middle column.
std::optional<double> widthBelow(const View& view, const Surface& surface) {
  const Rect& f = view.frame();
  for (const double share : {0.85, 0.7, 0.6, 0.5, 0.4, 0.25, 0.1, 0.03}) {
    const double y = f.top + share * (f.bottom - f.top), x = view.middle().x, side = (f.right - f.left) / 12;
    Vec3 a, b;
    if (surface.hit({x - side, y}, a) && surface.hit({x + side, y}, b)) return length(sum(a, -1, b));
  }
  return std::nullopt;
}

/// The coordinates that the picture shows, if its edge shows nothing but the surface.
std::optional<Rect> coordinatesInView(const View& view, const Surface& surface) {
  constexpr int kPlaces = 8;
  const Rect& f = view.frame();
  std::vector<Vec2> seen;
  for (int i = 0; i < kPlaces; ++i) {
    const double t = i / double(kPlaces), x = f.left + t * (f.right - f.left), y = f.top + t * (f.bottom - f.top);
    for (const Vec2& at :
         {Vec2{x, f.top}, {f.right, y}, {f.right - x + f.left, f.bottom}, {f.left, f.bottom - y + f.top}}) {
      Vec3 point;
      if (!surface.hit(at, point)) return std::nullopt;
      seen.push_back(surface.coordinatesOf(point));
    }
  }
  const Rect box = boundsOf(seen);
  return grown(box, 0.25 * std::max(box.right - box.left, box.bottom - box.top));
}

/// Lines of 1, 10 and 100 steps around the foot of the eye. They reach as far as the next one across the view is kGap
/// away on the sheet: step F h / r^2 = kGap.
void drawGrid(const Drawing& drawing, const Surface& surface, double step) {
  constexpr double kGap = 7, kReachOfParallel = 12, kOfGrid = 0.06, kShortest = 2, kCoarsestDegrees = 30;
  constexpr int kLevels = 3, kMostLines = 400, kSteps = 80;
  const View& view = drawing.view;
  const Projection projection = view.camera().projection();
  const double focal = (view.frame().right - view.frame().left) / (projection.right() - projection.left());
  const auto shown = coordinatesInView(view, surface);
  const double feet[] = {surface.foot.x, surface.foot.y}, sizes[] = {surface.size.x, surface.size.y};
  bool isDrawn = false;
  for (int level = 0; level < kLevels; ++level) {
    const double s = step * std::pow(10, level);
    if (surface.limits && level > 0 && s > kCoarsestDegrees) break;
    std::string data;
    for (const bool isU : {true, false}) {
      const double foot = feet[isU ? 0 : 1], otherFoot = feet[isU ? 1 : 0];
      const double size = sizes[isU ? 0 : 1], otherSize = sizes[isU ? 1 : 0];
      const double reach =
          view.isParallel() ? kReachOfParallel * s * size : std::sqrt(s * size * focal * surface.height / kGap);
      double low = foot - reach / size, high = foot + reach / size;
      if (shown)
        low = std::max(low, isU ? shown->left : shown->top), high = std::min(high, isU ? shown->right : shown->bottom);
      if (surface.limits) {
        const double limit = isU ? surface.limits->x : surface.limits->y, middle = isU ? 0 : foot;
        low = std::max(low, middle - limit), high = std::min(high, middle + limit);
      }
      const double first = std::ceil(low / s), count = std::floor(high / s) - first;
      if (!(count <= kMostLines)) continue;
      for (int i = 0; i <= count; ++i) {
        const double k = first + i;
        if (level + 1 < kLevels && std::fmod(k, 10) == 0) continue;
        const double off = (k * s - foot) * size, half = std::sqrt(std::max(0.0, reach * reach - off * off));
        const double away = std::hypot(surface.height, off), angle = std::atan(half / away);
        const auto at = [&](double t) {  // by equal angles at the eye
          double other = otherFoot + away * std::tan((2 * t - 1) * angle) / otherSize;
          if (surface.limits)
            other = isU ? std::clamp(other, otherFoot - 180, otherFoot + 180) : std::clamp(other, -90.0, 90.0);
          return pointOf(isU ? surface.at(k * s, other) : surface.at(other, k * s));
        };
        for (const Piece& piece : piecesOf(view, at, kSteps, {.extent = Extent::anyDistance})) {
          if (piece.isHidden || distance(piece.line.front(), piece.line.back()) < kShortest) continue;
          data += svg::line(piece.line);
          drawing.sheet.labels.addInk(piece.line, kOfGrid);
        }
      }
    }
    if (data.empty()) continue;
    drawing.sheet.add(Layer::grid, svg::path("grid g" + std::to_string(level), data));
    isDrawn = true;
  }
  if (isDrawn) drawing.sheet.explain(Symbol::grid, surface.name + ": grid of " + formatDigits(step, 3) + surface.unit);
}

/// The horizon, if the view has one, and a tint up to it.
void drawHorizon(const Drawing& drawing, const SceneObject& ground, const std::optional<Circle>& circle,
                 const std::string& text) {
  constexpr double kOfHorizon = 0.3;
  const View& view = drawing.view;
  std::vector<Piece> pieces;
  if (circle) pieces = piecesOf(view, *circle, circle->steps(view), {Extent::anyDistance, false});
  for (const Piece& piece : pieces) {
    drawing.sheet.add(Layer::horizon, svg::path("horizon", svg::line(piece.line)));
    drawing.sheet.labels.addInk(piece.line, kOfHorizon);
    drawing.sheet.explain(Symbol::horizon, text);
  }
  if (drawing.sheet.hasPhoto()) return;
  fillConvex(drawing, Layer::land, "land", pieces, [&](const Vec2& at) {
    const Ray ray = view.rayAt(at);
    return hitsOf(ray, ground).count > 0;
  });
}

Surface surfaceOf(const View& view, const SceneObject& ground) {
  Surface surface;
  surface.name = ground.id;
  surface.hit = [&view, &ground](const Vec2& at, Vec3& point) {
    const Ray ray = view.rayAt(at);
    const Hits hits = hitsOf(ray, ground);
    if (hits.count > 0) point = hits.hits[0].point;
    return hits.count > 0;
  };
  return surface;
}

void drawPlane(const Drawing& drawing, const SceneObject& ground, const Plane& plane) {
  constexpr double kAlongAxis = 1 - 1e-12;
  const View& view = drawing.view;
  Vec3 n = unit(plane.normal);
  double height = dot(sum(view.eye(), -1, plane.point), n);
  if (height < 0) height = -height, n = sum({}, -1, n);
  if (!view.isParallel() && height <= 1e-12 * (length(view.eye()) + length(plane.point))) return;
  std::size_t axis = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (std::fabs(n[i]) > std::fabs(n[axis])) axis = i;
  Vec3 u, v, base = plane.point;
  if (std::fabs(n[axis]) > kAlongAxis) {
    u[(axis + 1) % 3] = v[(axis + 2) % 3] = 1;
    base = {};
    base[axis] = plane.point[axis];
  } else {
    Vec3 across = crossOf(view.camera().pose().up(), n);
    if (length(across) < 1e-6) across = crossOf(view.camera().pose().right(), n);
    u = unit(across);
    v = crossOf(n, u);
  }
  drawHorizon(drawing, ground, view.isParallel() ? std::nullopt : std::optional(horizonOf(view, n)), "horizon");
  Surface surface = surfaceOf(view, ground);
  Vec3 foot = sum(view.eye(), -height, n);
  if (view.isParallel()) (void)surface.hit(view.middle(), foot);
  surface.height = height;
  surface.at = [=](double a, double b) { return sum(sum(base, a, u), b, v); };
  surface.coordinatesOf = [=](const Vec3& p) { return Vec2{dot(sum(p, -1, base), u), dot(sum(p, -1, base), v)}; };
  surface.foot = surface.coordinatesOf(foot);
  if (const auto width = widthBelow(view, surface)) drawGrid(drawing, surface, roundedDown(*width));
}

/// Ticks along the horizon.
void drawAzimuths(const Drawing& drawing, const Vec3& up, double dip) {
  constexpr double kMost = 14, kAbove = 0.004, kTick = 6, kText = 15;
  constexpr const char* kNames[] = {"N", "NE", "E", "SE", "S", "SW", "W", "NW"};
  const View& view = drawing.view;
  const double span = view.camera().projection().fov(Fov::diagonal) / kMost;
  const double steps[] = {1, 2, 5, 10, 15, 30, 45, 90};
  const int step = static_cast<int>(*std::find_if(steps, std::end(steps) - 1, [&](double s) { return s >= span; }));
  const Vec3 east = unit(crossOf(Vec3{0, 0, 1}, up)), north = crossOf(up, east);
  for (int azimuth = 0; azimuth < 360; azimuth += step) {
    const double a = azimuth * kDegrees;
    const auto at = [&](double elevation) {
      const Vec3 level = sum(sum({}, std::sin(a), east), std::cos(a), north);
      return view.place(directionOf(sum(sum({}, std::cos(elevation), level), std::sin(elevation), up)),
                        Extent::anyDistance);
    };
    const auto place = at(-dip), below = at(-dip - kAbove);
    if (!place || !below) continue;
    const double gap = distance(*place, *below);
    const Vec2 way{(below->x - place->x) / gap, (below->y - place->y) / gap};
    const std::string name = azimuth % 45 == 0 ? kNames[azimuth / 45] : std::to_string(azimuth) + "°";
    const TextStyle style{"azimuth", 12};
    const Vec2 middle{place->x + kText * way.x, place->y + kText * way.y};
    const double half = textWidth(name, style) / 2 + 2;
    drawing.sheet.add(Layer::marks,
                      svg::path("tick", svg::line({*place, {place->x + kTick * way.x, place->y + kTick * way.y}})) +
                          svg::text(style.name, {middle.x, middle.y + 4}, "middle", name));
    drawing.sheet.labels.addMark({middle.x - half, middle.y - 8, middle.x + half, middle.y + 8});
  }
}

void drawEarth(const Drawing& drawing, const SceneObject& ground, double heightOfSurface) {
  constexpr double kMetresPerDegree = 111e3, kLargestDip = 20 * kDegrees;
  const View& view = drawing.view;
  const Geodetic place = ecefToGeodetic(view.eye());
  const double height = place.height - heightOfSurface;
  const double a = kWgs84.equatorial + heightOfSurface, b = kWgs84.polar + heightOfSurface;
  const auto outline = outlineOf(view, {{0, 0, 0}, a}, b / a);
  if (!outline || !(height > 0)) return;
  const Vec4 p = (*outline)(0.5);
  const Vec3 up = ellipsoidNormal(place), way = sum({p.x, p.y, p.z}, -1, view.eye());
  const double away = length(way), dip = std::asin(std::clamp(-dot(way, up) / away, -1.0, 1.0));
  drawHorizon(drawing, ground, *outline,
              view.isParallel() ? "horizon"
                                : "horizon, " + formatDigits(away / 1000, 3) + " km away, " +
                                      formatDigits(dip / kDegrees, 3) + "° below level");
  Surface surface = surfaceOf(view, ground);
  surface.unit = "°";
  surface.at = [=](double lat, double lon) { return geodeticToEcef({lat, lon, heightOfSurface}); };
  surface.coordinatesOf = [=](const Vec3& point) {
    const Geodetic at = ecefToGeodetic(point);
    return Vec2{at.lat, place.lon + std::remainder(at.lon - place.lon, 360)};
  };
  surface.foot = {place.lat, place.lon};
  surface.size = {kMetresPerDegree, kMetresPerDegree * std::max(0.01, std::cos(place.lat * kDegrees))};
  surface.height = height;
  surface.limits = {90, 180};
  if (const auto width = widthBelow(view, surface))
    drawGrid(drawing, surface, std::min(30.0, roundedDown(*width / kMetresPerDegree)));
  if (!view.isParallel() && dip < kLargestDip) drawAzimuths(drawing, up, dip);
}

std::optional<double> heightOf(const SceneObject& ground) {
  if (const auto* surface = std::get_if<HeightSurface>(&ground.shape)) return surface->height;
  return std::holds_alternative<Ellipsoid>(ground.shape) ? std::optional(0.0) : std::nullopt;
}

}  // namespace

double roundedDown(double value) {
  const double power = std::pow(10, std::floor(std::log10(value)));
  for (const double digit : {5.0, 2.0})
    if (digit * power <= value * 1.0001) return digit * power;
  return power;
}

const SceneObject* firstGround(const std::vector<SceneObject>& shapes) {
  for (const SceneObject& shape : shapes)
    if (std::holds_alternative<Plane>(shape.shape) || heightOf(shape)) return &shape;
  return nullptr;
}

Vec3 groundPoint(const SceneObject& ground, const Vec3& point) {
  if (const auto* plane = std::get_if<Plane>(&ground.shape)) {
    const Vec3 n = unit(plane->normal);
    return sum(point, -dot(sum(point, -1, plane->point), n), n);
  }
  const Geodetic place = ecefToGeodetic(point);
  return geodeticToEcef({place.lat, place.lon, heightOf(ground).value_or(0)});
}

void drawGround(const Drawing& drawing, const SceneObject& ground) {
  if (const auto* plane = std::get_if<Plane>(&ground.shape)) drawPlane(drawing, ground, *plane);
  if (const auto height = heightOf(ground)) drawEarth(drawing, ground, *height);
}

}  // namespace viewproj::cmd
