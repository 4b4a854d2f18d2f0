#include <algorithm>
#include <cmath>
#include <optional>

#include "numbers/certified.hpp"
#include "numbers/dyadic.hpp"
#include "scene/frustum_parts.hpp"
#include "viewproj/scene.hpp"

namespace viewproj {

using namespace detail;
namespace {

// Number is Certified or Dyadic<1>; products of Dyadic have more digits. A function returns nothing if it meets a
// number that is not certain.

template <class Number>
Vector3<Number> difference(const Vec3& a, const Vec3& b) noexcept {
  return {Number::difference(a.x, b.x), Number::difference(a.y, b.y), Number::difference(a.z, b.z)};
}

template <class Number>
Vector3<Number> lifted(const Vec3& a) noexcept {
  return {a.x, a.y, a.z};
}

template <class Number>
bool isWithin(const Vector3<Number>& v, double size) noexcept {
  return v.x.isWithin(size) && v.y.isWithin(size) && v.z.isWithin(size);
}

template <class Number>
WideVec3 roundedVector(const Vector3<Number>& v) noexcept {
  return {v.x.rounded(), v.y.rounded(), v.z.rounded()};
}

/// A coordinate of the hit that is already known.
struct Known {
  std::size_t axis = 3;
  double coordinate = 0;
};

/// The hit at origin + t direction, t = numerator / denominator >= 0.
template <class Number, class Product, class Divisor>
std::optional<Hit> hitAt(const Ray& ray, const Product& numerator, const Divisor& denominator,
                         Known known = {}) noexcept {
  const Wide below = denominator.rounded();
  Hit hit;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto at = Number(ray.origin[i]) * denominator + Number(ray.direction[i]) * numerator;
    if (i != known.axis && !at.isCertain()) return {};
    hit.point[i] = i == known.axis ? known.coordinate : double(at.rounded() / below);
  }
  hit.distance = double(numerator.rounded() / below * lengthOf(toWide(ray.direction)));
  return hit;
}

/// All points of a plane across an axis have one coordinate.
Known knownOf(const Plane& plane) noexcept {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (plane.normal[(axis + 1) % 3] == 0 && plane.normal[(axis + 2) % 3] == 0)
      return {axis, plane.point[axis] + 0.0};  // no -0
  return {};
}

Hits oneHit(Hit hit, const Vec3& normal) noexcept {
  hit.normal = normal;
  return {{hit, {}}, 1};
}

template <class Number>
std::optional<Hits> planeHits(const Ray& ray, const Plane& plane) noexcept {
  const Vector3<Number> normal = lifted<Number>(plane.normal);
  const auto along = dot(normal, lifted<Number>(ray.direction));
  const auto away = dot(normal, difference<Number>(plane.point, ray.origin));
  if (!along.isCertain() || !away.isCertain()) return {};
  if (along.sign() == 0 || along.sign() * away.sign() < 0) return Hits{};
  const std::optional<Hit> hit = hitAt<Number>(ray, away, along, knownOf(plane));
  if (!hit) return {};
  return oneHit(*hit, unitOf(toWide(plane.normal)));
}

/// The volumes spanned by the direction and each edge, seen from the origin, have one sign if the ray passes inside.
template <class Number>
std::optional<Hits> triangleHits(const Ray& ray, const Triangle& t) noexcept {
  const Vector3<Number> d = lifted<Number>(ray.direction);
  const Vector3<Number> a = difference<Number>(t.a, ray.origin);
  const Vector3<Number> b = difference<Number>(t.b, ray.origin);
  const Vector3<Number> c = difference<Number>(t.c, ray.origin);
  const auto bc = crossOf(b, c);
  const auto u = dot(d, bc);
  const auto v = dot(d, crossOf(c, a));
  const auto w = dot(d, crossOf(a, b));
  if (!u.isCertain() || !v.isCertain() || !w.isCertain()) return {};
  const auto [low, high] = std::minmax({u.sign(), v.sign(), w.sign()});
  if (low * high < 0 || (low == 0 && high == 0)) return Hits{};
  const auto along = u + v + w;  // d . normal
  const auto away = dot(a, bc);
  if (!along.isCertain() || !away.isCertain()) return {};
  if (along.sign() * away.sign() < 0) return Hits{};
  const std::optional<Hit> hit = hitAt<Number>(ray, away, along);
  const auto normal = crossOf(difference<Number>(t.b, t.a), difference<Number>(t.c, t.a));
  const WideVec3 roundedNormal = roundedVector(normal);
  if (!hit || !isWithin(normal, maxAbs(rounded(roundedNormal)))) return {};
  return oneHit(*hit, unitOf(roundedNormal));
}

/// Where the ray crosses the plane of a face, at t = (face - origin) / direction along that axis.
struct Crossing {
  std::size_t axis;
  double face;
};

template <class Number>
Number timesDirection(const Ray& ray, const Crossing& c) noexcept {  // t |direction| of the axis
  return ray.direction[c.axis] > 0 ? Number::difference(c.face, ray.origin[c.axis])
                                   : Number::difference(ray.origin[c.axis], c.face);
}

/// (t of a - t of b) times a positive number.
template <class Number>
auto lead(const Ray& ray, const Crossing& a, const Crossing& b) noexcept {
  return timesDirection<Number>(ray, a) * Number(std::fabs(ray.direction[b.axis])) -
         timesDirection<Number>(ray, b) * Number(std::fabs(ray.direction[a.axis]));
}

template <class Number>
std::optional<Hit> boxHit(const Ray& ray, const Box& box, const Crossing& c) noexcept {
  std::optional<Hit> hit = hitAt<Number>(ray, timesDirection<Number>(ray, c), Number(std::fabs(ray.direction[c.axis])),
                                         {c.axis, c.face + 0.0});
  if (!hit) return {};
  // A flat box has two faces in one place. The ray enters through the one that faces it.
  const bool isMax = c.face == box.max[c.axis] && (c.face != box.min[c.axis] || ray.direction[c.axis] < 0);
  hit->normal[c.axis] = isMax ? 1 : -1;
  hit->face = static_cast<BoxFace>(1 + 2 * c.axis + (isMax ? 1 : 0));
  return hit;
}

template <class Number>
std::optional<Hits> boxHits(const Ray& ray, const Box& box) noexcept {
  std::optional<Crossing> entry, exit;
  for (std::size_t i = 0; i < 3; ++i) {
    const double o = ray.origin[i], d = ray.direction[i];
    const bool between = box.min[i] <= o && o <= box.max[i];
    if (!between && (d == 0 || (d > 0 ? o > box.max[i] : o < box.min[i]))) return Hits{};
    if (d == 0) continue;
    const Crossing in{i, d > 0 ? box.min[i] : box.max[i]}, out{i, d > 0 ? box.max[i] : box.min[i]};
    if (!entry) {
      entry = in;
      exit = out;
      continue;
    }
    const auto later = lead<Number>(ray, in, *entry), sooner = lead<Number>(ray, *exit, out);
    if (!later.isCertain() || !sooner.isCertain()) return {};
    if (later.sign() > 0) entry = in;
    if (sooner.sign() > 0) exit = out;
  }
  const auto stay = lead<Number>(ray, *exit, *entry);
  if (!stay.isCertain()) return {};
  if (stay.sign() < 0) return Hits{};
  Hits result;
  for (const Crossing& c : {*entry, *exit}) {
    if (timesDirection<Number>(ray, c).sign() < 0) continue;
    const std::optional<Hit> hit = boxHit<Number>(ray, box, c);
    if (!hit) return {};
    result.hits[std::size_t(result.count++)] = *hit;
    if (stay.sign() == 0) break;
  }
  return result;
}

/// To the coordinates in which a spheroid is a sphere, or back.
WideVec3 stretched(const WideVec3& v, const Wide& across, const Wide& along) noexcept {
  return {v.x * across, v.y * across, v.z * along};
}

/// The surface across^2 (x^2 + y^2) + along^2 z^2 = across^2 radius^2, with (x, y, z) = p - center. Stretched by
/// (across, across, along) it is a sphere of radius across * radius.
struct Spheroid {
  Vec3 center;
  double across, along, radius;
};

/// With m and d the stretched origin (from the center) and direction: t^2 A + 2 t B + C = 0. The discriminant over
/// across^2 is radius^2 A - |m x d|^2 / across^2. Every point of the ray is m + t d = (d x (m x d)) / A + s d. The
/// first term is the point nearest the centre, so no digits are lost however far the origin is.
template <class Number>
std::optional<Hits> spheroidHits(const Ray& ray, const Spheroid& s) noexcept {
  const Vector3<Number> m = difference<Number>(ray.origin, s.center);
  const Vector3<Number> d = lifted<Number>(ray.direction);
  const auto across2 = Number(s.across) * Number(s.across), along2 = Number(s.along) * Number(s.along);
  const auto radius2 = Number(s.radius) * Number(s.radius);
  const auto stretchedDot = [&](const Vector3<Number>& a, const Vector3<Number>& b) {
    return across2 * (a.x * b.x + a.y * b.y) + along2 * (a.z * b.z);
  };
  const auto C = stretchedDot(m, m) - across2 * radius2;
  const auto B = stretchedDot(m, d);
  if (!C.isCertain() || (C.sign() >= 0 && !B.isCertain())) return {};
  if (C.sign() > 0 && B.sign() >= 0) return Hits{};  // outside, and moving away
  const auto A = stretchedDot(d, d);
  const auto k = crossOf(m, d);
  auto discriminant = radius2 * A;  // one after the other, because each term takes a kilobyte
  discriminant = discriminant - along2 * (k.x * k.x + k.y * k.y);
  discriminant = discriminant - across2 * (k.z * k.z);
  if (!A.isCertain() || !discriminant.isCertain()) return {};
  if (discriminant.sign() < 0) return Hits{};

  const Wide a = A.rounded(), b = B.rounded(), across = s.across, along = s.along;
  const Wide root = across * sqrt(discriminant.rounded());
  const Wide q = b.sign() < 0 ? root - b : -(b + root);
  // From inside, B may be uncertain. But its error is below 2^-85 relative to the root of a certain discriminant.
  const double flattest = std::min(s.across / s.along, s.along / s.across);
  if (!isWithin(k, s.radius * maxAbs(ray.direction) * flattest)) return {};

  const WideVec3 direction = stretched(toWide(ray.direction), across, along);
  const WideVec3 moment{across * along * k.x.rounded(), across * along * k.y.rounded(),
                        across * across * k.z.rounded()};
  const WideVec3 nearest = crossOf(direction, moment) * (Wide(1) / a);
  Hits result;
  const auto add = [&](const Wide& t, const Wide& halfChord) {
    if (t.sign() < 0) return;
    const bool starts = t.sign() == 0;
    const WideVec3 at = starts ? stretched(roundedVector(m), across, along)
                               : nearest + direction * halfChord;  // stretched, relative to center
    Hit hit;
    hit.distance = double(t * lengthOf(toWide(ray.direction)));
    hit.point = starts ? rounded(toWide(ray.origin))
                       : rounded(toWide(s.center) + stretched(at, Wide(1) / across, Wide(1) / along));
    hit.normal = s.radius > 0 ? unitOf(stretched(at, across, along)) : unitOf(toWide(ray.direction) * Wide(-1));
    result.hits[std::size_t(result.count++)] = hit;
  };
  const Wide halfChord = root / a;
  if (root.sign() == 0) {
    add(q / a, 0);
  } else {
    const Wide other = C.rounded() / q;
    add(q.sign() < 0 ? q / a : other, -halfChord);
    add(q.sign() < 0 ? other : q / a, halfChord);
  }
  return result;
}

bool isValid(const Ray& ray) noexcept {
  return isInRange(ray.origin) && isInRange(ray.direction) && maxAbs(ray.direction) > 0;
}

/// The certified hits, or the exact ones if a number is not certain. argument: the shape in the form that both accept.
template <class Shape, class Argument>
Hits hitsOf(const Ray& ray, const Shape& shape, const Argument& argument,
            std::optional<Hits> (*certified)(const Ray&, const Argument&),
            std::optional<Hits> (*exact)(const Ray&, const Argument&)) noexcept {
  if (!isValid(ray) || !viewproj::isValid(shape)) return {};
  const std::optional<Hits> hits = certified(ray, argument);
  return hits ? *hits : *exact(ray, argument);
}

bool isLength(double size) noexcept { return size >= 0 && size <= kFarthestPoint; }

}  // namespace

bool isValid(const Plane& p) noexcept { return isInRange(p.point) && isInRange(p.normal) && maxAbs(p.normal) > 0; }
bool isValid(const Sphere& s) noexcept { return isInRange(s.center) && isLength(s.radius); }
bool isValid(const Box& b) noexcept {
  return isInRange(b.min) && isInRange(b.max) && b.min.x <= b.max.x && b.min.y <= b.max.y && b.min.z <= b.max.z;
}
bool isValid(const Triangle& t) noexcept { return isInRange(t.a) && isInRange(t.b) && isInRange(t.c); }
bool isValid(const Ellipsoid& e) noexcept {
  return e.equatorial > 0 && e.polar > 0 && isLength(e.equatorial) && isLength(e.polar);
}

Hits intersect(const Ray& ray, const Plane& plane) noexcept {
  return hitsOf(ray, plane, plane, planeHits<Certified>, planeHits<Dyadic<1>>);
}

Hits intersect(const Ray& ray, const Sphere& sphere) noexcept {
  const Spheroid spheroid{sphere.center, 1, 1, sphere.radius};
  return hitsOf(ray, sphere, spheroid, spheroidHits<Certified>, spheroidHits<Dyadic<1>>);
}

Hits intersect(const Ray& ray, const Box& box) noexcept {
  return hitsOf(ray, box, box, boxHits<Certified>, boxHits<Dyadic<1>>);
}

Hits intersect(const Ray& ray, const Triangle& triangle) noexcept {
  return hitsOf(ray, triangle, triangle, triangleHits<Certified>, triangleHits<Dyadic<1>>);
}

Hits intersect(const Ray& ray, const Ellipsoid& ellipsoid) noexcept {
  const Spheroid spheroid{{}, ellipsoid.polar, ellipsoid.equatorial, ellipsoid.equatorial};
  return hitsOf(ray, ellipsoid, spheroid, spheroidHits<Certified>, spheroidHits<Dyadic<1>>);
}

}  // namespace viewproj
