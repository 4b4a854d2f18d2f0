#include "reference/shapes/hit_cases.hpp"

#include <cmath>
#include <limits>

#include "internals.hpp"

namespace reference {

using namespace viewproj;
using namespace viewproj::detail;

namespace {

Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec3 operator*(const Vec3& a, double k) { return {a.x * k, a.y * k, a.z * k}; }

Vec3 unitOf(const Vec3& a) {
  const double k = 1 / std::hypot(a.x, a.y, a.z);
  return a * k;
}

Vec3 crossOf(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

double whole(Random& r, int reach) { return std::floor(r.uniform(-reach, reach + 1)); }
Vec3 wholeVector(Random& r, int reach) { return {whole(r, reach), whole(r, reach), whole(r, reach)}; }

Vec3 wholeDirection(Random& r, int reach) {
  Vec3 d = wholeVector(r, reach);
  while (maxAbs(d) == 0) d = wholeVector(r, reach);
  // Parallel to faces, with zeros of either sign.
  for (std::size_t i = 0; i < 3; ++i)
    if (r.chance(0.25)) d[i] = r.sign() * 0.0;
  if (maxAbs(d) == 0) d.x = r.sign();
  return d;
}

double neighbour(Random& r, double a) {
  const double next = std::nextafter(a, r.sign() * std::numeric_limits<double>::infinity());
  return r.chance(0.3) ? a : next;
}

Vec3 anyDirection(Random& r) {
  Vec3 d = r.vector(1);
  for (std::size_t i = 0; i < 3; ++i)
    if (r.chance(0.15)) d[i] = r.sign() * 0.0;
  if (maxAbs(d) == 0) d.z = -1;
  return unitOf(d);
}

/// A number of any magnitude that a double has.
double any(Random& r) { return r.chance(0.1) ? r.sign() * 0.0 : r.sign() * r.logUniform(1e-300, 1e45); }
Vec3 anyVector(Random& r) { return {any(r), any(r), any(r)}; }

/// The same scene in other units and another place; whole numbers stay exact.
struct Placing {
  double scale = 1;
  Vec3 offset;

  Vec3 point(const Vec3& p) const { return (p + offset) * scale; }
  double length(double a) const { return a * scale; }
};

Placing placing(Random& r) {
  Placing p;
  const double at = r.uniform(0, 1);
  if (at < 0.25) p.offset = {std::floor(r.uniform(-6.4e6, 6.4e6)), std::floor(r.uniform(-6.4e6, 6.4e6)), 6378137};
  if (at > 0.5 && at < 0.65) p.scale = 0x1p-500;  // 1e-150, of which nothing is lost
  if (at > 0.65 && at < 0.8) p.scale = 0x1p240;
  if (at > 0.8) p.scale = std::exp2(std::floor(r.uniform(-40, 40)));
  return p;
}

HitCase placed(const Placing& p, const Ray& ray, const Vec3& center, double radius) {
  return {{p.point(ray.origin), ray.direction}, Sphere{p.point(center), p.length(radius)}};
}

HitCase sphere(Random& r) {
  const double size = r.logUniform(1e-3, 1e3), radius = size * r.logUniform(1e-6, 2);
  return placed(placing(r), {r.vector(size), anyDirection(r)}, r.vector(size), radius);
}

/// Aimed at the sphere's rim: the discriminant is about 0 in doubles.
HitCase grazedSphere(Random& r) {
  const double size = r.logUniform(1e-3, 1e3);
  const Vec3 origin = r.vector(size), center = r.vector(size), d = anyDirection(r);
  const Vec3 moment = crossOf(origin - center, d);
  const double distance = std::hypot(moment.x, moment.y, moment.z) / std::hypot(d.x, d.y, d.z);
  return placed(placing(r), {origin, d}, center, neighbour(r, distance));
}

/// Exactly tangent, or the next double beside it: of a Pythagorean triple, moved along the ray.
HitCase tangentToSphere(Random& r) {
  const double k = std::floor(r.uniform(1, 50)), along = whole(r, 30);
  const bool swapped = r.chance(0.5);
  const Vec3 d = swapped ? Vec3{-4, 3, 0} : Vec3{3, 4, 0};
  const Vec3 across = swapped ? Vec3{3, 4, 0} : Vec3{-4, 3, 0};
  const Vec3 center = wholeVector(r, 100);
  HitCase c = placed(placing(r), {center + across * k + d * along, d * (r.chance(0.5) ? 1 : 0.125)}, center, 5 * k);
  if (r.chance(0.5)) std::get<Sphere>(c.shape).radius = neighbour(r, std::get<Sphere>(c.shape).radius);
  return c;
}

/// 2, 3, 6 and 7; 1, 4, 8 and 9: starts exactly on the sphere, or on the next double beside it.
HitCase startsOnSphere(Random& r) {
  const double k = std::floor(r.uniform(1, 50));
  Vec3 at = r.chance(0.5) ? Vec3{2, 3, 6} : Vec3{8, 1, 4};
  const double radius = maxAbs(at) == 6 ? 7 : 9;
  for (std::size_t i = 0; i < 3; ++i) at[i] *= r.sign();
  const Vec3 center = wholeVector(r, 100);
  const Vec3 d = r.chance(0.3) ? unitOf(crossOf(at, wholeDirection(r, 5) + Vec3{0.5, 0, 0})) : anyDirection(r);
  HitCase c = placed(placing(r), {center + at * k, d}, center, radius * k);
  if (r.chance(0.3)) c.ray.origin.y = neighbour(r, c.ray.origin.y);
  return c;
}

/// A point, on the ray or beside it.
HitCase pointSphere(Random& r) {
  const Vec3 origin = wholeVector(r, 100), d = wholeDirection(r, 9);
  Vec3 center = origin + d * whole(r, 9);
  if (r.chance(0.3)) center.x = neighbour(r, center.x);
  return placed(placing(r), {origin, d}, center, 0);
}

/// The same scene as in a camera at a millionth of the radius above the surface, or far away from a small sphere.
HitCase sphereOfAnotherSize(Random& r) {
  const double radius = r.logUniform(1e-8, 1e8);
  const Vec3 out = unitOf(r.vector(1));
  const double height = r.chance(0.5) ? radius * r.logUniform(1e-12, 1e-2) : radius * r.logUniform(1, 1e12);
  const Vec3 origin = out * (radius + height);
  const Vec3 aim = unitOf(r.vector(1)) * (radius * r.uniform(0, 2));
  return placed(placing(r), {origin, unitOf(aim - origin)}, {}, radius);
}

/// Aimed at its centre along an axis, from so far that the cross product of double-double is mostly error.
HitCase sphereFromAfar(Random& r) {
  const double distance = std::exp2(r.uniform(20, 60));
  const Vec3 origin{distance, r.sign() * r.logUniform(1e-12, 1) * distance, r.sign() * r.logUniform(1e-12, 1)};
  return placed(placing(r), {origin, unitOf(origin * -1)}, {}, r.logUniform(0.5, 2));
}

HitCase anySphere(Random& r) {
  const Vec3 origin = anyVector(r), center = r.chance(0.5) ? origin + Vec3{any(r), 0, any(r)} : anyVector(r);
  const Vec3 d = r.chance(0.5) ? Vec3{r.sign(), 0, 0} : anyDirection(r);
  return {{origin, r.chance(0.2) ? anyVector(r) : d}, Sphere{center, std::fabs(any(r))}};
}

HitCase earth(Random& r) {
  const Vec3 out = unitOf(r.vector(1));
  const double height = r.sign() * r.logUniform(1e-3, 1e8);
  const Vec3 origin = out * (6.37e6 + height);
  const Vec3 aim = unitOf(r.vector(1)) * 6.36e6;
  const Vec3 d = r.chance(0.5) ? unitOf(aim - origin) : anyDirection(r);
  return {{origin, d}, kWgs84};
}

/// Straight down at the equator or a pole, from on it; along the tangent there, or the next double beside it.
HitCase earthExactly(Random& r) {
  const double scale = r.chance(0.5) ? 1 : r.chance(0.5) ? 0x1p-500 : 0x1p480;
  const Ellipsoid e{kWgs84.equatorial * scale, kWgs84.polar * scale};
  const std::size_t axis = std::size_t(r.uniform(0, 3)), other = (axis + 1) % 3;
  Vec3 origin{}, d{};
  origin[axis] = r.sign() * (axis == 2 ? e.polar : e.equatorial);
  if (r.chance(0.4)) origin[axis] = neighbour(r, origin[axis]);
  if (r.chance(0.5)) {
    d[other] = r.sign();
    origin[other] = whole(r, 3) * 1000 * scale;
  } else {
    d[axis] = r.sign();
    if (r.chance(0.5)) origin[axis] *= 2;
  }
  return {{origin, d}, e};
}

HitCase anyEllipsoid(Random& r) {
  const double size = r.logUniform(1e-6, 1e6);
  const Ellipsoid e{size * r.logUniform(1e-3, 1e3), size * r.logUniform(1e-3, 1e3)};
  const Vec3 origin = r.vector(3 * std::max(e.equatorial, e.polar));
  const Vec3 aim{e.equatorial * r.uniform(-0.8, 0.8), e.equatorial * r.uniform(-0.8, 0.8),
                 e.polar * r.uniform(-0.8, 0.8)};
  return {{origin, unitOf(aim - origin)}, e};
}

HitCase placed(const Placing& p, const Ray& ray, const Box& box) {
  return {{p.point(ray.origin), ray.direction}, Box{p.point(box.min), p.point(box.max)}};
}

Box boxOf(const Vec3& a, const Vec3& b) {
  return {{std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)},
          {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}};
}

HitCase box(Random& r) {
  const double size = r.logUniform(1e-3, 1e3);
  return placed(placing(r), {r.vector(size), anyDirection(r)}, boxOf(r.vector(size), r.vector(size)));
}

/// Small whole numbers: edges, corners, faces, flat boxes, starts on the surface, all met exactly.
HitCase wholeBox(Random& r) {
  const Box b = boxOf(wholeVector(r, 4), wholeVector(r, 4));
  Vec3 target = b.min;
  for (std::size_t i = 0; i < 3; ++i) target[i] = r.chance(0.4) ? b.max[i] : r.chance(0.6) ? b.min[i] : whole(r, 4);
  const Vec3 d = wholeDirection(r, 4);
  const Vec3 origin = target - d * whole(r, 4);  // drawn first: compilers differ in which argument they take first
  HitCase c = placed(placing(r), {origin, d}, b);
  if (r.chance(0.2)) c.ray.direction = unitOf(d);
  if (r.chance(0.1)) c.ray.origin.z = neighbour(r, c.ray.origin.z);
  return c;
}

/// Aimed at an edge or a corner in doubles.
HitCase edgeOfBox(Random& r) {
  const double size = r.logUniform(1e-3, 1e3);
  const Placing p = placing(r);
  const Box b = boxOf(p.point(r.vector(size)), p.point(r.vector(size)));
  Vec3 target = b.max;
  for (std::size_t i = 0; i < 3; ++i)
    if (r.chance(0.5)) target[i] = r.chance(0.5) ? b.min[i] : (b.min[i] + b.max[i]) / 2;
  const Vec3 origin = p.point(r.vector(3 * size)), d = target - origin;
  return {{origin, maxAbs(d) > 0 ? unitOf(d * (1 / maxAbs(d))) : Vec3{1, 0, 0}}, b};
}

HitCase anyBox(Random& r) {
  const Vec3 corner = anyVector(r);
  const Box b = boxOf(corner, r.chance(0.5) ? anyVector(r) : corner);
  const Vec3 origin = r.chance(0.3) ? b.min + Vec3{any(r), 0, 0} : anyVector(r);
  return {{origin, r.chance(0.3) ? anyVector(r) : anyDirection(r)}, b};
}

HitCase placed(const Placing& p, const Ray& ray, const Triangle& t) {
  return {{p.point(ray.origin), ray.direction}, Triangle{p.point(t.a), p.point(t.b), p.point(t.c)}};
}

HitCase triangle(Random& r) {
  const double size = r.logUniform(1e-3, 1e3);
  const Triangle t{r.vector(size), r.vector(size), r.vector(size)};
  const double u = r.uniform(-0.1, 1.1), v = r.uniform(-0.1, 1.1 - u);
  const Vec3 target = t.a + (t.b - t.a) * u + (t.c - t.a) * v, origin = r.vector(2 * size);
  return placed(placing(r), {origin, unitOf((target - origin) * r.sign())}, t);
}

/// Aimed at an edge or a corner in doubles.
HitCase edgeOfTriangle(Random& r) {
  const double size = r.logUniform(1e-3, 1e3);
  const Placing p = placing(r);
  const Triangle t{p.point(r.vector(size)), p.point(r.vector(size)), p.point(r.vector(size))};
  const Vec3 target = r.chance(0.2) ? t.c : t.a + (t.b - t.a) * r.uniform(0, 1);
  const Vec3 d = target - p.point(r.vector(2 * size)), origin = target - d;
  return {{origin, unitOf(d * (1 / maxAbs(d)))}, t};
}

/// Edges, corners, coplanar rays, triangles of no area, starts on the triangle: all exactly.
HitCase wholeTriangle(Random& r) {
  const Vec3 a = wholeVector(r, 4) * 2, b = wholeVector(r, 4) * 2;
  const Vec3 c = r.chance(0.1) ? b + (b - a) * whole(r, 2) : wholeVector(r, 4) * 2;
  const Vec3 target = r.chance(0.4) ? (a + b) * 0.5 : r.chance(0.3) ? c : wholeVector(r, 4);
  const Vec3 d = r.chance(0.2) && maxAbs(b - a) > 0 ? b - a : wholeDirection(r, 4);
  HitCase made = placed(placing(r), {target - d * whole(r, 4), d}, Triangle{a, b, c});
  if (r.chance(0.1)) made.ray.origin.z = neighbour(r, made.ray.origin.z);
  return made;
}

HitCase anyTriangle(Random& r) {
  const Triangle t{anyVector(r), anyVector(r), anyVector(r)};
  const Vec3 middle{t.a.x / 3 + t.b.x / 3 + t.c.x / 3, t.a.y / 3 + t.b.y / 3 + t.c.y / 3,
                    t.a.z / 3 + t.b.z / 3 + t.c.z / 3};
  const Vec3 origin = anyVector(r);
  const Vec3 d = middle - origin;
  return {{origin, r.chance(0.5) && maxAbs(d) > 0 ? d : anyVector(r) + Vec3{0, 0, 1}}, t};
}

HitCase plane(Random& r) {
  const double size = r.logUniform(1e-3, 1e3);
  const Placing p = placing(r);
  return {{p.point(r.vector(size)), anyDirection(r)},
          Plane{p.point(r.vector(size)), r.vector(r.logUniform(1e-200, 1e45))}};
}

/// Parallel, within, starting on: exactly.
HitCase wholePlane(Random& r) {
  const Placing p = placing(r);
  Vec3 d = wholeDirection(r, 4), n = wholeDirection(r, 4);
  if (r.chance(0.4)) n = crossOf(d, wholeDirection(r, 4));
  if (maxAbs(n) == 0) n = {0, 1, 0};
  const Vec3 point = wholeVector(r, 9);
  const Vec3 origin = r.chance(0.4) ? point + crossOf(n, wholeVector(r, 3)) : wholeVector(r, 9);
  return {{p.point(origin), d}, Plane{p.point(point), n}};
}

HitCase anyPlane(Random& r) {
  return {{anyVector(r), anyVector(r) + Vec3{0, 0, 1}}, Plane{anyVector(r), anyVector(r) + Vec3{1, 0, 0}}};
}

constexpr HitFamily kFamilies[] = {{"sphere", sphere},
                                   {"grazed sphere", grazedSphere},
                                   {"tangent to sphere", tangentToSphere},
                                   {"starts on sphere", startsOnSphere},
                                   {"sphere of radius 0", pointSphere},
                                   {"sphere of another size", sphereOfAnotherSize},
                                   {"sphere from afar", sphereFromAfar},
                                   {"sphere, any numbers", anySphere},
                                   {"Earth", earth},
                                   {"Earth, exactly", earthExactly},
                                   {"ellipsoid", anyEllipsoid},
                                   {"box", box},
                                   {"box of whole numbers", wholeBox},
                                   {"edge of box", edgeOfBox},
                                   {"box, any numbers", anyBox},
                                   {"triangle", triangle},
                                   {"edge of triangle", edgeOfTriangle},
                                   {"triangle of whole numbers", wholeTriangle},
                                   {"triangle, any numbers", anyTriangle},
                                   {"plane", plane},
                                   {"plane of whole numbers", wholePlane},
                                   {"plane, any numbers", anyPlane}};

}  // namespace

std::span<const HitFamily> hitFamilies() { return kFamilies; }

}  // namespace reference
