// Pictures of random points, taken apart: each mark lies where `project` says, in the picture's own frame.
#include <cmath>
#include <regex>

#include "catch.hpp"
#include "commands/picture.hpp"
#include "random.hpp"

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

}  // namespace

TEST_CASE("Points in view are drawn where they are seen, others are not, and outlines stay in the frame") {
  int drawn = 0, left = 0, balls = 0;
  for (unsigned trial = 0; trial < 200; ++trial) {
    Random random(trial);
    Viewport viewport{.width = random.uniform(100, 700), .height = random.uniform(100, 700)};
    if (trial % 3 == 0) viewport.x = random.uniform(-100, 100), viewport.y = random.uniform(-100, 100);
    if (trial % 2 == 0) viewport.origin = Origin::bottomLeft;
    const Camera camera = makeCamera(lookAt({0, 0, 9}, {0, 0, 0}, {0, 1, 0}, Handedness::right),
                                     perspective(50, viewport, 1, 30), viewport);
    Picture picture(camera);
    std::vector<Vec2> expected;
    for (int i = 0; i < 12; ++i) {
      const Vec4 point{random.uniform(-8, 8), random.uniform(-8, 8), random.uniform(-12, 12), 1};
      picture.add("p<" + std::to_string(i), point);
      const ScreenPoint p = worldToScreen(camera, point);
      p.visible() ? ++drawn : ++left;
      if (p.visible()) expected.push_back({p.x, p.y});
    }
    const Sphere ball{{random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-5, 5)}, random.uniform(1, 3)};
    picture.add("ball", ball);
    picture.add("box", Box{{-3, -1, -5}, {random.uniform(0, 4), 2, 12}});
    const std::string svg = picture.svg("a & b");
    CHECK(svg.find(">a &amp; b: ") != std::string::npos);
    const std::string frame = elements(svg, "<rect class=\"frame\"[^>]*>").at(0);
    const double x = attribute(frame, "x"), y = attribute(frame, "y");
    const double width = attribute(frame, "width"), height = attribute(frame, "height");
    const auto circles = elements(svg, "<circle[^>]*>");
    REQUIRE(circles.size() == expected.size());
    const Vec2 corner = pictureCorners(viewport).first;
    for (std::size_t i = 0; i < circles.size(); ++i) {
      const double across = (expected[i].x - corner.x) / viewport.width;
      const double down = (expected[i].y - corner.y) / viewport.height;
      CHECK(std::fabs(attribute(circles[i], "cx") - (x + across * width)) < 0.2);
      const double share = viewport.origin == Origin::topLeft ? down : 1 - down;
      CHECK(std::fabs(attribute(circles[i], "cy") - (y + share * height)) < 0.2);
    }
    const auto paths = elements(svg, "<path class=\"shape\"[^>]*>");
    REQUIRE(!paths.empty());  // the box is around the viewing axis
    const auto ends = [&](const std::string& path) {
      ScreenBox box{HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
      for (const std::string& place : elements(path, "[ML][-0-9.]+,[-0-9.]+")) {
        double px = 0, py = 0;
        REQUIRE(std::sscanf(place.c_str() + 1, "%lf,%lf", &px, &py) == 2);
        CHECK((px >= x - 0.2 && px <= x + width + 0.2 && py >= y - 0.2 && py <= y + height + 0.2));
        box = {std::min(box.left, px), std::min(box.top, py), std::max(box.right, px), std::max(box.bottom, py)};
      }
      return box;
    };
    CHECK(ends(paths.back()).right > ends(paths.back()).left);
    if (cull(viewFrustum(camera), ball).verdict != CullVerdict::inside) continue;
    // The outline of a ball touches the four sides of its box on the screen.
    ++balls;
    REQUIRE(paths.size() == 2);
    const ScreenBox drawnBall = ends(paths[0]), seen = *screenBox(camera, ball);
    const double scale = width / viewport.width;
    const auto top = [&](double screenY) {
      const double down = (screenY - corner.y) * scale;
      return y + (viewport.origin == Origin::topLeft ? down : height - down);
    };
    CHECK(std::fabs(drawnBall.left - (x + (seen.left - corner.x) * scale)) < 0.4);
    CHECK(std::fabs(drawnBall.right - (x + (seen.right - corner.x) * scale)) < 0.4);
    CHECK(std::fabs(drawnBall.top - top(seen.top)) < 0.4);
    CHECK(std::fabs(drawnBall.bottom - top(seen.bottom)) < 0.4);
  }
  CHECK(balls > 20);
  CHECK(drawn > 200);
  CHECK(left > 200);
}
