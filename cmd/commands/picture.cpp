#include "commands/picture.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "numbers/vectors.hpp"

namespace viewproj::cmd {
namespace {

// In units of the sheet, whose longer side is that of the picture.
constexpr double kLonger = 960, kTitle = 34, kMargin = 12;

constexpr const char* kStyle = R"(<style>
text { font: 15px sans-serif; fill: #222; paint-order: stroke; stroke: #fff; stroke-width: 4px; stroke-linejoin: round }
.frame { fill: none; stroke: #999; stroke-width: 1.5 }
.shape { fill: none; stroke: #5f7f9f; stroke-width: 1.5; stroke-linecap: round }
.of-shape { fill: #47617c; text-anchor: middle }
.point { fill: #1b63b5; stroke: #fff }
.pixel { fill: none; stroke: #c0392b; stroke-width: 2 }
.of-pixel { fill: #a5281b }
</style>
)";

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", value);
  return text;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  return out;
}

Vec3 sum(const Vec3& a, double k, const Vec3& b) { return {a.x + k * b.x, a.y + k * b.y, a.z + k * b.z}; }
Vec3 unit(const Vec3& a) { return sum({0, 0, 0}, 1 / std::hypot(a.x, a.y, a.z), a); }

}  // namespace

Picture::Picture(const Camera& camera)
    : camera_(camera), scale_(kLonger / std::max(camera.viewport().width, camera.viewport().height)) {
  if (!lensOf(camera)) frustum_ = viewFrustum(camera);
}

Vec2 Picture::onSheet(const Vec2& screen) const {
  const Viewport& v = camera().viewport();
  const Vec2 first = pictureCorners(v).first;
  const double y = (screen.y - first.y) * scale_;
  return {kMargin + (screen.x - first.x) * scale_, kTitle + (v.origin == Origin::topLeft ? y : v.height * scale_ - y)};
}

/// On the side where there is more room.
std::string Picture::textBeside(const Vec2& at, const std::string& label, const char* style) const {
  const bool toLeft = at.x > kMargin + 0.8 * scale_ * camera().viewport().width;
  return "<text" + std::string(style) + " x=\"" + number(at.x + (toLeft ? -8 : 8)) + "\" y=\"" + number(at.y + 5) +
         "\"" + (toLeft ? " text-anchor=\"end\"" : "") + ">" + escaped(label) + "</text>\n";
}

Vec2 Picture::placeOf(const Vec4& point) const {
  const ScreenPoint p = worldToScreen(camera_, point);
  return p.visible() ? onSheet({p.x, p.y}) : Vec2{NAN, NAN};
}

void Picture::add(const std::string& label, const Vec4& point) {
  ++added_;
  const Vec2 at = placeOf(point);
  if (std::isnan(at.x)) return;
  ++seen_;
  points_ += "<circle class=\"point\" cx=\"" + number(at.x) + "\" cy=\"" + number(at.y) + "\" r=\"4.5\"/>\n" +
             textBeside(at, label, "");
}

std::vector<Vec2> Picture::lineOf(const Vec3& a, const Vec3& b) const {
  if (!frustum_) return bentLineOf(a, b);
  const VisibleSegment piece = clipSegment(*frustum_, a, b);
  if (!piece.visible) return {};
  return {onSheet(piece.start.screen), onSheet(piece.end.screen)};
}

std::vector<Vec2> Picture::bentLineOf(const Vec3& a, const Vec3& b) const {
  constexpr int kPieces = 200, kHalvings = 20;
  const auto at = [&](double t) { return worldToScreen(camera_, pointAlong(a, b, t)); };
  std::vector<Vec2> line;
  const auto add = [&](const ScreenPoint& p) { line.push_back(onSheet({p.x, p.y})); };
  bool isVisible = false;
  for (int i = 0; i <= kPieces; ++i) {
    const double end = i / static_cast<double>(kPieces);
    const ScreenPoint p = at(end);
    if (i > 0 && p.visible() != isVisible) {  // where it enters or leaves the picture
      double in = p.visible() ? end : end - 1.0 / kPieces, out = p.visible() ? end - 1.0 / kPieces : end;
      for (int k = 0; k < kHalvings; ++k) (at((in + out) / 2).visible() ? in : out) = (in + out) / 2;
      if (p.visible() && !line.empty()) line.push_back({NAN, NAN});
      add(at(in));
    }
    if (p.visible()) add(p);
    isVisible = p.visible();
  }
  return line;
}

std::string Picture::pathOf(const std::vector<Vec2>& line) {
  std::string path;
  bool begins = true;
  for (const Vec2& at : line) {
    if (!std::isnan(at.x)) path += (begins ? "M" : "L") + number(at.x) + "," + number(at.y);
    begins = std::isnan(at.x);
  }
  return path;
}

void Picture::addPath(const std::string& label, const Vec2& middle, const std::string& path) {
  ++added_;
  if (path.empty()) return;
  ++seen_;
  shapes_ += "<path class=\"shape\" d=\"" + path + "\"/>\n";
  if (!std::isnan(middle.x))
    shapes_ += "<text class=\"of-shape\" x=\"" + number(middle.x) + "\" y=\"" + number(middle.y + 5) + "\">" +
               escaped(label) + "</text>\n";
}

void Picture::addRound(const std::string& label, const Vec3& middle, std::span<const Vec3> points) {
  std::string path;
  for (std::size_t i = 0; i < points.size(); ++i) path += pathOf(lineOf(points[i], points[(i + 1) % points.size()]));
  addPath(label, placeOf({middle.x, middle.y, middle.z, 1}), path);
}

void Picture::add(const std::string& label, const std::array<Vec3, 2>& segment) {
  const std::vector<Vec2> line = lineOf(segment[0], segment[1]);
  const Vec2 from = line.empty() ? Vec2{} : line.front(), to = line.empty() ? Vec2{} : line.back();
  addPath(label, {(from.x + to.x) / 2, (from.y + to.y) / 2}, pathOf(line));
}

void Picture::add(const std::string& label, const Triangle& t) {
  const Vec3 middle = sum(sum(sum({0, 0, 0}, 1 / 3.0, t.a), 1 / 3.0, t.b), 1 / 3.0, t.c);
  addRound(label, middle, std::array{t.a, t.b, t.c});
}

void Picture::add(const std::string& label, const Box& box) {
  const auto corner = [&](int i) {
    return Vec3{i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z};
  };
  const Vec3 middle = pointAlong(box.min, box.max, 0.5);
  std::string path;
  for (const int axis : {1, 2, 4})
    for (int i = 0; i < 8; ++i)
      if ((i & axis) == 0) path += pathOf(lineOf(corner(i), corner(i | axis)));
  addPath(label, placeOf({middle.x, middle.y, middle.z, 1}), path);
}

void Picture::add(const std::string& label, const Ellipsoid& ellipsoid) {
  addSilhouette(label, {{0, 0, 0}, ellipsoid.equatorial}, ellipsoid.polar / ellipsoid.equatorial);
}

void Picture::addSilhouette(const std::string& label, const Sphere& sphere, double stretch) {
  // Where rays from the eye touch the sphere: a circle across the way to its middle.
  const Pose pose = camera().pose();
  const Vec3 eye = pose.eye(), forward = pose.forward();
  const bool isParallel = camera().projection().isOrthographic();
  const Vec3 way = isParallel ? Vec3{forward.x, forward.y, forward.z / stretch}
                              : sum(sphere.center, -1, {eye.x, eye.y, eye.z / stretch});
  const double distance = std::hypot(way.x, way.y, way.z), share = isParallel ? 0 : sphere.radius / distance;
  if (!(share < 1)) return addPath(label, {}, "");  // the eye is within it
  const Vec3 axis = unit(way);
  const Vec3 other = std::fabs(axis.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 u = unit(detail::crossOf(axis, other)), v = detail::crossOf(axis, u);
  const Vec3 center = sum(sphere.center, -sphere.radius * share, axis);
  const double radius = sphere.radius * std::sqrt((1 - share) * (1 + share));
  // So many chords that none leaves the circle by more than a tenth of a unit.
  const double pixel = pixelSize(camera(), isParallel ? 1 : std::max(distance - sphere.radius, 1e-300)).x / scale_;
  const double chords = std::clamp(std::numbers::pi * std::sqrt(radius / pixel / 0.2), 24.0, 4000.0);
  std::vector<Vec3> points;
  for (int i = 0; i < chords; ++i) {
    const double angle = 2 * std::numbers::pi * i / std::ceil(chords);
    const Vec3 p = sum(sum(center, radius * std::cos(angle), u), radius * std::sin(angle), v);
    points.push_back({p.x, p.y, p.z * stretch});
  }
  addRound(label, {sphere.center.x, sphere.center.y, sphere.center.z * stretch}, points);
}

void Picture::addPixel(const std::string& label, const Vec2& pixel) {
  const Vec2 at = onSheet(pixel);
  pixels_ += "<path class=\"pixel\" d=\"M" + number(at.x - 7) + "," + number(at.y) + "h14M" + number(at.x) + "," +
             number(at.y - 7) + "v14\"/>\n" + textBeside(at, label, " class=\"of-pixel\"");
}

std::string Picture::svg(const std::string& title) const {
  const double width = camera().viewport().width * scale_, height = camera().viewport().height * scale_;
  const std::string seen =
      added_ == 0 ? "" : ": " + std::to_string(seen_) + " of " + std::to_string(added_) + " in view";
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + number(width + 2 * kMargin) + " " +
         number(height + kTitle + kMargin) + "\">\n<title>What the camera sees</title>\n" + kStyle +
         "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n<rect class=\"frame\" x=\"" + number(kMargin) +
         "\" y=\"" + number(kTitle) + "\" width=\"" + number(width) + "\" height=\"" + number(height) + "\"/>\n" +
         "<text x=\"" + number(kMargin) + "\" y=\"23\">" + escaped(title + seen) + "</text>\n" + shapes_ + points_ +
         pixels_ + "</svg>\n";
}

}  // namespace viewproj::cmd
