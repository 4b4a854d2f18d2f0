// Dots of points, crosses of pixels, arrows of pairs, and triangles of what lies outside.
#include <algorithm>
#include <numbers>

#include "numbers/vectors.hpp"
#include "picture/drawing.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {
namespace {

using detail::dot;

constexpr double kBesideDot = 5, kOfPixelMark = 8, kOfPairMark = 6;

void nameMark(const Drawing& drawing, Label label, const Vec2& at, double radius) {
  if (label.text.empty() && label.note.empty()) return;
  label.addSpotsAround(at, radius);
  drawing.sheet.labels.add(std::move(label));
}

/// What the ray of a pixel hits first, with the distance; and the end of an arrow along the normal there, if that is
/// not towards the eye.
struct PixelHit {
  std::string text;
  std::optional<Vec2> normalEnd = {};
};
PixelHit hitOf(const View& view, const Vec2& pixel) {
  constexpr double kNormal = 0.05;  // of the distance
  constexpr double kLength = 34, kShortest = 3;
  if (view.shapes().empty()) return {formatNumber(pixel.x) + ", " + formatNumber(pixel.y)};
  const Ray ray = screenToRay(view.camera(), pixel);
  const std::vector<SceneHit> hits = hitsOf(view.camera(), ray, view.shapes());
  if (hits.empty()) return {"nothing"};
  const Hit& hit = hits[0].hit;
  PixelHit found{hits[0].object->id + " " + formatDigits(hit.distance, 4) + (view.worldIsEcef() ? " m" : "")};
  const double size = std::fabs(hit.distance) * (dot(hit.normal, ray.direction) > 0 ? -kNormal : kNormal);
  const Vec2 at = view.onSheet(pixel);
  const auto end = view.pixelOf(pointOf(sum(hit.point, size, hit.normal)));
  if (end && distance(at, *end) > kShortest) found.normalEnd = sum(at, kLength, wayFrom(at, *end));
  return found;
}

}  // namespace

void settleDots(Drawing& drawing, const std::vector<NamedPoint>& points) {
  constexpr double kShare = 0.03, kSmallest = 1;  // of the picture under the dots
  const Rect& f = drawing.view.frame();
  const double picture = (f.right - f.left) * (f.bottom - f.top);
  double count = 0, underNames = 0;
  for (const NamedPoint& point : points) {
    if (!drawing.view.place(point.point, Extent::anyDistance)) continue;
    const Vec2 size = Label{point.name, kOfPoint, rankPoint, false, point.note}.size();
    ++count;
    underNames += point.name.empty() && point.note.empty() ? 0 : size.x * size.y;
  }
  const double radius = std::sqrt(kShare * picture / (std::numbers::pi * std::max(1.0, count)));
  drawing.radiusOfDots = std::clamp(radius, kSmallest, drawing.radiusOfDots);
  drawing.namesPoints = underNames <= picture;
  if (!drawing.namesPoints)
    drawing.notes.push_back(formatNumber(count) + " points are too many for their names, which are left out");
}

void drawPoint(Drawing& drawing, const NamedPoint& point) {
  const View& view = drawing.view;
  const auto at = view.place(point.point, Extent::anyDistance);
  if (!at && !point.name.empty() && drawing.namesPoints) return addOutside(drawing, point.name, point.point);
  if (!at) return void(++drawing.moreOutside);
  const auto own = std::find_if(view.shapes().begin(), view.shapes().end(), [&](const SceneObject& shape) {
    return shape.id == point.name && !point.name.empty();
  });
  const auto position = positionOf(point.point);
  bool isHollow = position && view.hides(*position, *at, own == view.shapes().end() ? nullptr : &*own);
  std::string note = point.note;
  if (!view.place(point.point)) {
    const bool isFar = (worldToScreen(view.camera(), point.point).outside & sideFar) != 0;
    note += (note.empty() ? "" : ", ") + std::string(isFar ? "beyond far" : "nearer than near");
    isHollow = true;
  }
  drawing.sheet.addDot(*at, drawing.radiusOfDots, isHollow);
  drawing.sheet.explain(isHollow ? "point not seen" : "point");
  if (drawing.namesPoints) nameMark(drawing, {point.name, kOfPoint, rankPoint, isHollow, note}, *at, kBesideDot);
}

void drawPixel(Drawing& drawing, const Vec2& pixel) {
  const View& view = drawing.view;
  const Vec2 at = view.onSheet(pixel);
  const PixelHit hit = hitOf(view, pixel);
  if (!holds(view.frame(), at)) {
    drawing.outside.push_back({hit.text, sum(at, -1, middleOf(view.frame()))});
    return;
  }
  drawing.sheet.addCross(at, kOfPixelMark, true);
  drawing.sheet.explain("pixel: first hit, distance", view.shapes().empty() ? "pixel" : "");
  if (hit.normalEnd) {
    drawing.sheet.addArrow(at, *hit.normalEnd, "normal");
    drawing.sheet.explain("normal");
  }
  nameMark(drawing, {hit.text, kOfCross, rankPixel}, at, kOfPixelMark);
}

void drawPairs(Drawing& drawing, const std::vector<NamedPoint>& points) {
  constexpr double kTooSmall = 8, kEnlarged = 36, kBeforeDot = 6, kShortest = 1, kSmallestMark = 2;
  constexpr double kRounding = 0.001;  // pixels
  const View& view = drawing.view;
  Sheet& sheet = drawing.sheet;
  struct Pair {
    const NamedPoint* point;
    Vec2 from;  ///< on the sheet
    std::optional<Vec2> to;
  };
  std::vector<Pair> pairs;
  std::size_t count = 0;  // of those with both
  double squares = 0, largest = 0;
  std::string worst;
  for (const NamedPoint& point : points) {
    if (!point.pixel) continue;
    pairs.push_back({&point, view.onSheet(*point.pixel), view.pixelOf(point.point)});
    if (!pairs.back().to) continue;
    const double miss = distance(pairs.back().from, *pairs.back().to);
    ++count;
    squares += miss * miss;
    if (miss > largest) largest = miss, worst = point.name;
  }
  if (pairs.empty()) return;
  std::string text = std::to_string(pairs.size()) + (pairs.size() == 1 ? " pair" : " pairs");
  if (count < pairs.size()) text += ", " + std::to_string(pairs.size() - count) + " without a computed pixel";
  const double least = kRounding * view.scale();
  const bool areSmall = largest < kTooSmall;
  const double zoom = areSmall && largest >= least ? roundedDown(kEnlarged / largest) : 1;
  for (const Pair& pair : pairs) {
    const double miss = pair.to ? distance(pair.from, *pair.to) : HUGE_VAL;
    if (!(pair.to && areSmall) && holds(view.frame(), pair.from)) {
      const double size = std::clamp(miss / 2, kSmallestMark, kOfPairMark);  // so that it hides no miss
      const SceneObject* const hit = view.shapeAt(pair.from);
      sheet.addCross(pair.from, size, false);
      sheet.explain("pixel of the record");
      nameMark(drawing,
               {pair.to ? "" : pair.point->name, kOfPixel, rankPixel, false,
                view.shapes().empty() ? "" : "hits " + (hit ? hit->id : "nothing")},
               pair.from, size);
    }
    if (!pair.to || miss < least || miss * zoom <= kShortest) continue;
    Vec2 end = between(pair.from, *pair.to, zoom);
    if (zoom == 1 && miss > 2 * kBeforeDot) end = between(pair.from, end, 1 - kBeforeDot / miss);
    sheet.addArrow(pair.from, end, "miss");
    const std::string enlarged =
        "from the record's pixel towards the computed one, " + formatDigits(zoom, 3) + " times as long as the miss";
    sheet.explain("from the record's pixel to the computed one", zoom > 1 ? enlarged : "");
  }
  if (count > 0 && largest < least) {
    text += ": the pixels agree within " + formatNumber(kRounding) + " px";
  } else if (count > 0) {
    const auto pixels = [&](double units) { return formatDigits(units / view.scale(), 3) + " px"; };
    text += ": miss rms " + pixels(std::sqrt(squares / static_cast<double>(count))) + ", largest " + pixels(largest) +
            (worst.empty() ? "" : " (" + worst + ")");
  }
  drawing.notes.push_back(text);
}

void addOutside(Drawing& drawing, const std::string& name, const Vec4& point) {
  const View& view = drawing.view;
  if (const auto at = view.pixelOf(point)) {
    drawing.outside.push_back({name, sum(*at, -1, middleOf(view.frame()))});
    return;
  }
  const Pose pose = view.camera().pose();
  const auto position = positionOf(point);
  const Vec3 way = position ? sum(*position, -1, view.eye()) : Vec3{point.x, point.y, point.z};
  drawing.outside.push_back({name, {dot(way, pose.right()), -dot(way, pose.up())}, dot(way, pose.forward()) < 0});
}

/// Each at the free place that is nearest to its own. Of many some are only counted.
void drawOutside(Drawing& drawing) {
  constexpr double kSize = 9, kHalfWidth = 6, kGap = 15, kFarthest = 90, kOfTriangle = 6;
  Sheet& sheet = drawing.sheet;
  const Rect& f = sheet.frame;
  const Vec2 middle = middleOf(f), half{(f.right - f.left) / 2, (f.bottom - f.top) / 2};
  std::size_t more = drawing.moreOutside;
  for (const Drawing::Outside& each : drawing.outside) {
    const double x = std::fabs(each.way.x) / half.x, y = std::fabs(each.way.y) / half.y;
    const bool isAside = x >= y;
    const Vec2 out = isAside ? Vec2{std::copysign(1, each.way.x), 0} : Vec2{0, std::copysign(1, each.way.y)};
    const Vec2 along{std::fabs(out.y), std::fabs(out.x)};
    const double share = 1 / std::max({x, y, 1e-300}), aside = share * (isAside ? each.way.y : each.way.x);
    const Vec2 tip = sum(sum(middle, (isAside ? half.x : half.y) - 1, out), aside, along);
    bool isDrawn = false;
    for (int k = 0; k * kGap / 2 < kFarthest && !isDrawn; ++k) {
      const Vec2 at = sum(tip, (k % 2 == 0 ? -k : k + 1) * kGap / 2, along), base = sum(at, -kSize, out);
      const Vec2 left = sum(base, kHalfWidth, along), right = sum(base, -kHalfWidth, along);
      const Rect box = boundsOf({at, left, right});
      if (!holds(f, box) || sheet.labels.hasMark(box)) continue;
      isDrawn = true;
      sheet.addLine(Layer::marks, each.isBehind ? "out hollow" : "out", {at, left, right}, true);
      sheet.labels.addMark(box);
      sheet.explain(each.isBehind ? "behind: turn that way" : "outside");
      nameMark(drawing, {each.name, kOfOutside, rankOutside}, middleOf(box), kOfTriangle);
    }
    more += isDrawn ? 0 : 1;
  }
  const bool isAll = more == drawing.outside.size() + drawing.moreOutside;
  if (more > 0) drawing.notes.push_back(std::to_string(more) + (isAll ? " outside" : " more outside"));
}

}  // namespace viewproj::cmd
