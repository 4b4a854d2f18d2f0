#include "reference/shapes/hit_truth.hpp"

#include <algorithm>
#include <stdexcept>

#include "internals.hpp"

namespace reference {

using namespace viewproj;
using namespace viewproj::detail;

namespace {

/// All verdicts of double coordinates fit into so many bits: six factors between 2^-1074 and 2^1024.
constexpr mpfr_prec_t kAllBits = 6 * 2110 + 64;
constexpr mpfr_prec_t kFirstBits = 640;

struct Line {
  Real3 origin, direction;
};

/// A root of the ray's parameter and what it belongs to, as a fraction of positive denominator, for exact comparison.
struct Fraction {
  Real numerator, denominator;
  BoxFace face = BoxFace::none;
  friend bool operator<(const Fraction& a, const Fraction& b) {
    return a.numerator * b.denominator < b.numerator * a.denominator;
  }
};

Fraction fraction(const Real& n, const Real& d, BoxFace face = BoxFace::none) {
  return d.sign() < 0 ? Fraction{-n, -d, face} : Fraction{n, d, face};
}

/// A quadratic in the ray's parameter.
struct Quadratic {
  Real a, b, c;  // a t^2 + 2 b t + c
};

/// What decides, without rounding.
struct Verdict {
  std::vector<Fraction> crossings;  // flat shapes, sorted
  std::optional<Quadratic> roots;   // round shapes that are hit
  int count = 0;                    // of hits
  bool touches = false, startsOn = false, startsInside = false;
};

Verdict roundVerdict(const Real& a, const Real& b, const Real& c) {
  Verdict v;
  const int discriminant = (b * b - a * c).sign();
  v.startsOn = c.sign() == 0;
  v.startsInside = c.sign() < 0;
  if (discriminant < 0) return v;
  v.touches = discriminant == 0;
  if (v.startsInside)
    v.count = 1;
  else if (v.startsOn)
    v.count = b.sign() < 0 ? 2 : 1;
  else
    v.count = b.sign() >= 0 ? 0 : v.touches ? 1 : 2;
  v.roots = Quadratic{a, b, c};
  return v;
}

Verdict verdictOf(const Line& l, const Sphere& s) {
  const Real3 m = l.origin - toReal(s.center);
  return roundVerdict(dot(l.direction, l.direction), dot(m, l.direction), dot(m, m) - Real(s.radius) * s.radius);
}

Verdict verdictOf(const Line& l, const Ellipsoid& e) {
  const Real a2 = Real(e.equatorial) * e.equatorial, b2 = Real(e.polar) * e.polar;
  const auto form = [&](const Real3& p, const Real3& q) { return (p[0] * q[0] + p[1] * q[1]) * b2 + p[2] * q[2] * a2; };
  return roundVerdict(form(l.direction, l.direction), form(l.origin, l.direction), form(l.origin, l.origin) - a2 * b2);
}

Verdict verdictOf(const Line& l, const Plane& p) {
  Verdict v;
  const Real3 n = toReal(p.normal);
  const Real along = dot(n, l.direction), away = dot(n, toReal(p.point) - l.origin);
  v.startsOn = away.sign() == 0;
  if (along.sign() == 0 || along.sign() * away.sign() < 0) return v;
  v.crossings = {fraction(away, along)};
  v.count = 1;
  return v;
}

/// Möller & Trumbore: Cramer's rule for origin + t d = a + u (b - a) + v (c - a).
Verdict verdictOf(const Line& l, const Triangle& t) {
  Verdict verdict;
  const Real3 a = toReal(t.a), e1 = toReal(t.b) - a, e2 = toReal(t.c) - a, s = l.origin - a;
  const Real3 p = cross(l.direction, e2), q = cross(s, e1);
  Real determinant = dot(p, e1), u = dot(p, s), v = dot(q, l.direction), along = dot(q, e2);
  if (determinant.sign() == 0) return verdict;
  if (determinant.sign() < 0) determinant = -determinant, u = -u, v = -v, along = -along;
  if (u.sign() < 0 || v.sign() < 0 || determinant < u + v || along.sign() < 0) return verdict;
  verdict.touches = u.sign() == 0 || v.sign() == 0 || (determinant - u - v).sign() == 0;
  verdict.startsOn = along.sign() == 0;
  verdict.crossings = {fraction(along, determinant)};
  verdict.count = 1;
  return verdict;
}

/// Every face that the ray meets within the face's rectangle.
Verdict verdictOf(const Line& l, const Box& box) {
  Verdict verdict;
  const Real3 min = toReal(box.min), max = toReal(box.max);
  bool within = true, strictly = true;
  for (std::size_t i = 0; i < 3; ++i) {
    within = within && min[i] <= l.origin[i] && l.origin[i] <= max[i];
    strictly = strictly && min[i] < l.origin[i] && l.origin[i] < max[i];
    if (l.direction[i].sign() == 0) continue;
    for (int side = 0; side < 2; ++side) {
      const Fraction t = fraction((side ? max : min)[i] - l.origin[i], l.direction[i], BoxFace(1 + 2 * int(i) + side));
      if (t.numerator.sign() < 0) continue;
      bool meets = true;
      for (std::size_t j = 0; j < 3; ++j) {
        if (j == i) continue;
        const Real at = l.origin[j] * t.denominator + l.direction[j] * t.numerator;
        meets = meets && min[j] * t.denominator <= at && at <= max[j] * t.denominator;
      }
      if (meets) verdict.crossings.push_back(t);
    }
  }
  std::stable_sort(verdict.crossings.begin(), verdict.crossings.end());
  for (std::size_t i = 0; i < verdict.crossings.size(); ++i)
    if (i == 0 || verdict.crossings[i - 1] < verdict.crossings[i]) ++verdict.count;
  verdict.startsOn = within && !strictly;
  verdict.startsInside = strictly;
  verdict.touches = verdict.count == 1 && !within;
  return verdict;
}

Real3 normalOf(const Line&, const Plane& p, const Real&) { return toReal(p.normal); }
Real3 normalOf(const Line&, const Triangle& t, const Real&) {
  return cross(toReal(t.b) - toReal(t.a), toReal(t.c) - toReal(t.b));
}
Real3 normalOf(const Line& l, const Sphere& s, const Real& at) {
  return s.radius == 0 ? l.direction * Real(-1) : (l.origin - toReal(s.center)) + l.direction * at;
}
Real3 normalOf(const Line& l, const Ellipsoid& e, const Real& at) {
  const Real a2 = Real(e.equatorial) * e.equatorial, b2 = Real(e.polar) * e.polar;
  const Real3 p = l.origin + l.direction * at;
  return {p[0] / a2, p[1] / a2, p[2] / b2};
}
Real3 normalOf(const Line&, const Box&, const Real&) { return {1, 0, 0}; }  // by the face

Real slackOf(const Sphere& s) { return Real(s.radius) * Real(kHitShare); }
Real slackOf(const Ellipsoid& e) { return Real(std::max(e.equatorial, e.polar)) * Real(kHitShare); }
template <class Flat>
Real slackOf(const Flat&) {
  return 0;
}

template <class Exact>
Verdict withBits(mpfr_prec_t bits, const Ray& ray, const Exact& shape, bool& rounded) {
  Real::bits = bits;
  mpfr_clear_inexflag();
  const Verdict v = verdictOf({toReal(ray.origin), toReal(ray.direction)}, shape);
  rounded = mpfr_inexflag_p() != 0;
  return v;
}

template <class S>
TrueHits trueHitsOf(const Ray& ray, const S& shape) {
  TrueHits result;
  bool rounded = false;
  Verdict v = withBits(kFirstBits, ray, shape, rounded);
  if (rounded) {
    v = withBits(kAllBits, ray, shape, rounded);
    result.wide = true;
  }
  if (rounded) throw std::logic_error("the truth was rounded");
  result.touches = v.touches, result.startsOn = v.startsOn, result.startsInside = v.startsInside;

  // The values: however far -b + sqrt(...) cancels, three times the bits are enough.
  Real::bits = 3 * Real::bits;
  const Line line{toReal(ray.origin), toReal(ray.direction)};
  std::vector<Real> parameters;
  if (v.roots && v.count > 0) {
    const Real root = sqrt(v.roots->b * v.roots->b - v.roots->a * v.roots->c);
    const Real first = (-v.roots->b - root) / v.roots->a, second = (-v.roots->b + root) / v.roots->a;
    if (v.count == 2) parameters = {first, second};
    if (v.count == 1) parameters = {v.startsOn ? Real(0) : v.startsInside ? second : first};
    if (v.count == 2 && v.startsOn) parameters[0] = 0;
  }
  for (std::size_t i = 0; i < v.crossings.size(); ++i)
    if (i == 0 || v.crossings[i - 1] < v.crossings[i])
      parameters.push_back(v.crossings[i].numerator / v.crossings[i].denominator);
  std::size_t crossing = 0;
  for (const Real& t : parameters) {
    TrueHit hit;
    hit.point = line.origin + line.direction * t;
    hit.distance = t * length(line.direction);
    const Real3 normal = normalOf(line, shape, t);
    hit.normal = normal * (Real(1) / length(normal));
    hit.slack = slackOf(shape);
    hit.normalSlack = kHitShare;
    if constexpr (std::is_same_v<S, Ellipsoid>)
      hit.normalSlack = kHitShare * std::max(shape.equatorial / shape.polar, shape.polar / shape.equatorial);
    for (const std::size_t first = crossing; crossing < v.crossings.size(); ++crossing) {
      if (v.crossings[first] < v.crossings[crossing]) break;
      hit.faces.push_back(v.crossings[crossing].face);
    }
    result.hits.push_back(hit);
  }
  Real::bits = Real::kBits;
  return result;
}

}  // namespace

TrueHits trueHits(const Ray& ray, const Shape& shape) {
  return std::visit([&](const auto& s) { return trueHitsOf(ray, s); }, shape);
}

}  // namespace reference
