// Pictures, taken apart: each mark lies where `project` says, in the picture's own frame, and names meet nothing.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <regex>
#include <sstream>

#include "catch.hpp"
#include "picture/flat.hpp"
#include "picture/ground.hpp"
#include "picture/picture.hpp"
#include "picture/rim.hpp"
#include "picture/sphere_tree.hpp"
#include "random.hpp"
#include "viewproj/geodesy.hpp"
#include "viewproj/lens.hpp"

using namespace viewproj;
using namespace viewproj::cmd;

namespace {

double attribute(const std::string& element, const std::string& name) {
  std::smatch match;
  REQUIRE(std::regex_search(element, match, std::regex(" " + name + "=\"([^\"]*)\"")));
  return std::stod(match[1]);
}

std::vector<std::string> elements(const std::string& svg, const std::string& pattern) {
  std::vector<std::string> found;
  const std::regex expression(pattern);
  for (std::sregex_iterator at(svg.begin(), svg.end(), expression), end; at != end; ++at) found.push_back(at->str());
  return found;
}

ScreenBox frameOf(const std::string& svg) {
  const std::string frame = elements(svg, "<rect class=\"frame\"[^>]*>").at(0);
  const double x = attribute(frame, "x"), y = attribute(frame, "y");
  return {x, y, x + attribute(frame, "width"), y + attribute(frame, "height")};
}

std::vector<Vec2> placesIn(const std::string& line) {
  std::vector<Vec2> places;
  for (const std::string& place : elements(line, "[ML][-0-9.]+,[-0-9.]+")) {
    Vec2 at;
    REQUIRE(std::sscanf(place.c_str() + 1, "%lf,%lf", &at.x, &at.y) == 2);
    places.push_back(at);
  }
  return places;
}

/// Lines of a style that are drawn, not those of the legend. Each begins with an M.
std::vector<std::vector<Vec2>> linesOf(const std::string& svg, const std::string& style) {
  std::vector<std::vector<Vec2>> lines;
  for (const std::string& path :
       elements(svg.substr(0, svg.find("class=\"frame\"")), "<path class=\"" + style + "\"[^>]*>"))
    for (const std::string& line : elements(path, "M[^M\"]*")) lines.push_back(placesIn(line));
  return lines;
}

std::vector<std::string> dotsOf(const std::string& svg) {
  return elements(svg, "<circle class=\"dot[^>]* cx=\"[^>]* cy=[^>]*>");
}

ScreenBox boundsOf(const std::vector<std::vector<Vec2>>& lines) {
  ScreenBox box{HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  for (const auto& line : lines)
    for (const Vec2& p : line)
      box = {std::min(box.left, p.x), std::min(box.top, p.y), std::max(box.right, p.x), std::max(box.bottom, p.y)};
  return box;
}

// Thousandths of an em of the characters from space to tilde, in DejaVu Sans and DejaVu Sans Bold.
// clang-format off
constexpr int kPlain[] = {318,401,460,838,636,950,780,275,390,390,500,838,318,361,318,337,636,636,636,636,636,636,636,636,636,636,337,337,838,838,838,531,1000,684,686,698,770,632,575,775,752,295,295,656,557,863,748,787,603,787,695,635,611,732,684,989,685,611,685,390,337,390,838,500,500,613,635,550,635,615,352,635,634,278,278,579,278,974,634,612,635,635,411,521,392,634,592,818,592,592,525,636,337,636,838};
constexpr int kBold[] = {348,456,521,838,696,1002,872,306,457,457,523,838,380,415,380,365,696,696,696,696,696,696,696,696,696,696,400,400,838,838,838,580,1000,774,762,734,830,683,683,821,837,372,372,775,637,995,837,850,733,850,770,720,682,812,774,1103,771,724,725,457,365,457,838,500,500,675,716,593,716,678,435,716,712,343,343,665,343,1042,712,687,716,716,493,595,478,712,652,924,645,652,582,712,365,712,838};
// clang-format on

double widthOf(const std::string& text, double size, bool isBold) {
  double width = 0;
  for (const char c : text) {
    REQUIRE((c >= ' ' && c <= '~'));
    width += (isBold ? kBold : kPlain)[c - ' '] * size / 1000;
  }
  return width;
}

/// Boxes of the names, and of the dots; fails where two meet. Returns how many names there are.
std::size_t requireApart(const std::string& svg) {
  struct Named {
    std::string text;
    ScreenBox box;
  };
  std::vector<Named> all;
  const std::regex parts("class=\"(of-[a-z]+)[^>]*>([^<]*)(<tspan[^>]*>([^<]*)</tspan>)?");
  for (const std::string& text : elements(svg, "<text class=\"of-[^>]*>[^<]*(<tspan[^>]*>[^<]*</tspan>)?</text>")) {
    std::smatch match;
    REQUIRE(std::regex_search(text, match, parts));
    const bool isBold = match[1] == "of-dot" || match[1] == "of-cross";
    const double size = match[1] == "of-out" || match[1] == "of-pixel" ? 13 : 14;
    const std::string note = match[4];
    const double width = widthOf(match[2], size, isBold) + (note.empty() ? 0 : 5 + widthOf(note, size, false));
    const double x = attribute(text, "x"), y = attribute(text, "y");
    // From the tops of capitals to the ends of letters such as g.
    all.push_back({match[2], {x - width / 2, y - 0.73 * size, x + width / 2, y + 0.21 * size}});
  }
  const std::size_t names = all.size();
  for (const std::string& dot : dotsOf(svg)) {
    const double x = attribute(dot, "cx"), y = attribute(dot, "cy"), r = attribute(dot, "r");
    all.push_back({"a dot", {x - r, y - r, x + r, y + r}});
  }
  const ScreenBox frame = frameOf(svg);
  for (std::size_t i = 0; i < names; ++i) {
    const ScreenBox& a = all[i].box;
    INFO(all[i].text);
    CHECK((a.left >= frame.left && a.right <= frame.right && a.top >= frame.top && a.bottom <= frame.bottom));
    for (std::size_t j = i + 1; j < all.size(); ++j) {
      const ScreenBox& b = all[j].box;
      INFO(all[j].text);
      CHECK_FALSE((a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom));
    }
  }
  return names;
}

Camera lookingAlongZ(const Viewport& viewport, double fov = 50) {
  return makeCamera(lookAt({0, 0, 9}, {0, 0, 0}, {0, 1, 0}, Handedness::right), perspective(fov, viewport, 1, 30),
                    viewport);
}

}  // namespace

TEST_CASE("Points in view are drawn where they are seen, others are not, and outlines stay in the frame") {
  int drawn = 0, left = 0, balls = 0;
  for (unsigned trial = 0; trial < 200; ++trial) {
    Random random(trial);
    Viewport viewport{.width = random.uniform(100, 700), .height = random.uniform(100, 700)};
    if (trial % 3 == 0) viewport.x = random.uniform(-100, 100), viewport.y = random.uniform(-100, 100);
    if (trial % 2 == 0) viewport.origin = Origin::bottomLeft;
    const Camera camera = lookingAlongZ(viewport);
    PictureContent content{.title = "a & b"};
    std::vector<Vec2> expected;
    for (int i = 0; i < 12; ++i) {
      const Vec4 point{random.uniform(-8, 8), random.uniform(-8, 8), random.uniform(-12, 12), 1};
      content.points.push_back({"p" + std::to_string(i), "", point});
      const ScreenPoint p = worldToScreen(camera, point);
      // What is nearer than near or beyond far is hollow, and still where it is.
      const bool isDrawn = p.status == PointStatus::inFront && (p.outside & ~(sideNear | sideFar)) == 0;
      isDrawn ? ++drawn : ++left;
      if (isDrawn) expected.push_back({p.x, p.y});
    }
    content.shapes.push_back({"box", Box{{-3, -1, -5}, {random.uniform(0, 4), 2, 12}}});
    const std::string svg = pictureOf(camera, content);
    CHECK(svg.find(">a &amp; b<") != std::string::npos);
    const double scale = 960 / std::max(viewport.width, viewport.height);
    ScreenBox frame = frameOf(svg);  // its size is rounded
    frame.right = frame.left + viewport.width * scale;
    frame.bottom = frame.top + viewport.height * scale;
    const Vec2 corner = pictureCorners(viewport).first;
    const auto onSheet = [&](const Vec2& screen) {
      const double y = (screen.y - corner.y) * scale;
      return Vec2{frame.left + (screen.x - corner.x) * scale,
                  viewport.origin == Origin::topLeft ? frame.top + y : frame.bottom - y};
    };
    const auto dots = dotsOf(svg);
    REQUIRE(dots.size() == expected.size());
    for (std::size_t i = 0; i < dots.size(); ++i) {
      CHECK(std::fabs(attribute(dots[i], "cx") - onSheet(expected[i]).x) < 0.1);
      CHECK(std::fabs(attribute(dots[i], "cy") - onSheet(expected[i]).y) < 0.1);
    }
    const ScreenBox box = boundsOf(linesOf(svg, "edge"));  // around the viewing axis
    CHECK(box.right > box.left);
    CHECK((box.left >= frame.left - 0.1 && box.right <= frame.right + 0.1 && box.top >= frame.top - 0.1 &&
           box.bottom <= frame.bottom + 0.1));
    // The outline of a ball touches the four sides of its box on the screen.
    const Sphere ball{{random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-5, 5)}, random.uniform(1, 3)};
    if (cull(viewFrustum(camera), ball).verdict != CullVerdict::inside) continue;
    ++balls;
    const auto outline = linesOf(pictureOf(camera, {.title = "", .shapes = {{"ball", ball}}}), "edge");
    REQUIRE(outline.size() == 1);
    const ScreenBox seen = *screenBox(camera, ball), drawnBall = boundsOf(outline);
    const Vec2 first = onSheet({seen.left, seen.top}), last = onSheet({seen.right, seen.bottom});
    CHECK(std::fabs(drawnBall.left - first.x) < 0.2);
    CHECK(std::fabs(drawnBall.right - last.x) < 0.2);
    CHECK(std::fabs(drawnBall.top - first.y) < 0.2);
    CHECK(std::fabs(drawnBall.bottom - last.y) < 0.2);
  }
  CHECK(balls > 20);
  CHECK(drawn > 200);
  CHECK(left > 200);
}

TEST_CASE("A line is dashed where a ball hides it, from tangent to tangent") {
  // The tangents from the eye to the ball are asin(1/4) off the axis; at distance 8 that is 8 tan(asin(1/4)).
  const Viewport viewport{.width = 960, .height = 480};
  const Camera camera =
      makeCamera(lookAt({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, Handedness::right), perspective(60, viewport, 0), viewport);
  const std::string svg =
      pictureOf(camera, {.title = "",
                         .shapes = {{"ball", Sphere{{0, 0, -4}, 1}}},
                         .segments = {{"line", {-4, 0, -8}, {4, 0, -8}}, {"before", {-4, 0, -2}, {4, 0, -2}}}});
  const ScreenBox frame = frameOf(svg);
  const double focal = 240 / std::tan(30 * 3.14159265358979 / 180), middle = (frame.left + frame.right) / 2;
  const auto hidden = linesOf(svg, "edge hid");
  REQUIRE(hidden.size() == 1);
  CHECK(std::fabs(hidden[0].front().x - (middle - focal * std::tan(std::asin(0.25)))) < 0.1);
  CHECK(std::fabs(hidden[0].back().x - (middle + focal * std::tan(std::asin(0.25)))) < 0.1);
}

TEST_CASE("Through a lens a line follows its true curve, also where it passes behind the camera") {
  // A fisheye that sees all but straight behind: there the picture of a line swings from one side to the other.
  const Viewport viewport{.width = 1000, .height = 1000};
  const Pose pose = lookAt({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, Handedness::right);
  int lines = 0;
  for (unsigned trial = 0; trial < 60; ++trial) {
    Random random(trial);
    const double limit = trial % 2 == 0 ? 180 : random.uniform(100, 170);
    const Camera camera = withLens(
        makeCamera(pose, intrinsics(155, 155, 500, 500, viewport, 0, kInfiniteFar), viewport), fisheyeLens({}, limit));
    const double height = random.logUniform(1e-3, 1) * random.sign();
    const Vec3 a{-random.uniform(2, 9), height, 3}, b{random.uniform(2, 9), height, random.uniform(1, 3)};
    const std::string svg = pictureOf(camera, {.title = "", .segments = {{"line", a, b}}});
    const ScreenBox frame = frameOf(svg);
    const double scale = (frame.right - frame.left) / viewport.width;
    // Close together where it swings, at x = 0.
    std::vector<Vec2> curve;
    const double behind = -a.x / (b.x - a.x);
    for (const double side : {-1.0, 1.0})
      for (int i = 0; i <= 20'000; ++i) {
        const double t = behind + side * std::pow(10, -8 + i / 2500.0);
        if (t < 0 || t > 1) continue;
        const ScreenPoint s = worldToScreen(camera, pointAlong(a, b, t), Precision::standard);
        if (s.visible()) curve.push_back({frame.left + s.x * scale, frame.top + s.y * scale});
      }
    for (const auto& line : linesOf(svg, "edge"))
      for (std::size_t i = 1; i < line.size(); ++i) {
        ++lines;
        const Vec2 middle{(line[i - 1].x + line[i].x) / 2, (line[i - 1].y + line[i].y) / 2};
        double least = HUGE_VAL;
        for (const Vec2& p : curve) least = std::min(least, std::hypot(p.x - middle.x, p.y - middle.y));
        CHECK(least < 0.6);
      }
  }
  CHECK(lines > 500);
}

TEST_CASE("Land is exactly where a ray hits the ground, through any lens and from any pose") {
  const Viewport viewport{.width = 960, .height = 720};
  const auto through = [&](const Pose& pose, double focal, const Lens& lens) {
    return withLens(makeCamera(pose, intrinsics(focal, focal, 480, 360, viewport, 0, kInfiniteFar), viewport), lens);
  };
  int land = 0, sky = 0;
  for (unsigned trial = 3; trial < 60; trial += 5) {
    Random random(trial);
    const bool isOnEarth = trial % 2 == 0;
    const double height = random.logUniform(1, isOnEarth ? 1e7 : 100);
    const Vec3 eye{isOnEarth ? kWgs84.equatorial + height : 0, 0, isOnEarth ? 0 : height};
    // Near the horizon; every third camera looks straight up or down.
    const Vec3 way{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-0.5, 0.5)};
    const Vec3 away = isOnEarth ? Vec3{1, 0, 0} : Vec3{0, 0, 1};
    const Pose pose =
        lookAlong(eye, trial % 3 > 0 ? way : away,
                  {0.3 * random.uniform(-1, 1) + (isOnEarth ? 1 : 0.1), 0.2, isOnEarth ? 0.1 : 1.0}, Handedness::right);
    const Camera cameras[] = {
        makeCamera(pose, perspective(random.uniform(20, 110), viewport, 0), viewport),
        through(pose, random.uniform(300, 600), brownLens({-0.25, 0.05, 0})),
        through(pose, random.uniform(120, 400), fisheyeLens({})),
        through(pose, random.uniform(200, 400), fisheyeLens({}, random.uniform(50, 90))),
    };
    const double surface = isOnEarth ? random.uniform(-10, 0.5) : 0;
    const SceneObject ground{"ground", isOnEarth ? decltype(SceneObject::shape)(HeightSurface{surface})
                                                 : decltype(SceneObject::shape)(Plane{{0, 0, 0}, {0, 0, 1}})};
    for (const Camera& camera : cameras) {
      const std::string svg = pictureOf(camera, {.title = "", .worldIsEcef = isOnEarth, .shapes = {ground}});
      const auto rings = linesOf(svg, "land");
      const ScreenBox frame = frameOf(svg);
      INFO("trial " << trial << ", camera " << &camera - cameras);
      for (double x = 7; x < 960; x += 31)
        for (double y = 5; y < 720; y += 29) {
          const Vec2 at{frame.left + x, frame.top + y};
          const Ray ray = screenToRay(camera, {x, y});
          const bool hits = std::isfinite(ray.direction.x) && hitsOf(ray, ground).count > 0;
          bool isLand = false;
          double toEdge = HUGE_VAL;
          for (const auto& ring : rings)
            for (std::size_t i = 0; i < ring.size(); ++i) {
              const Vec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
              toEdge = std::min(toEdge, distanceToSegment(at, a, b));
              if ((a.y > at.y) != (b.y > at.y) && a.x + (b.x - a.x) * (at.y - a.y) / (b.y - a.y) > at.x)
                isLand = !isLand;
            }
          if (toEdge < 0.5) continue;
          ++(hits ? land : sky);
          if (isLand != hits) FAIL_CHECK("at " << x << ", " << y << " a ray says " << hits);
        }
    }
  }
  CHECK(land > 3'000);
  CHECK(sky > 3'000);
}

TEST_CASE("No two names meet, and no name and dot, in a crowd and in the samples' pictures") {
  const Viewport viewport{.width = 1920, .height = 1080};
  const Camera camera = lookingAlongZ(viewport);
  std::size_t names = 0;
  for (unsigned trial = 0; trial < 4; ++trial) {
    Random random(trial);
    PictureContent content{.title = ""};
    for (int i = 0; i < 15 << 2 * trial; ++i) {
      const std::string name = "Wy" + std::string(random.below(9), 'm') + std::to_string(i);
      content.points.push_back({name,
                                random.coin() ? "1.5 m" : "",
                                {random.uniform(-9, 9), random.uniform(-5, 5), random.uniform(-9, 5), 1}});
    }
    content.shapes.push_back({"a box", Box{{-2, -1, -1}, {1, 1, 1}}});
    content.shapes.push_back({"ground", Plane{{0, -2, 0}, {0, 1, 0}}});
    content.segments.push_back({"a line", {-3, 1, 0}, {3, -1, 2}});
    content.pixels = {{700, 500}, {900, 900}};
    const std::string svg = pictureOf(camera, content);
    names += requireApart(svg);
    CHECK(svg == pictureOf(camera, content));
  }
  CHECK(names > 60);
  std::size_t pictures = 0;
  for (const auto& sample : std::filesystem::directory_iterator(VIEWPROJ_SAMPLES)) {
    std::ifstream file(sample.path() / "view.svg");
    if (!file) continue;
    ++pictures;
    std::stringstream text;
    text << file.rdbuf();
    INFO(sample.path().string());
    CHECK(requireApart(text.str()) > 2);
  }
  CHECK(pictures >= 5);
}

TEST_CASE("The grid of a plane whose coordinates are beyond whole doubles ends") {
  const Viewport viewport{.width = 2, .height = 1};
  const Camera camera = makeCamera(lookAlong({0, 4, -3}, {0.8, -0.3, -0.6}, {0, 1, 0}, Handedness::right),
                                   orthographicHeight(0.001, viewport, -100, 100), viewport);
  const Plane plane{{-9, 1e45, 4}, {-2.6, 5e-324, 9.2}};
  CHECK(pictureOf(camera, {.title = "", .shapes = {{"far", plane}}}).ends_with("</svg>\n"));
}

TEST_CASE("The rim of a picture is its edge, and the end of the lens where that comes before") {
  const Viewport viewport{.width = 640, .height = 480};
  const Lens lenses[] = {brownLens({-0.5}),
                         brownLens({2e-4, 1e-4}, {-0.283, 0.0739}),
                         brownLens({0.1}, {}, 0.5),
                         fisheyeLens({0, 0, 0, 0}),
                         fisheyeLens({-0.1, 0, 0, 0}),
                         unifiedLens(0.6),
                         doubleSphereLens(-0.2, 0.55),
                         omniLens(1.5, {-0.1, 0.01}, {0.001, 0.002}),
                         fovLens(0.9)};
  int drawnIn = 0, seen = 0, blind = 0;
  for (const Lens& lens : lenses)
    for (const double focal : {150.0, 400.0})
      for (const Vec2& principal : {Vec2{320, 240}, Vec2{100, 400}, Vec2{-200, 240}, Vec2{900, -300}}) {
        const Projection file = intrinsics(focal, 1.3 * focal, principal.x, principal.y, viewport, 0, kInfiniteFar);
        const Pose pose = lookAlong({3, 1, 2}, {0.3, -0.5, -1}, {0, 1, 0.2}, Handedness::right);
        const Camera camera = withLens(makeCamera(pose, calibrated(file, lens), viewport), lens);
        const Rim rim(camera);
        const double widest = lens.model() == LensModel::brown ? 90 : 180;
        const double end = std::min(lens.limitDegrees(), widest) * std::numbers::pi / 180;
        const Vec2 inmost{std::clamp(principal.x, 0.0, 640.0), std::clamp(principal.y, 0.0, 480.0)};
        for (int i = 0; i < 400; ++i) {
          const double s = i / 100.0;
          const int side = i / 100;
          const Vec2 edge = between(rim.corner(side), rim.corner(side + 1), s - side);
          const bool hasRay = std::isfinite(screenToRay(camera, edge).direction.x);
          const Rim::Place place = rim.at(s);
          INFO("lens " << &lens - lenses << ", focal length " << focal << ", s " << s);
          if (!std::isfinite(place.ray.direction.x)) {
            ++blind;
            CHECK(!hasRay);
            continue;
          }
          CHECK(place.isDrawnIn != hasRay);
          ++(place.isDrawnIn ? drawnIn : seen);
          if (!place.isDrawnIn) continue;
          const Vec3 &way = place.ray.direction, forward = pose.forward();
          const double cosine = way.x * forward.x + way.y * forward.y + way.z * forward.z;
          CHECK(std::acos(std::clamp(cosine, -1.0, 1.0)) == Approx(end).margin(1e-7));
          CHECK(distanceToSegment(place.pixel, inmost, edge) < 1e-9);
          const ScreenPoint back = worldToScreen(camera, Vec4{way.x, way.y, way.z, 0});
          if (end < 3) CHECK(distance({back.x, back.y}, place.pixel) < 1e-6);
        }
      }
  CHECK(std::min({drawnIn, seen, blind}) > 2000);
}

TEST_CASE("A tree of spheres forgets none that a ray hits, and asks few") {
  std::size_t hits = 0, asked = 0, rays = 0;
  for (unsigned trial = 0; trial < 100; ++trial) {
    Random random(trial);
    const auto somewhere = [&](double size) {
      return Vec3{random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
    };
    std::vector<Sphere> spheres;
    for (unsigned i = 0; i < 3 * trial; ++i) spheres.push_back({somewhere(10), random.uniform(0, 0.5)});
    if (trial % 7 == 6) spheres.push_back({{}, HUGE_VAL});
    const SphereTree tree(spheres);
    for (int k = 0; k < 20; ++k, ++rays) {
      const Vec3 from = somewhere(k % 2 == 0 ? 12 : 300), to = somewhere(10);
      const double away = std::hypot(to.x - from.x, to.y - from.y, to.z - from.z);
      const Ray ray{from, {(to.x - from.x) / away, (to.y - from.y) / away, (to.z - from.z) / away}};
      const double farthest = k % 3 == 0 ? HUGE_VAL : away;
      std::vector<bool> isAsked(spheres.size());
      CHECK_FALSE(tree.any(ray, farthest, [&](std::size_t i) {
        CHECK(!isAsked[i]);
        isAsked[i] = true;
        ++asked;
        return false;
      }));
      for (std::size_t i = 0; i < spheres.size(); ++i) {
        const Hits found = std::isfinite(spheres[i].radius) ? intersect(ray, spheres[i]) : Hits{};
        const bool isHit = !std::isfinite(spheres[i].radius) || (found.count > 0 && found.hits[0].distance <= farthest);
        hits += isHit;
        if (isHit) CHECK(isAsked[i]);
      }
    }
  }
  CHECK(hits > 300);
  CHECK(asked < 3 * hits + rays);
}
