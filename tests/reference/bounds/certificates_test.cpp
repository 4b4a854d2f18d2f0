// exact, next to the middle between two doubles: cameras and points made so that a number's true value lies there, or
// off it by as little as is wished; one by one, and by each kernel.
//
// A pose matrix's translation moves X, Y and W by as much as it says, however small, and so brings any number to where
// it is wanted. What a kernel calls settled must be the nearest double, and must lie farther from the middle than the
// error that the derivation in error_model.hpp allows for, twice (here written out once more); what it does not must
// lie nearer. A constant of half the size is found out that way.
#include <bit>
#include <cstdio>
#include <vector>

#include "catch.hpp"
#include "internals.hpp"
#include "kernels.hpp"
#include "projection/kernels/kernels.hpp"
#include "reference/bounds/oracle.hpp"

using namespace viewproj;
using namespace viewproj::detail;
using namespace reference;

namespace {

enum Number { screenX, screenY, depth, viewDistance, kNumbers };
constexpr const char* kNames[] = {"x", "y", "depth", "distance"};

/// Rows of few bits: (20 25 0) / 32 and (-25 20 0) / 32 are orthogonal, and a thousandth longer than 1.
Scene dyadicScene(Random& r, bool orthographic, bool forwardIsAxis) {
  Scene s;
  s.poseKind = PoseKind::cameraFromWorld;
  double rows[3][3] = {{0.625, 0.78125, 0}, {-0.78125, 0.625, 0}, {0, 0, 1}};
  std::size_t order[3] = {0, 1, 2};
  if (!forwardIsAxis) std::swap(order[r.chance(0.5) ? 0 : 1], order[2]);
  if (r.chance(0.5)) std::swap(order[0], order[1]);
  const std::size_t turn = std::size_t(r.uniform(0, 3));
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) s.matrix[i][(j + turn) % 3] = rows[order[i]][j];
  const auto& m = s.matrix;
  const double determinant = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                             m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                             m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  if (determinant < 0)
    for (std::size_t j = 0; j < 3; ++j) s.matrix[0][j] *= -1;
  s.matrix[3] = {0, 0, 0, 1};
  s.lensKind = orthographic ? LensKind::orthographic : LensKind::frustum;
  s.viewport = {1024, 512};
  s.viewport.origin = r.chance(0.5) ? Origin::topLeft : Origin::bottomLeft;
  s.near = orthographic ? 0 : std::ldexp(1, int(r.uniform(-4, 4)));
  s.far = orthographic ? std::ldexp(1, int(r.uniform(0, 9))) : kInfiniteFar;
  s.convention.reverseZ = r.chance(0.5);
  return s;
}

/// Windows of powers of two, so that scales are, and the centre is where doubles are fine or where they are coarse; or
/// any window.
void setWindow(Random& r, Scene& s, bool isDyadic) {
  const double size = std::ldexp(1, int(r.uniform(-3, 10)));
  const double far = r.chance(0.4) ? 0 : std::floor(r.spread(1, r.chance(0.4) ? 1000 : 1e9));
  s.left = far * size, s.right = s.left + size;
  s.bottom = r.chance(0.5) ? 0 : -size / 2, s.top = s.bottom + size;
  if (isDyadic) return;
  s.left *= r.uniform(0.9, 1), s.right = s.left + size * r.uniform(1, 2);
  s.bottom -= r.uniform(0, 1), s.top += r.uniform(0, 1);
}

double fewBits(Random& r, double size) { return std::floor(r.uniform(-16, 16)) * size / 16; }

/// In front, and mostly where two terms of a row cancel: then the rows' errors count most.
Vec3 pointOf(Random& r, const Scene& s, bool isPlain) {
  for (;;) {
    Vec3 p{fewBits(r, 8), fewBits(r, 8), fewBits(r, 8)};
    const auto& row = s.matrix[std::size_t(r.uniform(0, 3))];
    const double large = r.chance(0.3) || isPlain ? 0 : r.sign() * std::ldexp(1, int(r.uniform(0, 30)));
    std::size_t a = 0;
    while (row[a] == 0 && a < 2) ++a;
    const std::size_t b = row[(a + 1) % 3] != 0 ? (a + 1) % 3 : (a + 2) % 3;
    p[a] += 32 * row[b] * large, p[b] -= 32 * row[a] * large;
    const auto& back = s.matrix[2];
    double w = -(back[0] * p.x + back[1] * p.y + back[2] * p.z);
    if (isPlain && w != 0) {
      const std::size_t axis = back[0] != 0 ? 0 : back[1] != 0 ? 1 : 2;
      p[axis] = -back[axis] * std::ldexp(1, int(r.uniform(0, 4)));
      w = std::fabs(p[axis]);
    }
    if (w > 0) return p;
  }
}

TrueNumber ofNumber(const Oracle::Answer& a, Number n) {
  return n == screenX ? a.x : n == screenY ? a.y : n == depth ? a.depth : a.forward;
}

double ulpOf(double a) { return std::nextafter(std::fabs(a), INFINITY) - std::fabs(a); }

/// How far a number is from the nearer of the middles to the doubles beside it.
double fromMiddle(const TrueNumber& n) {
  const double above = ulpOf(n.hi) / 2, below = (std::fabs(n.hi) - std::nextafter(std::fabs(n.hi), 0)) / 2;
  const double outward = n.hi < 0 ? -n.lo : n.lo;
  return std::min(std::fabs(above - outward), std::fabs(below + outward));
}

Oracle::Answer answerOf(const Scene& s, const Vec3& p) { return Oracle(Truth(s), 400).at(p); }

/// Moves the scene so that a number lies this far from the middle above it, up to second order. false: out of reach.
bool steer(Scene& s, const Vec3& p, Number n, double off) {
  const Oracle::Answer at = answerOf(s, p);
  if (!at.inFront) return false;
  const TrueNumber now = ofNumber(at, n);
  const double up = now.hi < 0 ? -1 : 1;
  const double step = (up * ulpOf(now.hi) / 2 - now.lo) + off;
  const double w = at.forward.hi;
  const bool orthographic = s.lensKind == LensKind::orthographic;
  const double perWindowX = s.viewport.width / ((s.right - s.left) / (orthographic ? 1 : s.near));
  const double perWindowY = s.viewport.height / ((s.top - s.bottom) / (orthographic ? 1 : s.near));
  if (n == screenX) s.matrix[0][3] += step / perWindowX * (orthographic ? 1 : w);
  if (n == screenY)
    s.matrix[1][3] += step / perWindowY * (orthographic ? 1 : w) * (s.viewport.origin == Origin::topLeft ? -1 : 1);
  if (n == viewDistance) s.matrix[2][3] -= step;
  if (n == depth) {
    const double sign = s.convention.reverseZ ? -1 : 1;
    s.matrix[2][3] -= sign * (orthographic ? step * (s.far - s.near) : step * w * (w / s.near));
  }
  return true;
}

/// What the derivations allow for, twice: 13 units of 2^-77 for a dot product and what follows it, 2^-76 for a
/// quotient, 2^-97 for a parameter.
struct Allowed {
  double of[kNumbers];
  double ofOne[kNumbers];  ///< of it, the centre's or the offset's part

  Allowed(const ProjectionConstants& k, const Vec3& p, const Oracle::Answer& at) {
    constexpr double dot = 2 * 13 * 0x1p-77, quotient = 2 * 0x1p-76, parameter = 2 * 0x1p-97;
    const double D = std::fabs(p.x - k.eye.x) + std::fabs(p.y - k.eye.y) + std::fabs(p.z - k.eye.z) + k.residualReach;
    const double w = at.forward.hi, ofW = k.forwardIsAxis ? 0 : dot * k.sizeW * D;
    const double center = parameter * std::max(k.reachX, k.reachY), offset = parameter * std::fabs(k.depthOffset.hi);
    const double scale = std::fabs(k.depthScale.hi);
    const double ofXY =
        k.orthographic ? dot * k.sizeXY * D : (dot + quotient) * k.sizeXY * (D / w) + k.sizeXY * (D / w) * (ofW / w);
    of[screenX] = of[screenY] = ofXY + center;
    of[depth] = (k.orthographic ? scale * (ofW + parameter * std::fabs(w)) : scale / w * (ofW / w + quotient)) + offset;
    of[viewDistance] = ofW;
    ofOne[screenX] = ofOne[screenY] = center;
    ofOne[depth] = offset;
    ofOne[viewDistance] = 0;
  }
};

/// What a kernel makes of many copies of one point.
struct KernelRun {
  static constexpr std::size_t kCopies = 21;
  std::size_t unsettled = 0;
  std::vector<double> screen = std::vector<double>(3 * kCopies), distances = std::vector<double>(kCopies);

  KernelRun(const Kernels& kernel, const Camera& c, const Vec3& p, bool withDistance) {
    const std::vector<Vec3> points(kCopies, p);
    std::uint64_t lanes = 0;
    kernel.exact(parts(c).constants, kNoBand, kNoBand, &points[0].x, screen.data(),
                 withDistance ? distances.data() : nullptr, kCopies, &lanes);
    unsettled = static_cast<std::size_t>(std::popcount(lanes));
  }
};

struct Tally {
  std::size_t ties = 0, nearTies = 0, uncertain = 0;  ///< nearTies: 2^-110 to 2^-45 of an ulp off the middle
  std::size_t settledNextToBorder = 0, leftNextToBorder = 0;
  std::size_t byOne = 0, byW = 0;  ///< most of what is allowed for is the centre's or the offset's, or W's
};

bool isNearest(double got, const TrueNumber& truth) {
  return got == truth.hi || (fromMiddle(truth) == 0 && errorOf(got, truth) <= ulpOf(truth.hi) / 2);
}

}  // namespace

TEST_CASE("exact, next to the middle between two doubles, one by one and by each kernel") {
  constexpr std::uint64_t kTrials = 20000;
  Tally tallies[2][kNumbers];
  double nearestSettled = INFINITY, farthestLeft = 0, worstUncertain = 0;
  std::size_t byBatch = 0;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    Random r(trial);
    const bool orthographic = trial % 2, isTie = trial / 8 % 4 == 0, forwardIsAxis = r.chance(0.4);
    const Number number = Number(trial / 2 % kNumbers);
    Scene scene = dyadicScene(r, orthographic, (isTie && !orthographic && number < depth) || forwardIsAxis);
    setWindow(r, scene, isTie || r.chance(0.5));
    Vec3 point = pointOf(r, scene, isTie && !orthographic);
    const bool isNearTie = isTie && r.chance(0.5);
    const std::size_t fine = std::size_t(r.uniform(0, 3));
    if (isNearTie) point[fine] = 0;
    Oracle::Answer truth = answerOf(scene, point);
    // To the middle, or off it by about what the kernels allow for.
    double off = 0;
    if (!isTie) {
      const double allowed = Allowed(parts(build(scene)).constants, point, truth).of[number];
      off = r.sign() * std::max(allowed, 0x1p-104 * std::fabs(ofNumber(truth, number).hi)) *
            (r.chance(0.5) ? r.uniform(0.3, 2) : r.spread(1e-4, 1e2));
    }
    if (!steer(scene, point, number, off)) continue;
    if (isNearTie) point[fine] = r.sign() * std::ldexp(1, -int(r.uniform(100, 165)));  // in the middle, but for that
    truth = answerOf(scene, point);
    if (!truth.inFront) continue;
    const Camera camera = build(scene);
    const ProjectionConstants& k = parts(camera).constants;
    const Allowed allowed(k, point, truth);
    Tally& tally = tallies[orthographic][number];
    INFO("trial " << trial << ", " << (orthographic ? "orthographic " : "perspective ") << kNames[number]);

    double margin[kNumbers];
    for (int n = 0; n < kNumbers; ++n)
      margin[n] = allowed.of[n] > 0 ? fromMiddle(ofNumber(truth, Number(n))) / allowed.of[n] : INFINITY;
    const double least = std::min({margin[screenX], margin[screenY], margin[depth]});
    for (const Kernels* kernel : supportedKernels()) {
      for (const bool withDistance : {false, true}) {
        const KernelRun run(*kernel, camera, point, withDistance);
        REQUIRE((run.unsettled == 0 || run.unsettled == KernelRun::kCopies));
        const double of = withDistance ? std::min(least, margin[viewDistance]) : least;
        if (run.unsettled) {
          farthestLeft = std::max(farthestLeft, of);
          tally.leftNextToBorder += of > 0.8;
          REQUIRE(of < 1.1);
          continue;
        }
        nearestSettled = std::min(nearestSettled, of);
        tally.settledNextToBorder += of < 1.25;
        REQUIRE(of > 0.9);
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < KernelRun::kCopies; ++i)
          wrong += run.screen[3 * i] != truth.x.hi || run.screen[3 * i + 1] != truth.y.hi ||
                   run.screen[3 * i + 2] != truth.depth.hi ||
                   (withDistance && !isNearest(run.distances[i], truth.forward));
        REQUIRE(wrong == 0);
      }
    }

    const ScreenPoint got = worldToScreen(camera, point);
    const double numbers[] = {got.x, got.y, got.depth, got.viewDistance};
    for (int n = 0; n < kNumbers; ++n) {
      const TrueNumber number_ = ofNumber(truth, Number(n));
      if (got.certain) {
        REQUIRE(isNearest(numbers[n], number_));
        continue;
      }
      // A number that cancels is exact to a share of the picture, of the depth range or of near and far.
      const double sizes[] = {1024, 1024, 1, k.farthest};
      const double error = errorOf(numbers[n], number_), ulps = error / ulpOf(number_.hi);
      if (error <= kExactAbsolute * sizes[n]) continue;
      worstUncertain = std::max(worstUncertain, ulps);
      REQUIRE(ulps <= kExactUlps);
    }
    const TrueNumber sought = ofNumber(truth, number);
    // To 106 bits; 0 is its own double, and no middle.
    const bool isOnMiddle = sought.hi != 0 && fromMiddle(sought) == 0;
    tally.ties += isOnMiddle && !isNearTie;
    tally.nearTies += isNearTie && fromMiddle(sought) < 0x1p-45 * ulpOf(sought.hi);
    tally.uncertain += !got.certain;
    if (isOnMiddle && number != viewDistance) REQUIRE(!got.certain);

    // A batch tells how many of its points are so, in both of its forms.
    const std::vector<Vec3> points(3, point);
    std::vector<Vec3> positions(3);
    std::vector<ScreenPoint> inFull(3);
    const BatchCounts counts = worldToScreen(camera, points, std::span(positions));
    const BatchCounts countsInFull = worldToScreen(camera, points, std::span(inFull));
    REQUIRE(countsInFull.uncertain == (got.certain ? 0 : 3));
    REQUIRE(countsInFull.escalated >= countsInFull.uncertain);
    // Where the distance alone is uncertain, a batch of positions does not ask for it.
    REQUIRE((counts.escalated == 0 || counts.escalated == 3));
    REQUIRE(counts.uncertain == (got.certain ? 0 : counts.escalated));
    if (isOnMiddle && number != viewDistance) REQUIRE(counts.uncertain == 3);
    byBatch += counts.uncertain;

    tally.byOne += allowed.ofOne[number] > 0.7 * allowed.of[number];
    tally.byW += allowed.of[viewDistance] > 0.8 * allowed.of[number];
  }
  for (const bool orthographic : {false, true})
    for (const Number n : {screenX, screenY, depth, viewDistance}) {
      const Tally& t = tallies[orthographic][n];
      const std::string name = (orthographic ? "orthographic " : "perspective ") + std::string(kNames[n]);
      std::printf(
          "%-22s ties %zu and %zu next to one, uncertain %zu; next to the border: settled %zu, left %zu; by one term "
          "%zu, by W %zu\n",
          name.c_str(), t.ties, t.nearTies, t.uncertain, t.settledNextToBorder, t.leftNextToBorder, t.byOne, t.byW);
      INFO(name);
      CHECK(t.ties > 2);
      CHECK(t.nearTies > 2);
      CHECK(t.uncertain > 300);
      CHECK(t.settledNextToBorder > 200);
      CHECK(t.leftNextToBorder > 200);
      if (n != viewDistance && (n == depth) != orthographic) CHECK(t.byOne > 60);
      if (n >= depth || !orthographic) CHECK(t.byW > 100);
    }
  std::printf("settled from %.3f of the error allowed for, left up to %.3f; uncertain up to %.3f ulp\n", nearestSettled,
              farthestLeft, worstUncertain);
  CHECK(byBatch > 1000);
}
