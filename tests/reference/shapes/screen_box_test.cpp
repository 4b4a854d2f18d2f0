// The rectangle that a sphere, a box or a triangle takes on the screen, against 480 bits: of a sphere the planes
// through the eye that touch it, by the quadratic of their slope, and the circle that near cuts.

#include <algorithm>
#include <map>
#include <optional>
#include <vector>

#include "catch.hpp"
#include "internals.hpp"
#include "reference/scene.hpp"
#include "viewproj/scene.hpp"

using namespace viewproj;
using namespace viewproj::detail;
using namespace reference;

namespace {

struct TrueRange {
  std::optional<Real> least, most;

  void add(const Real& value) {
    if (!least || value < *least) least = value;
    if (!most || value > *most) most = value;
  }
};

/// Of a sphere along a row of the camera, over W in perspective.
TrueRange rangeOf(const Truth& truth, const Real3& row, const Sphere& sphere) {
  const Real3 f = truth.pose.forward, d = toReal(sphere.center) - truth.pose.eye;
  const Real radius = sphere.radius, near = truth.scene.near;
  const Real x = dot(row, d), w = dot(f, d), rr = dot(row, row), rf = dot(row, f), ff = dot(f, f);
  TrueRange range;
  const auto addFrom = [&](const Real3& p) {
    const Real along = dot(f, p);
    if (!(along < near)) range.add(truth.lens.orthographic ? dot(row, p) : dot(row, p) / along);
  };
  if (truth.lens.orthographic) {
    const Real3 reach = row * (radius / sqrt(rr));
    addFrom(d + reach);
    addFrom(d - reach);
  } else {
    const Real a = w * w - radius * radius * ff, b = x * w - radius * radius * rf, c = x * x - radius * radius * rr;
    const Real discriminant = sphere.radius > 0 ? b * b - a * c : Real(0);
    if (!(discriminant < Real(0)))
      for (const Real& root : {sqrt(discriminant), -sqrt(discriminant)}) {
        const Real3 normal = row - f * ((b + root) / a);
        addFrom(d - normal * (dot(normal, d) / dot(normal, normal)));
      }
  }
  const Real beyond = near - w, half = radius * radius - beyond * beyond / ff;
  if (!(half < Real(0))) {
    const Real3 middle = d + f * (beyond / ff), across = row - f * (rf / ff);
    const Real3 reach = across * sqrt(half / dot(across, across));
    const Real scale = truth.lens.orthographic ? Real(1) : near;
    range.add(dot(row, middle + reach) / scale);
    range.add(dot(row, middle - reach) / scale);
  }
  return range;
}

struct TrueBox {
  TrueRange x, y;  ///< right and up, over W in perspective
};

TrueBox boxOf(const Truth& truth, const std::vector<Vec3>& corners, bool (*isEdge)(std::size_t)) {
  TrueBox box;
  const Real near = truth.scene.near;
  const auto add = [&](const Truth::View& v) {
    const Real scale = truth.lens.orthographic ? Real(1) : v.forward;
    box.x.add(v.right / scale);
    box.y.add(v.up / scale);
  };
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Truth::View a = truth.view(toReal(corners[i]));
    if (!(a.forward < near)) add(a);
    for (std::size_t j = 0; j < i; ++j) {
      const Truth::View b = truth.view(toReal(corners[j]));
      if (!isEdge(i ^ j) || (a.forward < near) == (b.forward < near)) continue;
      const Real t = (near - a.forward) / (b.forward - a.forward);
      add({a.right + (b.right - a.right) * t, a.up + (b.up - a.up) * t, near});
    }
  }
  return box;
}

/// The largest error over what is allowed, 1 being kScreenBoxBound of what it is relative to.
double shareOf(const Truth& truth, const ScreenBox& got, const TrueBox& box) {
  const auto at = [&](const Real& right, const Real& up) { return truth.screen({right, up, Real(1)}); };
  const Truth::Screen lower = at(*box.x.least, *box.y.least), upper = at(*box.x.most, *box.y.most);
  const Viewport& v = truth.scene.viewport;
  const auto share = [&](double number, const Real& exact, double start, double size) {
    const double all = size + std::fabs(start) + std::fabs(double(exact));
    return double(abs(Real(number) - exact)) / (kScreenBoxBound * all);
  };
  return std::max({share(got.left, lower.x, v.x, v.width), share(got.right, upper.x, v.x, v.width),
                   share(got.top, upper.y, v.y, v.height), share(got.bottom, lower.y, v.y, v.height)});
}

/// About the picture, before or behind the eye, near or far.
Vec3 somewhere(Random& random, const Truth& truth, const Vec3& eye, double behind = 0.2) {
  Vec3 p = pointInView(random, truth, random.chance(0.5) ? 1 : 4);
  if (random.chance(behind))
    for (std::size_t i = 0; i < 3; ++i) p[i] = 2 * eye[i] - p[i];
  return p;
}

struct World {
  Scene scene;
  Truth truth;
  Frustum frustum;
  Vec3 eye;

  explicit World(const Scene& s) : scene(s), truth(s), frustum(viewFrustum(build(s))), eye(s.position) {
    for (std::size_t i = 0; i < 3; ++i) eye[i] = double(truth.pose.eye[i]);
  }
};

World randomWorld(Random& random) {
  Scene scene = randomScene(random, random.logUniform(1e-3, 1e6));
  scene.shiftX = scene.shiftY = 0;
  scene.hasCrop = false;
  return World(scene);
}

}  // namespace

TEST_CASE("The rectangle of a sphere on the screen holds it and no more, to within the bound") {
  std::map<std::string, int> visited;
  double worst = 0, worstNextTo = 0;
  for (std::uint64_t trial = 0; trial < 20000; ++trial) {
    Random random(trial + 90000000);
    const World w = randomWorld(random);
    const Vec3 center = somewhere(random, w.truth, w.eye);
    const Real3 d = toReal(center) - w.truth.pose.eye;
    const Real3 forward = w.truth.pose.forward;
    const double distance = double(length(d));
    const double before = double((dot(forward, d) - Real(w.scene.near)) / length(forward));
    Sphere sphere{center, distance * random.logUniform(1e-6, 4)};
    if (random.chance(0.2)) sphere.radius = std::fabs(before) * (1 + random.uniform(-1e-3, 1e-3));
    if (random.chance(0.1)) sphere.radius = distance * (1 + random.sign() * random.logUniform(1e-8, 1e-3));
    if (random.chance(0.05)) sphere.radius = 0;
    INFO("trial " << trial << ": " << describe(w.scene) << ", radius " << sphere.radius << " at " << distance);
    const auto got = screenBox(w.frustum.camera(), sphere);
    const TrueBox truth{rangeOf(w.truth, w.truth.pose.right, sphere), rangeOf(w.truth, w.truth.pose.up, sphere)};
    const double margin = (before + sphere.radius) / (distance + std::fabs(w.scene.near));
    if (std::fabs(margin) < 1e-12) continue;
    REQUIRE(got.has_value() == (margin > 0));
    const bool cut = before < sphere.radius;
    if (!got) {
      ++visited["behind"];
      continue;
    }
    ++visited[std::string(w.truth.lens.orthographic ? "orthographic" : "perspective") + (cut ? " cut" : "") +
              (sphere.radius > distance ? " around the eye" : "")];
    const double nextTo = std::fabs(distance - sphere.radius) / (distance + sphere.radius);
    const double share = shareOf(w.truth, *got, truth);
    CHECK(share <= 1);
    double& largest = nextTo < 1e-3 ? worstNextTo : worst;
    largest = std::max(largest, share);
  }
  for (const char* kind : {"behind", "perspective", "perspective cut", "perspective cut around the eye", "orthographic",
                           "orthographic cut", "orthographic cut around the eye"})
    CHECK(visited[kind] > 100);
  WARN("largest share of the bound: " << worst << ", next to the eye " << worstNextTo);
}

TEST_CASE("The rectangles of a box and a triangle hold what is in front of near and no more, to within the bound") {
  std::map<std::string, int> visited;
  double worst = 0;
  for (std::uint64_t trial = 0; trial < 20000; ++trial) {
    Random random(trial + 95000000);
    const World w = randomWorld(random);
    const double behind = random.chance(0.1) ? 1 : 0.2;
    const Vec3 a = somewhere(random, w.truth, w.eye, behind), b = somewhere(random, w.truth, w.eye, behind),
               c = somewhere(random, w.truth, w.eye, behind);
    INFO("trial " << trial << ": " << describe(w.scene));
    const bool isBox = random.chance(0.6);
    std::optional<ScreenBox> got;
    TrueBox truth;
    int inFront = 0;
    std::vector<Vec3> corners = {a, b, c};
    if (isBox) {
      Box box{};
      for (std::size_t i = 0; i < 3; ++i) box.min[i] = std::min(a[i], b[i]), box.max[i] = std::max(a[i], b[i]);
      if (random.chance(0.1)) box.max.z = box.min.z;
      got = screenBox(w.frustum.camera(), box);
      corners.clear();
      for (std::size_t i = 0; i < 8; ++i)
        corners.push_back(
            {i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z});
      truth = boxOf(w.truth, corners, [](std::size_t i) { return i == 1 || i == 2 || i == 4; });
    } else {
      got = screenBox(w.frustum.camera(), Triangle{a, b, c});
      truth = boxOf(w.truth, corners, [](std::size_t) { return true; });
    }
    bool isClose = false;
    for (const Vec3& corner : corners) {
      const Real before = w.truth.view(toReal(corner)).forward - Real(w.scene.near);
      inFront += before < Real(0) ? 0 : 1;
      isClose = isClose || double(abs(before)) < 1e-25 * double(length(toReal(corner)));
    }
    if (isClose) continue;
    const int count = static_cast<int>(corners.size());
    ++visited[std::string(isBox ? "box" : "triangle") +
              (inFront == 0       ? " behind"
               : inFront == count ? " in front"
                                  : " cut") +
              (w.truth.lens.orthographic ? ", orthographic" : "")];
    REQUIRE(got.has_value() == truth.x.least.has_value());
    if (!got) continue;
    const double share = shareOf(w.truth, *got, truth);
    CHECK(share <= 1);
    worst = std::max(worst, share);
  }
  for (const char* shape : {"box", "triangle"})
    for (const char* where : {" behind", " in front", " cut"})
      for (const char* lens : {"", ", orthographic"}) CHECK(visited[std::string(shape) + where + lens] > 30);
  WARN("largest share of the bound: " << worst);
}

TEST_CASE("A shape that is none takes no room on the screen, and one of a point takes the point's") {
  Scene scene;
  scene.position = {0, 0, 5};
  const World w(scene);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(screenBox(w.frustum.camera(), Sphere{{0, 0, nan}, 1}));
  CHECK_FALSE(screenBox(w.frustum.camera(), Sphere{{0, 0, 0}, -1}));
  CHECK_FALSE(screenBox(w.frustum.camera(), Box{{0, 0, 0}, {-1, 1, 1}}));
  CHECK_FALSE(screenBox(w.frustum.camera(), Triangle{{0, 0, 0}, {nan, 1, 1}, {0, 1, 0}}));
  // On near, and just behind it.
  CHECK(screenBox(w.frustum.camera(), Sphere{{0, 0, 5 - 0.125}, 0}).has_value() == (0.125 >= scene.near));
  scene.near = 0.125;
  const World exact(scene);
  CHECK(screenBox(exact.frustum.camera(), Sphere{{0, 0, 4.875}, 0}));
  CHECK(screenBox(exact.frustum.camera(), Sphere{{0, 0, 5.875}, 1}));
  CHECK(screenBox(exact.frustum.camera(), Box{{0, 0, 4.875}, {1, 1, 6}}));
  CHECK_FALSE(screenBox(exact.frustum.camera(), Box{{0, 0, std::nextafter(4.875, 5)}, {1, 1, 6}}));
  const Vec3 point{0.3, -0.7, 1.1};
  const ScreenPoint on = worldToScreen(exact.frustum.camera(), point);
  for (const auto& box :
       {screenBox(exact.frustum.camera(), Sphere{point, 0}), screenBox(exact.frustum.camera(), Box{point, point}),
        screenBox(exact.frustum.camera(), Triangle{point, point, point})}) {
    REQUIRE(box);
    CHECK(box->left == on.x);
    CHECK(box->right == on.x);
    CHECK(box->top == on.y);
    CHECK(box->bottom == on.y);
  }
}
