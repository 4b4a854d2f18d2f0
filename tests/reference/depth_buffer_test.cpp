// What a depth buffer resolves, against depths in 480 bits and stored depths counted one by one.
#include "commands/depth/depth_buffer.hpp"

#include <cstdint>
#include <cstring>

#include "catch.hpp"
#include "internals.hpp"
#include "reference/scene.hpp"

using namespace viewproj;
using namespace viewproj::detail;
using namespace viewproj::cmd;
using namespace reference;

namespace {

constexpr DepthFormat kFormats[] = {unormDepth(16), unormDepth(24), kFloatDepth};

/// Window depth by the textbook: A + B/w with the entries of a projection matrix, or A + B w.
struct TrueMapping {
  explicit TrueMapping(const DepthMapping& m) : orthographic(m.orthographic), near(m.near) {
    const Real from(m.atNear), to(m.atFar);
    if (orthographic) {
      b = (to - from) / (Real(m.far) - near);
      a = from - b * near;
    } else if (std::isinf(m.far)) {
      a = to;
      b = (from - to) * near;
    } else {
      a = (Real(m.far) * to - near * from) / (Real(m.far) - near);
      b = Real(m.far) * near * (from - to) / (Real(m.far) - near);
    }
  }
  Real depth(const Real& w) const { return orthographic ? a + b * w : a + b / w; }
  Real distance(const Real& depth) const { return orthographic ? (depth - a) / b : b / (depth - a); }

  bool orthographic;
  Real near, a, b;
};

/// Stored depths by their place in order.
struct Stored {
  DepthFormat format;

  Real value(std::int64_t index) const {
    if (format.step > 0) return Real(static_cast<double>(index)) / Real(std::round(1 / format.step));
    float f;
    const auto bits = static_cast<std::uint32_t>(index);
    std::memcpy(&f, &bits, sizeof f);
    return static_cast<double>(f);
  }
  /// Of the nearest stored depth; 0 for negative ones.
  std::int64_t index(const Real& depth) const {
    if (!(depth > Real(0))) return 0;
    if (format.step > 0)
      return static_cast<std::int64_t>(mpfr_get_si((depth * Real(std::round(1 / format.step))).value(), MPFR_RNDN));
    const float f = mpfr_get_flt(depth.value(), MPFR_RNDN);
    std::uint32_t bits;
    std::memcpy(&bits, &f, sizeof bits);
    return bits;
  }
  /// Where a stored depth ends, towards the next.
  Real edge(std::int64_t index) const { return (value(index) + value(index + 1)) / Real(2); }
};

DepthMapping randomMapping(Random& random) {
  DepthMapping m;
  m.orthographic = random.chance(0.25);
  const double size = random.spread(1e-6, 1e6);
  if (m.orthographic) {
    m.near = size * random.uniform(-1, 1);
    m.far = m.near + size * random.spread(1e-3, 1e3);
  } else {
    m.near = size;
    m.far = random.chance(0.3) ? kInfiniteFar : size * (1 + random.spread(1e-3, 1e15));
  }
  if (random.chance(0.2)) {
    m.atNear = random.uniform(0, 0.5);
    m.atFar = random.uniform(0.6, 1);
  }
  if (random.chance(0.5)) std::swap(m.atNear, m.atFar);
  return m;
}

double randomDistance(Random& random, const DepthMapping& m) {
  if (m.orthographic) return random.uniform(m.near, m.far);
  return std::min(m.far, random.spread(m.near, std::isinf(m.far) ? m.near * 1e12 : m.far));
}

std::string described(const DepthMapping& m) {
  return std::string(m.orthographic ? "orthographic " : "perspective ") + std::to_string(m.near) + " to " +
         std::to_string(m.far) + ", depth " + std::to_string(m.atNear) + " to " + std::to_string(m.atFar);
}

struct Tally {
  int orthographic = 0, infinite = 0, reversed = 0, range = 0, floats = 0, unorm = 0;
  void add(const DepthMapping& m, const DepthFormat& format) {
    orthographic += m.orthographic;
    infinite += std::isinf(m.far);
    reversed += m.atFar < m.atNear;
    range += std::max(m.atNear, m.atFar) != 1;
    (format.step > 0 ? unorm : floats) += 1;
  }
  int least() const { return std::min({orthographic, infinite, reversed, range, floats, unorm}); }
};

}  // namespace

TEST_CASE("Window depth and its slope are those of the projection matrix, at far/near of 1e15 too") {
  for (std::uint64_t trial = 0; trial < 20000; ++trial) {
    Random random(trial + 50000000);
    const DepthMapping m = randomMapping(random);
    const TrueMapping truth(m);
    const double w = randomDistance(random, m);
    INFO("trial " << trial << ": " << described(m) << ", distance " << w);
    CHECK(ulps(depthAtDistance(m, w), truth.depth(w)) <= 0.5001);
    const Real slope = truth.orthographic ? truth.b : -truth.b / (Real(w) * Real(w));
    CHECK(distance(depthSlope(m, w), slope) <= kDepthBufferError * std::fabs(double(slope)));
  }
}

TEST_CASE("Near and far have the ends of the depth range, exactly") {
  for (std::uint64_t trial = 0; trial < 5000; ++trial) {
    Random random(trial + 51000000);
    const DepthMapping m = randomMapping(random);
    INFO("trial " << trial << ": " << described(m));
    CHECK(depthAtDistance(m, m.near) == m.atNear);
    if (std::isfinite(m.far)) CHECK(depthAtDistance(m, m.far) == m.atFar);
  }
}

TEST_CASE("The gap resolved at the far end of a stored depth is that stored depth's own length") {
  Tally tally;
  for (std::uint64_t trial = 0; trial < 20000; ++trial) {
    Random random(trial + 52000000);
    const DepthMapping m = randomMapping(random);
    const TrueMapping truth(m);
    const Stored stored{random.pick(kFormats)};
    const std::int64_t index = stored.index(truth.depth(randomDistance(random, m)));
    if (index < 2) continue;
    // Powers of two have steps of two sizes at their sides.
    if (stored.format.step == 0 && (index & 0x7ffffe) == 0) continue;
    const bool reversed = m.atFar < m.atNear;
    const Real nearer = truth.distance(stored.edge(reversed ? index : index - 1));
    const Real farther = truth.distance(stored.edge(reversed ? index - 1 : index));
    if (nearer < Real(m.near) || farther > Real(m.far) || farther < nearer) continue;
    tally.add(m, stored.format);
    INFO("trial " << trial << ": " << described(m) << ", stored " << index << ", format " << stored.format.step);
    // The end's own rounding to a double moves the gap by its share.
    const double at = double(farther);
    const double truthGap = double(farther - nearer);
    const double slack = stored.format.step == 0 ? 4e-14 : 2e-14;
    CHECK(std::fabs(resolvedGap(m, stored.format, at) - truthGap) <=
          slack * truthGap + 1e-15 * std::fabs(at) * (m.orthographic ? 0 : truthGap / at));
  }
  CAPTURE(tally.orthographic, tally.infinite, tally.reversed, tally.range, tally.floats, tally.unorm);
  CHECK(tally.least() > 1000);
}

TEST_CASE("Surfaces as far apart as is resolved are stored apart, wherever the steps lie") {
  Tally tally;
  int nearlyMerged = 0, pairs = 0;
  for (std::uint64_t trial = 0; trial < 40000; ++trial) {
    Random random(trial + 53000000);
    const DepthMapping m = randomMapping(random);
    const TrueMapping truth(m);
    const Stored stored{random.pick(kFormats)};
    double w = randomDistance(random, m);
    if (random.chance(0.5)) {
      // Next to where a stored depth begins or ends, powers of two among them.
      std::int64_t index = stored.index(truth.depth(w));
      if (stored.format.step == 0 && random.chance(0.5)) index &= ~std::int64_t(0x7fffff);
      const Real edge = stored.edge(std::max<std::int64_t>(index - (random.chance(0.5) ? 1 : 0), 0));
      const double at = double(truth.distance(edge)) * (1 + random.sign() * random.spread(1e-16, 1e-7));
      if (at > m.near && at < m.far) w = at;
    }
    const double gap = resolvedGap(m, stored.format, w) * (1 + kDepthBufferError);
    const Real other = Real(w) - Real(gap) * Real(1 + 1e-13);
    if (other < Real(m.near)) continue;
    ++pairs;
    tally.add(m, stored.format);
    INFO("trial " << trial << ": " << described(m) << ", distance " << w << ", format " << stored.format.step);
    CHECK(stored.index(truth.depth(other)) != stored.index(truth.depth(w)));
    nearlyMerged += stored.index(truth.depth(Real(w) - Real(gap) * Real(0.45))) == stored.index(truth.depth(w));
  }
  CAPTURE(tally.orthographic, tally.infinite, tally.reversed, tally.range, tally.floats, tally.unorm, nearlyMerged);
  CHECK(tally.least() > 1000);
  CHECK(nearlyMerged > pairs / 4);
}

TEST_CASE("An orthographic range next to the end of the doubles is a range like others") {
  const DepthMapping wide{true, -1e300, 1e300, 0, 1};
  CHECK(depthAtDistance(wide, -1e300) == 0);
  CHECK(depthAtDistance(wide, 0) == 0.5);
  CHECK(depthAtDistance(wide, 1e300) == 1);
  CHECK(depthSlope(wide, 0) == Approx(1 / 2e300));
  CHECK(resolvedGap(wide, unormDepth(16), 0) == Approx(2e300 / 65535));
}

TEST_CASE("What the literature says of depth buffers holds") {
  // The OpenGL FAQ's example: near 0.01, far 1000, 16 bits. The last step before far lies at 395.90054.
  const DepthMapping faq{false, 0.01, 1000, 0, 1};
  CHECK(1000 - resolvedGap(faq, unormDepth(16), 1000) == Approx(395.90054).epsilon(1e-7));
  // The usual approximation z^2 / (near 2^bits - z).
  const DepthMapping infinite{false, 1, kInfiniteFar, 0, 1};
  CHECK(resolvedGap(infinite, unormDepth(24), 100) == Approx(100.0 * 100 / (1 << 24)).epsilon(1e-4));
  // float32 and near 0.1 at ten kilometres: 60 m forward, 0.9 mm reversed.
  const DepthMapping forward{false, 0.1, kInfiniteFar, 0, 1}, reversed{false, 0.1, kInfiniteFar, 1, 0};
  CHECK(resolvedGap(forward, kFloatDepth, 1e4) == Approx(60).epsilon(0.02));
  CHECK(resolvedGap(reversed, kFloatDepth, 1e4) == Approx(0.9e-3).epsilon(0.02));
  // Reversing gains nothing in integers, and in float32 the precision becomes that of the distance itself.
  for (double w : {0.2, 3.0, 40.0, 5e3, 6e5}) {
    CHECK(resolvedGap(forward, unormDepth(24), w) == resolvedGap(reversed, unormDepth(24), w));
    CHECK(resolvedGap(reversed, kFloatDepth, w) <= w * 0x1p-23);
  }
}

TEST_CASE("A buffer of 1 to 53 bits has the steps of that many, and of no other number there is one") {
  Real largest = 1;  // 2^bits - 1
  for (int bits = 1; bits <= 53; ++bits, largest = largest + largest + Real(1)) {
    CAPTURE(bits);
    CHECK(unormDepth(bits).step == double(Real(1) / largest));
    CHECK(unormDepth(bits).largest == 1);
    CHECK(integerDepth(bits).step == 1);
    CHECK(integerDepth(bits).largest == double(largest));
  }
  for (const int bits : {0, -1, 54, 64, 1000}) {
    CAPTURE(bits);
    CHECK_THROWS_AS(unormDepth(bits), CameraError);
    CHECK_THROWS_AS(integerDepth(bits), CameraError);
  }
}
