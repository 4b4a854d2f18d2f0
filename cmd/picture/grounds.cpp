// Planes and the Earth: a tint, the horizon, and a grid of round numbers that thins out with distance.
#include <algorithm>
#include <numbers>
#include <set>

#include "camera/plain_camera.hpp"
#include "picture/drawing.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {
namespace {

constexpr double kDegrees = std::numbers::pi / 180;

/// The ground's width under a sixth of the picture, low in its middle column.
std::optional<double> widthBelow(const View& view, const Ground& ground) {
  const Rect& f = view.frame();
  for (const double share : {0.85, 0.7, 0.6, 0.5, 0.4, 0.25, 0.1, 0.03}) {
    const double y = f.top + share * (f.bottom - f.top), x = middleOf(f).x, side = (f.right - f.left) / 12;
    const auto a = pointUnder(view, ground, {x - side, y}), b = pointUnder(view, ground, {x + side, y});
    if (a && b) return apart(*a, *b);
  }
  return std::nullopt;
}

/// The places that the picture shows, if its rim shows nothing but the ground; else all that there are.
Rect placesInView(const Drawing& drawing, const Ground& ground) {
  std::vector<Vec2> seen;
  for (const Vec2& at : drawing.rim) {
    const auto point = pointUnder(drawing.view, ground, at);
    if (!point) return ground.extent;
    seen.push_back(sum(ground.foot, 1, ground.way(ground.foot, ground.placeOf(*point))));
  }
  constexpr double kMore = 0.5;  // of the size: meridians and parallels are bent between the corners
  const Rect box = boundsOf(seen), &all = ground.extent;
  const auto [left, top, right, bottom] = grown(box, kMore * largerSide(box));
  return {std::max(left, all.left), std::max(top, all.top), std::min(right, all.right), std::min(bottom, all.bottom)};
}

/// Lines of 1, 10 and 100 steps around the foot of the eye. They reach as far as the next one across the view is kGap
/// away on the sheet: step F h / r^2 = kGap. Returns the levels of which it draws a line other than 0.
std::set<int> drawGrid(const Drawing& drawing, const Ground& ground, const Vec2& foot, double step) {
  constexpr double kGap = 7, kReachOfParallel = 12, kOfGrid = 0.06, kShortest = 2, kLeastShare = 0.01;
  constexpr int kMostLevels = 3, kMostLines = 400, kSteps = 80;
  const View& view = drawing.view;
  const Projection projection = view.camera().projection();
  const double focal = (view.frame().right - view.frame().left) / (projection.right() - projection.left());
  const double height = std::fabs(ground.rise);
  const Rect shown = placesInView(drawing, ground);
  const Vec2 scale = ground.scaleAt(foot);
  // Of x, and of y.
  const double origins[] = {ground.origin.x, ground.origin.y}, feet[] = {foot.x, foot.y};
  const double sizes[] = {std::max(scale.x, kLeastShare * scale.y), scale.y};
  const double lows[] = {shown.left, shown.top}, highs[] = {shown.right, shown.bottom};
  std::set<int> drawn;
  int levels = 1;
  while (levels < kMostLevels && 6 * step * std::pow(10, levels) <= ground.extent.bottom - ground.extent.top) ++levels;
  for (int level = 0; level < levels; ++level) {
    const double s = step * std::pow(10, level);
    for (const std::size_t k : {0U, 1U}) {  // lines of one x, lines of one y
      const std::size_t other = 1 - k;
      const double reach =
          view.isParallel() ? kReachOfParallel * s * sizes[k] : std::sqrt(s * sizes[k] * focal * height / kGap);
      const double low = std::max(lows[k], feet[k] - reach / sizes[k]),
                   high = std::min(highs[k], feet[k] + reach / sizes[k]);
      const double first = std::ceil((low - origins[k]) / s), count = std::floor((high - origins[k]) / s) - first;
      if (!(count <= kMostLines)) continue;
      for (int i = 0; i <= count; ++i) {
        if (level + 1 < levels && std::fmod(first + i, 10) == 0) continue;
        const double line = origins[k] + (first + i) * s, off = (line - feet[k]) * sizes[k];
        const double half = std::sqrt(std::max(0.0, reach * reach - off * off)), away = std::hypot(height, off);
        const auto angleOf = [&](double end) { return std::atan((end - feet[other]) * sizes[other] / away); };
        const double widest = std::atan(half / away);
        const double from = std::max(-widest, angleOf(lows[other])), to = std::min(widest, angleOf(highs[other]));
        const auto at = [&](double t) {  // by equal angles at the eye
          const double along = feet[other] + away * std::tan(from + t * (to - from)) / sizes[other];
          return pointOf(ground.pointAt(k == 0 ? Vec2{line, along} : Vec2{along, line}));
        };
        for (const Piece& piece : piecesOf(view, at, kSteps, {Extent::anyDistance})) {
          if (piece.isHidden || distance(piece.line.front(), piece.line.back()) < kShortest) continue;
          drawing.sheet.addThin(Layer::grid, "grid g" + std::to_string(level), piece.line);
          drawing.sheet.labels.addInk(piece.line, kOfGrid);
          if (first + i != 0) drawn.insert(level);
        }
      }
    }
  }
  return drawn;
}

/// Ticks along the horizon of the Earth.
void drawAzimuths(const Drawing& drawing, const Ground& ground) {
  constexpr double kMost = 14, kAbove = 0.004, kTick = 6, kText = 15;
  constexpr const char* kNames[] = {"N", "NE", "E", "SE", "S", "SW", "W", "NW"};
  const View& view = drawing.view;
  const double span = view.camera().projection().fov(Fov::diagonal) / kMost;
  const double steps[] = {1, 2, 5, 10, 15, 30, 45, 90};
  const int step = static_cast<int>(*std::find_if(steps, std::end(steps) - 1, [&](double s) { return s >= span; }));
  for (int azimuth = 0; azimuth < 360; azimuth += step) {
    const double a = azimuth * kDegrees, elevation = ground.farthest(a, HUGE_VAL)->elevation;
    const auto place = view.place(directionOf(ground.direction(a, elevation)), Extent::anyDistance);
    const auto below = view.place(directionOf(ground.direction(a, elevation - kAbove)), Extent::anyDistance);
    if (!place || !below) continue;
    const Vec2 way = wayFrom(*place, *below), middle = sum(*place, kText, way);
    const std::string name = azimuth % 45 == 0 ? kNames[azimuth / 45] : std::to_string(azimuth) + "°";
    drawing.sheet.addLine(Layer::marks, "tick", {*place, sum(*place, kTick, way)});
    drawing.sheet.addText(Layer::marks, kOfAzimuth, {middle.x, middle.y + 4}, "middle", name);
    drawing.sheet.labels.addMark(around(middle, textWidth(name, kOfAzimuth) / 2 + 2, 8));
  }
}

/// The horizon, if the view has one, and a tint up to it. On the Earth with azimuths, where it is nearly level.
void drawHorizon(const Drawing& drawing, const Ground& ground) {
  constexpr int kFewest = 1440;  // a lens may show a corner of the frame little of it
  constexpr double kOfHorizon = 0.3, kLargestDip = 20 * kDegrees;
  const View& view = drawing.view;
  std::string text = "horizon";
  std::optional<Circle> circle;
  if (ground.isOnEarth) {
    const double a = kWgs84.equatorial + ground.height, b = kWgs84.polar + ground.height;
    circle = outlineOf(view, {{0, 0, 0}, a}, b / a);
  } else if (!view.isParallel()) {
    circle = horizonOf(view, ground.up);
  }
  if (ground.isOnEarth && !view.isParallel()) {
    const double heading = headingPitchRollOf(plainPose(view.camera().pose()), true).heading.value;
    const auto limit = ground.farthest(heading * kDegrees, HUGE_VAL);
    text += ", " + formatDigits(limit->distance / 1000, 3) + " km away, " +
            formatDigits(-limit->elevation / kDegrees, 3) + "° below level";
    if (-limit->elevation < kLargestDip) drawAzimuths(drawing, ground);
  }
  Pieces pieces;
  if (circle)
    pieces = piecesOf(view, *circle, std::max(kFewest, circle->steps(view)), {Extent::anyDistance, nullptr, false});
  for (const Piece& piece : pieces) {
    drawing.sheet.addThin(Layer::horizon, "horizon", piece.line);
    drawing.sheet.labels.addInk(piece.line, kOfHorizon);
    drawing.sheet.explain("horizon", text);
  }
  if (!drawing.sheet.hasPhoto)
    drawing.sheet.addFilled(Layer::land, "land", outlinesWithin(drawing.rim, joined(pieces), [&](const Vec2& at) {
                              return pointUnder(view, ground, at).has_value();
                            }));
}

/// What the lines of the grid are apart, the finest by a line of its own.
void explainGrid(const Drawing& drawing, const std::string& id, const std::set<int>& levels, double step,
                 const char* unit) {
  std::string coarse;
  for (const int level : levels) {
    const std::string apart = formatDigits(step * std::pow(10, level), 3) + unit;
    if (level == 0)
      drawing.sheet.explain("fine grid", id + ": grid of " + apart);
    else
      coarse += (coarse.empty() ? id + ": grid of " : " and ") + apart;
  }
  if (!coarse.empty()) drawing.sheet.explain("grid", coarse);
}

}  // namespace

std::optional<Vec3> pointUnder(const View& view, const Ground& ground, const Vec2& at) {
  const Ray ray = screenToRay(view.camera(), view.offSheet(at));
  auto seen = ground.hit(ray);
  if (!seen && view.isParallel()) seen = ground.hit({ray.origin, scaled(ray.direction, -1)});
  return seen ? std::optional(seen->point) : std::nullopt;
}

void drawGrounds(Drawing& drawing, const std::vector<NamedPoint>& withStems) {
  constexpr double kOfStem = 0.5;
  const View& view = drawing.view;
  bool isFirst = true;
  for (const SceneObject& shape : view.shapes()) {
    const auto ground = groundOf(shape, view.eye());
    if (!ground) continue;
    for (const NamedPoint& point : withStems) {
      const auto top = positionOf(point.point);
      if (!isFirst || !top || !view.place(point.point)) continue;
      const Vec3 below = ground->pointAt(ground->placeOf(*top));
      drawing.sheet.addPieces(piecesOf(view, *top, below), "stem", kOfStem);
      drawing.sheet.explain("down to the ground");
    }
    isFirst = false;
    const bool isUnder = ground->isOnEarth && ground->rise < 0;
    if (isUnder) drawing.notes.push_back("the eye is under " + shape.id);
    if (isUnder || (ground->holdsEye && !view.isParallel())) continue;
    drawHorizon(drawing, *ground);
    const auto width = widthBelow(view, *ground);
    if (!width) continue;
    const auto middle = view.isParallel() ? pointUnder(view, *ground, middleOf(view.frame())) : std::nullopt;
    const Vec2 foot = middle ? ground->placeOf(*middle) : ground->foot;
    const double largest = (ground->extent.bottom - ground->extent.top) / 6;
    const double step = std::min(largest, roundedDown(*width / ground->scaleAt(foot).y));
    explainGrid(drawing, shape.id, drawGrid(drawing, *ground, foot, step), step, ground->isOnEarth ? "°" : "");
  }
}

double roundedDown(double value) {
  const double power = std::pow(10, std::floor(std::log10(value)));
  for (const double digit : {5.0, 2.0})
    if (digit * power <= value * 1.0001) return digit * power;
  return power;
}

}  // namespace viewproj::cmd
