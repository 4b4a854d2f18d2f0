#include "reference/bounds/families.hpp"

#include <algorithm>

#include "internals.hpp"

namespace reference {

using namespace viewproj;
using namespace viewproj::detail;

Scene plainScene(Random& r) {
  Scene s;
  s.position = r.vector(100);
  s.target = r.vector(100);
  s.near = 0.1;
  s.far = 1000;
  return s;
}

Scene sceneOf(const Family& family, Random& random) {
  Scene scene = plainScene(random);
  family.change(random, scene);
  return scene;
}

void scaleScene(Scene& s, double k) {
  for (Vec3* v : {&s.position, &s.target})
    for (std::size_t i = 0; i < 3; ++i) (*v)[i] *= k;
  s.near *= k;
  s.far *= k;
}

void moveTo(Random& r, Scene& s, double distance) {
  const Vec3 way = r.vector(10);
  s.position = r.vector(distance);
  for (std::size_t i = 0; i < 3; ++i) s.target[i] = s.position[i] + std::max(1.0, distance * 1e-9) * way[i];
}

void nearlyParallelUp(Random& r, Scene& s, double angle) {
  const Vec3 jitter = r.vector(angle);
  for (std::size_t i = 0; i < 3; ++i) s.up[i] = s.target[i] - s.position[i];
  const double size = maxAbs(s.up);
  for (std::size_t i = 0; i < 3; ++i) s.up[i] = s.up[i] / size + jitter[i];
}

namespace {

/// Where the library puts the pixel at that distance: any point is a test, so what places it need not be right.
Vec3 atPixel(const Camera& c, double x, double y, double distance) {
  const WorldPoint p = screenToWorldAtDistance(c, {x, y}, distance);
  return p.status == DepthStatus::point ? p.position : parts(c).pose.eye;
}

double distanceInView(Random& r, const Camera& c) {
  const Projection& p = c.projection();
  if (parts(p).orthographic) return r.uniform(parts(p).near, parts(p).far);
  return std::clamp(r.logUniform(parts(p).near, std::isinf(parts(p).far) ? parts(p).near * 1e6 : parts(p).far),
                    parts(p).near, parts(p).far);
}

/// Anywhere in the picture enlarged band times about its middle.
Vec3 inBand(Random& r, const Camera& c, double band, double distance) {
  const Viewport& v = c.viewport();
  return atPixel(c, v.x + v.width * (0.5 + band * r.uniform(-0.5, 0.5)),
                 v.y + v.height * (0.5 + band * r.uniform(-0.5, 0.5)), distance);
}

Vec3 offset(const Vec3& from, const Axes& axes, double right, double up, double forward) {
  Vec3 p;
  for (std::size_t i = 0; i < 3; ++i)
    p[i] = from[i] + (right * axes.right[i].hi + up * axes.up[i].hi + forward * axes.forward[i].hi);
  return p;
}

/// Mostly inside the view; some around it, nearer than near, and behind the eye.
Vec3 inView(Random& r, const Scene&, const Camera& c) {
  const double where = r.uniform(0, 1);
  const double distance = distanceInView(r, c);
  if (where < 0.8) return inBand(r, c, 1, distance);
  if (where < 0.9) return inBand(r, c, 3, distance);
  if (where < 0.94)
    return inBand(r, c, 1, parts(c).projection.orthographic ? distance : distance * r.logUniform(1e-6, 1));
  if (where < 0.97) return inBand(r, c, r.logUniform(1, 1e6), distance);
  const Vec3 p = inBand(r, c, 1, distance);
  return {2 * parts(c).pose.eye.x - p.x, 2 * parts(c).pose.eye.y - p.y, 2 * parts(c).pose.eye.z - p.z};
}

/// W is this share of the distance to the eye, on either side.
Vec3 nextToEyePlane(Random& r, const Camera& c, double least, double most) {
  const double distance = r.logUniform(0.1, 1000);
  const double angle = r.uniform(0, 6.3);
  return offset(parts(c).pose.eye, parts(c).pose.rows, distance * std::cos(angle), distance * std::sin(angle),
                r.sign() * distance * r.logUniform(least, most));
}

Vec3 onPictureEdge(Random& r, const Scene&, const Camera& c) {
  const Viewport& v = c.viewport();
  const double share = r.chance(0.3) ? std::floor(r.uniform(0, 2)) : r.uniform(0, 1);
  const double end = std::floor(r.uniform(0, 2));
  const bool upright = r.chance(0.5);
  return atPixel(c, v.x + v.width * (upright ? end : share), v.y + v.height * (upright ? share : end),
                 distanceInView(r, c));
}

/// In the direction of a point of the view, but so near the eye.
Vec3 inViewShrunk(Random& r, const Scene&, const Camera& c, double size) {
  const Vec3 p = inBand(r, c, 1, 1);
  const double shrink = size * r.logUniform(1e-3, 1);
  return {(p.x - parts(c).pose.eye.x) * shrink, (p.y - parts(c).pose.eye.y) * shrink,
          (p.z - c.pose().eye().z) * shrink};
}

Vec3 wholeVector(Random& r, double size) {
  Vec3 v = r.vector(size);
  for (std::size_t i = 0; i < 3; ++i) v[i] = std::round(v[i]);
  return v;
}

bool parallel(const Vec3& a, const Vec3& b) {
  return a.y * b.z == a.z * b.y && a.z * b.x == a.x * b.z && a.x * b.y == a.y * b.x;
}

void wholeNumbers(Random& r, Scene& s) {
  s.viewport = {1024, 1024};
  s.fov = 90;
  s.near = 1, s.far = 16;
  do {
    s.position = wholeVector(r, 8);
    s.target = wholeVector(r, 8);
    s.up = wholeVector(r, 2);
  } while (parallel({s.target.x - s.position.x, s.target.y - s.position.y, s.target.z - s.position.z}, s.up));
}

double anyExponent(Random& r, int most) {
  return r.sign() * std::ldexp(r.uniform(1, 2), static_cast<int>(r.uniform(-most, most)));
}
Vec3 vectorOfAnyExponents(Random& r, int most) {
  return {anyExponent(r, most), anyExponent(r, most), anyExponent(r, most)};
}
void anyExponents(Random& r, Scene& s, int most) {
  s.position = vectorOfAnyExponents(r, most);
  s.target = vectorOfAnyExponents(r, most);
  s.up = vectorOfAnyExponents(r, most);
  s.far = kInfiniteFar;
}

double roundedTo(double value, double step) { return std::round(value / step) * step; }

/// The height z at which direction . (x, y, z) is 0, to double-double, where (x, y) are those of up: any up will do.
DoubleDouble heightInEyePlane(const Scene& s) {
  return -(twoProd(s.target.x, s.up.x) + twoProd(s.target.y, s.up.y)) / DoubleDouble(s.target.z);
}

/// The eye holds the low half of that height and the point the high half, so that W cancels to about u^2.
void eyeHoldsLowHalf(Random& r, Scene& s) {
  s.poseKind = PoseKind::direction;
  s.target = {roundedTo(r.uniform(1, 2), 0x1p-20), roundedTo(r.uniform(1, 2), 0x1p-20), r.uniform(1, 2)};
  s.up = {roundedTo(r.uniform(-2, 2), 0x1p-30), roundedTo(r.uniform(-2, 2), 0x1p-30), 1};
  s.position = {0, 0, -heightInEyePlane(s).lo};
}
/// Moved within the plane, in numbers of few enough digits for that to be exact.
Vec3 pointHoldsHighHalf(Random& r, const Scene& s, const Camera&) {
  const double step = roundedTo(r.uniform(-1, 1), 0x1p-10);
  return {s.up.x - s.target.y * step, s.up.y + s.target.x * step, heightInEyePlane(s).hi};
}

void fromMatrix(Random& r, Scene& s, double reach) {
  const Vec3 way = r.vector(1), side = r.vector(1);
  const Pose pose = lookAlong({0, 0, 0}, way, side, Handedness::right);
  s.poseKind = PoseKind::cameraFromWorld;
  s.axes = CameraAxes::RUB;
  for (std::size_t j = 0; j < 3; ++j) {
    s.matrix[0][j] = parts(pose).rows.right[j].hi;
    s.matrix[1][j] = parts(pose).rows.up[j].hi;
    s.matrix[2][j] = -parts(pose).rows.forward[j].hi;
  }
  const Vec3 translation = r.vector(reach);
  for (std::size_t i = 0; i < 3; ++i) s.matrix[i][3] = translation[i];
  s.matrix[3] = {0, 0, 0, 1};
}

void orthographicWindow(Scene& s, double left, double right, double bottom, double top) {
  s.lensKind = LensKind::orthographic;
  s.left = left, s.right = right, s.bottom = bottom, s.top = top;
}

void unchanged(Random&, Scene&) {}

void lookFromOrigin(Random& r, Scene& s) {
  s.position = {0, 0, 0};
  s.target = r.vector(100);
}

double zeroOrSo(Random& r) {
  const double values[] = {0.0, -0.0, 0.0, -0.0, 1, -1, 10, -10};
  return r.oneOf(values);
}

const Family kFamilies[] = {
    {"ordinary", unchanged, inView},
    {"along an axis of the world",
     [](Random& r, Scene& s) {
       const std::size_t axis = std::size_t(r.uniform(0, 3));
       s.poseKind = PoseKind::direction;
       s.target = s.up = {0, 0, 0};
       s.target[axis] = r.sign();
       s.up[(axis + 1) % 3] = 1;
     },
     inView},
    {"far/near 1e15", [](Random&, Scene& s) { s.far = s.near * 1e15; }, inView},
    {"infinite far", [](Random&, Scene& s) { s.far = kInfiniteFar; }, inView},
    {"reversed infinite", [](Random&, Scene& s) { s.far = kInfiniteFar, s.convention.reverseZ = true; }, inView},
    {"fov 1e-6", [](Random&, Scene& s) { s.fov = 1e-6; }, inView},
    {"ECEF, 1 m",
     [](Random& r, Scene& s) {
       moveTo(r, s, 6.4e6);
       s.near = 0.01, s.far = 10;
     },
     inView},
    {"eye 1e12",
     [](Random& r, Scene& s) {
       moveTo(r, s, 1e12);
       s.near = 100, s.far = 1e6;
     },
     inView},
    {"W 1e-12 of the distance", unchanged,
     [](Random& r, const Scene&, const Camera& c) { return nextToEyePlane(r, c, 1e-13, 1e-11); }, 0},
    {"W about 1e-300", lookFromOrigin,
     [](Random& r, const Scene& s, const Camera& c) { return inViewShrunk(r, s, c, 1e-300); }},
    {"edge of the picture", unchanged, onPictureEdge, 0.05},
    {"subnormal points", lookFromOrigin,
     [](Random& r, const Scene& s, const Camera& c) { return inViewShrunk(r, s, c, 1e-307); }},
    {"off-centre tile of 1e-9",
     [](Random& r, Scene& s) {
       s.lensKind = LensKind::frustum;
       s.near = 1;
       s.left = r.uniform(-1, 1), s.bottom = r.uniform(-1, 1);
       s.right = s.left + 1e-9, s.top = s.bottom + 1e-9;
     },
     inView},
    {"depth slab of 1e-12", [](Random&, Scene& s) { s.far = s.near * (1 + 1e-12); }, inView},
    {"orthographic, beyond near and far", [](Random&, Scene& s) { orthographicWindow(s, -10, 10, -5, 5); },
     [](Random& r, const Scene&, const Camera& c) { return inBand(r, c, 3, r.sign() * r.logUniform(1, 1e12)); }, 0.01},
    {"whole numbers", wholeNumbers, [](Random& r, const Scene&, const Camera&) { return wholeVector(r, 10); }, 0.01},
    {"any exponents", [](Random& r, Scene& s) { anyExponents(r, s, 40); },
     [](Random& r, const Scene&, const Camera&) { return vectorOfAnyExponents(r, 40); }, 0},
    {"W cancels to u^2", eyeHoldsLowHalf, pointHoldsHighHalf, 0},
    {"every kind of camera", [](Random& r, Scene& s) { s = randomScene(r, r.logUniform(1e-3, 1e12)); }, inView},
    {"far/near 1e36", [](Random&, Scene& s) { s.near = 1e-3, s.far = 1e33; }, inView},
    {"reversed far/near 1e36", [](Random&, Scene& s) { s.near = 1e-3, s.far = 1e33, s.convention.reverseZ = true; },
     inView},
    {"near 1e-45, far 1e33", [](Random&, Scene& s) { s.near = 1e-45, s.far = 1e33; }, inView, 0.4},
    {"fov 1e-42", [](Random&, Scene& s) { s.fov = 1e-42; }, inView, 0},
    {"fov 1e-30 at the origin",
     [](Random& r, Scene& s) {
       s.position = {0, 0, 0};
       s.target = {0, 0, r.sign()};
       s.fov = 1e-30;
     },
     inView},
    {"fov next to 180", [](Random&, Scene& s) { s.fov = std::nextafter(180, 0); }, inView},
    {"scale 1e-40", [](Random&, Scene& s) { scaleScene(s, 1e-40); }, inView},
    {"scale 1e31", [](Random&, Scene& s) { scaleScene(s, 1e31); }, inView, 0.2},
    {"up 1e-15 off parallel", [](Random& r, Scene& s) { nearlyParallelUp(r, s, 1e-15); }, inView},
    {"any exponents to 2^140", [](Random& r, Scene& s) { anyExponents(r, s, 140); },
     [](Random& r, const Scene&, const Camera&) { return vectorOfAnyExponents(r, 140); }, 0},
    {"matrix at 1e12, next to the eye",
     [](Random& r, Scene& s) {
       fromMatrix(r, s, r.logUniform(1e9, 1e12));
       s.near = 1e3, s.far = 1e9;
     },
     [](Random& r, const Scene&, const Camera& c) {
       Vec3 p = parts(c).pose.eye;
       for (std::size_t i = 0; i < 3; ++i)
         for (int steps = int(r.uniform(0, 3)); steps > 0; --steps) p[i] = std::nextafter(p[i], r.sign() * INFINITY);
       return p;
     },
     0.05},
    {"orthographic from a corner, next to it",
     [](Random& r, Scene& s) {
       s.position = {0, 0, 0};
       orthographicWindow(s, 0, r.logUniform(1e-3, 1e3), 0, r.logUniform(1e-3, 1e3));
       s.viewport.origin = Origin::bottomLeft;
       s.near = -1, s.far = 1;
     },
     [](Random& r, const Scene&, const Camera&) { return r.vector(r.logUniform(1e-307, 1)); }, 0.1},
    {"perspective from a corner, next to it",
     [](Random& r, Scene& s) {
       s.position = {0, 0, 0};
       s.lensKind = LensKind::intrinsics;
       s.fx = r.logUniform(10, 1e4), s.fy = r.logUniform(10, 1e4), s.cx = s.cy = 0;
     },
     [](Random& r, const Scene&, const Camera& c) {
       return offset(parts(c).pose.eye, parts(c).pose.rows, r.logUniform(1e-300, 1), r.logUniform(1e-300, 1), 1);
     },
     0.5},
    {"rows next to 1e45", [](Random& r, Scene& s) { s.fov = r.logUniform(1e-42, 1e-40); }, inView, 0},
    {"distances next to the limits of the rungs", lookFromOrigin,
     [](Random& r, const Scene& s, const Camera& c) {
       const int exponents[] = {-250, -200, 100, 130};
       return inViewShrunk(r, s, c, std::ldexp(r.logUniform(1e-2, 1e2), r.oneOf(exponents)));
     },
     0.05},
    {"next to the eye plane, where the rungs hand over", unchanged,
     [](Random& r, const Scene&, const Camera& c) { return nextToEyePlane(r, c, 1e-14, 1e-2); }, 0},
    {"largest numbers",
     [](Random& r, Scene& s) {
       s.position = {-1e45 * r.uniform(0.5, 1), 1e45 * r.uniform(-1, 1), 1e45 * r.uniform(-1, 1)};
       s.target = {0, 0, 0};
       s.near = 1e42, s.far = kInfiniteFar;
     },
     [](Random& r, const Scene&, const Camera&) { return r.vector(1e45); }, 0.05},
    {"overflow of the screen position",
     [](Random& r, Scene& s) {
       s.position = {0, 0, 0};
       s.target = {0, 0, r.sign()};
       s.fov = r.chance(0.5) ? 60 : 1e-42;
     },
     [](Random& r, const Scene& s, const Camera&) {
       return Vec3{r.sign() * r.logUniform(1e-3, 1e3), r.sign() * r.logUniform(1e-3, 1e3),
                   s.target.z * r.logUniform(1e-307, 1e-200)};
     },
     0},
    {"signed zeros",
     [](Random& r, Scene& s) {
       s.position = {zeroOrSo(r), zeroOrSo(r), zeroOrSo(r)};
       s.up = {zeroOrSo(r), 1, zeroOrSo(r)};
       do s.target = {zeroOrSo(r), zeroOrSo(r), zeroOrSo(r)};
       while (parallel({s.target.x - s.position.x, s.target.y - s.position.y, s.target.z - s.position.z}, s.up));
     },
     [](Random& r, const Scene&, const Camera&) {
       return Vec3{zeroOrSo(r), zeroOrSo(r), zeroOrSo(r)};
     },
     0.05},
    {"far off screen", unchanged,
     [](Random& r, const Scene&, const Camera& c) { return inBand(r, c, r.logUniform(1, 1e12), distanceInView(r, c)); },
     0},
};

}  // namespace

std::span<const Family> families() { return kFamilies; }

}  // namespace reference
