// Dots of points, crosses of pixels, arrows of pairs, and markers of what lies outside.
#include <algorithm>
#include <numeric>

#include "numbers/vectors.hpp"
#include "picture/drawing.hpp"
#include "picture/svg.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {
namespace {

using detail::dot;

constexpr double kDot = 4.5;

const SceneObject* shapeNamed(const View& view, const std::string& name) {
  for (const SceneObject& shape : view.shapes())
    if (shape.id == name && !name.empty()) return &shape;
  return nullptr;
}

void nameMark(const Drawing& drawing, const std::string& name, const std::string& note, const TextStyle& style,
              int rank, const Vec2& at, double radius, bool isFaint = false) {
  if (name.empty() && note.empty()) return;
  Label label{name, style, rank, {}, note, isFaint};
  label.addSpotsAround(at, radius);
  drawing.sheet.labels.add(std::move(label));
}

/// The end of a short arrow from a place on the sheet towards another point; nothing where that is towards the eye.
std::optional<Vec2> arrowEnd(const View& view, const Vec2& at, const Vec3& towards) {
  constexpr double kLength = 34, kShortest = 3;
  const ScreenPoint p = worldToScreen(view.camera(), towards, Precision::standard);
  if (p.status != PointStatus::inFront) return std::nullopt;
  const Vec2 end = view.onSheet({p.x, p.y});
  const double size = distance(at, end);
  if (!(size > kShortest)) return std::nullopt;
  return between(at, end, kLength / size);
}

/// What the ray of a pixel hits first, with the distance; and the end of an arrow along the normal there.
struct PixelHit {
  std::string text;
  std::optional<Vec2> normalEnd = {};
};
PixelHit hitOf(const View& view, const Vec2& pixel) {
  constexpr double kNormal = 0.05;  // of the distance
  if (view.shapes().empty()) return {formatNumber(pixel.x) + ", " + formatNumber(pixel.y)};
  const Ray ray = screenToRay(view.camera(), pixel);
  const std::vector<SceneHit> hits = hitsOf(view.camera(), ray, view.shapes());
  if (hits.empty()) return {"nothing"};
  const Hit& hit = hits[0].hit;
  const double size = std::fabs(hit.distance) * (dot(hit.normal, ray.direction) > 0 ? -kNormal : kNormal);
  return {hits[0].object->id + " " + formatDigits(hit.distance, 4) + (view.worldIsEcef() ? " m" : ""),
          arrowEnd(view, view.onSheet(pixel), sum(hit.point, size, hit.normal))};
}

}  // namespace

void drawPoint(const Drawing& drawing, const NamedPoint& point) {
  const View& view = drawing.view;
  const auto at = view.place(point.point, Extent::anyDistance);
  if (!at) {
    if (!point.name.empty()) drawing.markers.add(point.name, point.point);
    return;
  }
  const Vec4& p = point.point;
  const bool isInView = view.place(p).has_value();
  const bool isHidden = p.w != 0 && view.hides({p.x / p.w, p.y / p.w, p.z / p.w}, *at, shapeNamed(view, point.name));
  std::string note = point.note;
  if (!isInView) {
    const bool isFar = (worldToScreen(view.camera(), p).outside & sideFar) != 0;
    note += (note.empty() ? "" : ", ") + std::string(isFar ? "beyond far" : "nearer than near");
  }
  const bool isHollow = isHidden || !isInView;
  drawing.sheet.addMark(*at, kDot, svg::circle(isHollow ? "dot hollow" : "dot", *at, kDot));
  drawing.sheet.explain(isHollow ? Symbol::hiddenPoint : Symbol::point);
  nameMark(drawing, point.name, note, kOfPoint, rankPoint, *at, 5, isHollow);
}

void drawPixel(const Drawing& drawing, const Vec2& pixel) {
  const View& view = drawing.view;
  const Vec2 at = view.onSheet(pixel);
  const PixelHit hit = hitOf(view, pixel);
  if (!holds(view.frame(), at)) return drawing.markers.add(hit.text, at);
  drawing.sheet.addMark(
      at, 7, svg::path("cross", "M" + svg::pair({at.x - 8, at.y}) + "h16M" + svg::pair({at.x, at.y - 8}) + "v16"));
  drawing.sheet.explain(Symbol::cross, view.shapes().empty() ? "pixel" : "");
  if (hit.normalEnd) {
    drawing.sheet.addArrow(at, *hit.normalEnd, "normal");
    drawing.sheet.explain(Symbol::normal);
  }
  nameMark(drawing, hit.text, "", kOfCross, rankPixel, at, 8);
}

void drawPairs(const Drawing& drawing, const std::vector<NamedPoint>& points) {
  constexpr double kTooSmall = 8, kEnlarged = 36, kBesideDot = 6, kShortest = 1;
  const View& view = drawing.view;
  struct Pair {
    const NamedPoint* point;
    Vec2 from, to;  ///< on the sheet
    double miss;    ///< in pixels
  };
  std::vector<Pair> pairs;
  std::size_t count = 0;
  for (const NamedPoint& point : points) {
    if (!point.pixel) continue;
    ++count;
    const ScreenPoint p = worldToScreen(view.camera(), point.point);
    if (p.status == PointStatus::inFront)
      pairs.push_back({&point, view.onSheet(*point.pixel), view.onSheet({p.x, p.y}),
                       std::hypot(p.x - point.pixel->x, p.y - point.pixel->y)});
  }
  if (count == 0) return;
  std::string text = std::to_string(count) + (count == 1 ? " pair" : " pairs");
  if (count > pairs.size()) text += ", " + std::to_string(count - pairs.size()) + " without a computed pixel";
  if (pairs.empty()) return drawing.sheet.note(text);
  const Pair& worst =
      *std::max_element(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.miss < b.miss; });
  const double largest = worst.miss * view.scale();
  const double zoom = largest > 0 && largest < kTooSmall ? roundedDown(kEnlarged / largest) : 1;
  double squares = 0;
  for (const Pair& pair : pairs) {
    squares += pair.miss * pair.miss;
    const bool isOnSheet = holds(view.frame(), pair.from);
    if (zoom == 1 && isOnSheet) {
      const Vec2& at = pair.from;
      drawing.sheet.addMark(at, 6, svg::path("cross", "M" + svg::pair({at.x - 6, at.y - 6}) + "l12,12m0,-12l-12,12"));
      drawing.sheet.explain(Symbol::pairPixel);
      const SceneObject* const hit = view.shapeAt(at);
      if (!view.shapes().empty())
        nameMark(drawing, "hits " + (hit ? hit->id : "nothing"), "", kOfPixel, rankPixel, at, 7);
    }
    const Vec2 end = between(pair.from, pair.to, zoom);
    const double size = distance(pair.from, end);
    if (size <= kShortest) continue;
    drawing.sheet.addArrow(
        pair.from, zoom > 1 || size <= 2 * kBesideDot ? end : between(pair.from, end, 1 - kBesideDot / size), "miss");
    drawing.sheet.explain(
        Symbol::miss,
        zoom > 1 ? "from the record's pixel to the computed one, " + formatDigits(zoom, 3) + " times as long" : "");
  }
  text += ": miss rms " + formatDigits(std::sqrt(squares / static_cast<double>(pairs.size())), 3) + " px, largest " +
          formatDigits(worst.miss, 3) + " px";
  drawing.sheet.note(text + (worst.point->name.empty() ? "" : " (" + worst.point->name + ")"));
}

void Markers::add(const std::string& name, const Vec4& point) {
  const ScreenPoint p = worldToScreen(view_.camera(), point);
  if (p.status == PointStatus::inFront) return add(name, view_.onSheet({p.x, p.y}));
  const Vec3 v{point.x, point.y, point.z};
  const Vec3 way = point.w == 0 ? v : sum(sum({}, 1 / point.w, v), -1, view_.eye());
  const Pose pose = view_.camera().pose();
  addTowards(name, {dot(way, pose.right()), -dot(way, pose.up())}, p.status == PointStatus::behind);
}

void Markers::addTowards(const std::string& name, const Vec2& way, bool isBehind) {
  const Rect& f = view_.frame();
  const double x = std::fabs(way.x) / (f.right - f.left), y = std::fabs(way.y) / (f.bottom - f.top);
  const double share = 0.5 / std::max({x, y, 1e-300});
  const bool isAside = x >= y;
  const Vec2 at{view_.middle().x + share * way.x, view_.middle().y + share * way.y};
  markers_.push_back({name, isAside ? (way.x < 0 ? 0 : 1) : (way.y < 0 ? 2 : 3), isAside ? at.y : at.x, isBehind});
}

/// Along each side in order, at least a line of text apart. Of many some are only counted.
void Markers::draw(Sheet& sheet) const {
  constexpr const char* kSides[] = {"left", "right", "top", "bottom"};
  constexpr double kHeight = 9, kHalfWidth = 6, kFromCorner = 11;
  const Rect& f = view_.frame();
  for (int side = 0; side < 4; ++side) {
    const bool isAside = side < 2;
    const double low = (isAside ? f.top : f.left) + kFromCorner, high = (isAside ? f.bottom : f.right) - kFromCorner;
    const double gap = isAside ? 18 : 15;
    std::vector<Marker> mine;
    std::copy_if(markers_.begin(), markers_.end(), std::back_inserter(mine),
                 [&](const Marker& m) { return m.side == side; });
    const auto room = static_cast<std::size_t>(std::max(1.0, (high - low) / gap / 2));
    if (mine.size() > room) {
      sheet.note(std::to_string(mine.size() - room) + " more outside, " + kSides[side]);
      mine.resize(room);
    }
    std::stable_sort(mine.begin(), mine.end(), [](const Marker& a, const Marker& b) { return a.at < b.at; });
    std::vector<double> places;
    for (const Marker& marker : mine)
      places.push_back(
          std::max(std::clamp(marker.at, low, std::max(low, high)), places.empty() ? low : places.back() + gap));
    for (std::size_t i = places.size(); i-- > 0;)
      places[i] = std::min(places[i], i + 1 == places.size() ? high : places[i + 1] - gap);
    for (std::size_t i = 0; i < mine.size(); ++i) {
      const double out = side % 2 == 0 ? -1 : 1, edge = side == 0   ? f.left
                                                        : side == 1 ? f.right
                                                        : side == 2 ? f.top
                                                                    : f.bottom;
      // As if the sides were the right or the left one; then exchanged.
      const auto at = [&](double along, double in) {
        return isAside ? Vec2{edge - out * in, along} : Vec2{along, edge - out * in};
      };
      const double p = places[i];
      sheet.addMark(
          at(p, 1 + kHeight / 2), 6,
          svg::path(mine[i].isBehind ? "out hollow" : "out",
                    svg::line({at(p, 1), at(p - kHalfWidth, 1 + kHeight), at(p + kHalfWidth, 1 + kHeight)}, true)));
      sheet.explain(mine[i].isBehind ? Symbol::behind : Symbol::outside);
      Label label{mine[i].name, kOfOutside, rankOutside};
      const auto [width, height] = label.size();
      const Vec2 base = at(p, 1 + kHeight);
      for (int k = 0; k < 9; ++k) {
        const int shift = k % 2 == 1 ? (k + 1) / 2 : -k / 2;
        if (isAside)
          label.addSpot(3 * k, at(p + shift * height / 2, 1 + kHeight + 5 + width / 2),
                        std::abs(shift) < 2 ? std::nullopt : std::optional(base));
        for (int row = 0; row < 4 && !isAside; ++row)
          label.addSpot(k + 4 * row, at(p + shift * 0.24 * width, 1 + kHeight + 5 + height / 2 + 18 * row),
                        row > 0 ? std::optional(base) : std::nullopt);
      }
      sheet.labels.add(std::move(label));
    }
  }
}

}  // namespace viewproj::cmd
