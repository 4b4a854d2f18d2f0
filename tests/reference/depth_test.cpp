// What a depth buffer resolves, against depths in 480 bits and stored depths counted one by one.
#include "commands/depth.hpp"

#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "reference/scene.hpp"
#include "text/error.hpp"

using namespace viewproj;
using namespace viewproj::cmd;
using namespace reference;

namespace {

/// Of everything that the report computes.
constexpr double kRelativeError = 1e-14;

DepthMapping mappingOf(double near, double far, double atNear = 0, double atFar = 1, NdcZ ndcZ = NdcZ::zeroToOne) {
  return {perspectiveWindow(-1, 1, -1, 1, near, far), atNear, atFar, ndcZ};
}

DepthMapping randomMapping(Random& random) {
  const double size = random.logUniform(1e-6, 1e6);
  DepthMapping m = mappingOf(size, random.chance(0.3) ? kInfiniteFar : size * (1 + random.logUniform(1e-3, 1e15)));
  if (random.chance(0.25)) {
    const double near = size * random.uniform(-1, 1);
    m.projection = orthographic(-1, 1, -1, 1, near, near + size * random.logUniform(1e-3, 1e3));
  }
  if (random.chance(0.2)) {
    m.atNear = random.uniform(0, 0.5);
    m.atFar = random.uniform(0.6, 1);
  }
  if (random.chance(0.5)) std::swap(m.atNear, m.atFar);
  return m;
}

double randomDistance(Random& random, const Projection& p) {
  if (p.isOrthographic()) return random.uniform(p.zNear(), p.zFar());
  return std::min(p.zFar(), random.logUniform(p.zNear(), std::isinf(p.zFar()) ? p.zNear() * 1e12 : p.zFar()));
}

/// Window depth by the textbook: A + B/w with the entries of a projection matrix, or A + B w.
struct TrueMapping {
  TrueMapping(const DepthMapping& m, bool reversed) : orthographic(m.projection.isOrthographic()) {
    const Real near = m.projection.zNear(), far = m.projection.zFar();
    const auto [low, high] = std::minmax(m.atNear, m.atFar);
    const Real from = reversed ? high : low, to = reversed ? low : high;
    if (orthographic) {
      b = (to - from) / (far - near);
      a = from - b * near;
    } else if (std::isinf(m.projection.zFar())) {
      a = to;
      b = (from - to) * near;
    } else {
      a = (far * to - near * from) / (far - near);
      b = far * near * (from - to) / (far - near);
    }
  }
  explicit TrueMapping(const DepthMapping& m) : TrueMapping(m, m.atFar < m.atNear) {}
  Real depth(const Real& w) const { return orthographic ? a + b * w : a + b / w; }

  bool orthographic;
  Real a, b;
};

OrderedJson rowAt(const DepthMapping& m, double distance) {
  return depthReport(m, std::span(&distance, 1))["distances"][0];
}
double at(const DepthMapping& m, double distance, const char* name) { return rowAt(m, distance)[name].get<double>(); }

}  // namespace

TEST_CASE("Window depth and its slope are those of the projection matrix, and near and far have the range's ends") {
  for (std::uint64_t trial = 0; trial < 20000; ++trial) {
    Random random(trial + 50000000);
    const DepthMapping m = randomMapping(random);
    const TrueMapping truth(m);
    const double w = randomDistance(random, m.projection);
    INFO("trial " << trial << ", distance " << w);
    const OrderedJson row = rowAt(m, w);
    CHECK(ulps(row["depth"].get<double>(), truth.depth(w)) <= 0.5001);
    const Real slope = truth.orthographic ? truth.b : -truth.b / (Real(w) * Real(w));
    CHECK(distance(row["slope"].get<double>(), slope) <= kRelativeError * std::fabs(double(slope)));
    CHECK(at(m, m.projection.zNear(), "depth") == m.atNear);
    if (std::isfinite(m.projection.zFar())) CHECK(at(m, m.projection.zFar(), "depth") == m.atFar);
  }
}

TEST_CASE("A depth is turned into its distance, and one that no buffer of the range holds is refused") {
  for (std::uint64_t trial = 0; trial < 10000; ++trial) {
    Random random(trial + 55000000);
    const DepthMapping m = randomMapping(random);
    const TrueMapping truth(m);
    const double depth = m.atNear + (m.atFar - m.atNear) * random.uniform(0, 0.999);
    INFO("trial " << trial << ", depth " << depth);
    const double distance = distanceReport(m, std::span(&depth, 1))["depths"][0]["distance"].get<double>();
    const Real expected = truth.orthographic ? (Real(depth) - truth.a) / truth.b : truth.b / (Real(depth) - truth.a);
    CHECK(reference::distance(distance, expected) <= 1e-15 * (std::fabs(distance) + std::fabs(m.projection.zNear())));
  }
  const DepthMapping infinite = mappingOf(0.1, kInfiniteFar, 1, 0);
  const double ends[] = {1, 0};
  const OrderedJson report = distanceReport(infinite, ends);
  CHECK(report["depths"][0]["distance"] == 0.1);
  CHECK(std::isinf(report["depths"][1]["distance"].get<double>()));
  for (const double beyond : {1.5, -0.5, double(NAN)})
    CHECK_THROWS_AS(distanceReport(infinite, std::span(&beyond, 1)), UsageError);
}

TEST_CASE("The gap of a buffer is the length over which it stores one value, counted, and no shorter") {
  int counted = 0, tight = 0;
  for (std::uint64_t trial = 0; trial < 800; ++trial) {
    Random random(trial + 57000000);
    DepthMapping m = randomMapping(random);
    if (random.chance(0.3)) m.ndcZ = NdcZ::minusOneToOne;
    const auto [low, high] = std::minmax(m.atNear, m.atFar);
    const double w = randomDistance(random, m.projection);
    const auto isStoredAs = [&, low = low, high = high](std::string_view buffer, double depth) {
      if (buffer == "d16" || buffer == "d24") return std::round(depth * (buffer == "d16" ? 65535 : 16777215));
      if (m.ndcZ == NdcZ::zeroToOne) return double(static_cast<float>(depth));
      const double ndc = static_cast<float>(2 * (depth - low) / (high - low) - 1);
      return double(static_cast<float>(low + (high - low) * (ndc + 1) / 2));
    };
    for (const char* const buffer : {"d16", "d24", "f32", "f32Reversed"}) {
      const bool isFloat = *buffer == 'f';
      const TrueMapping truth = isFloat ? TrueMapping(m, buffer[3] == 'R') : TrueMapping(m);
      const auto stored = [&](const Real& v) { return isStoredAs(buffer, double(truth.depth(v))); };
      const double gap = at(m, w, buffer), value = stored(w);
      // From w to the last distance towards near, or far, of the same value.
      const auto end = [&](double step) {
        Real inside = w, outside = Real(w) + Real(step);
        for (int i = 0; i < 50; ++i) {
          const Real middle = (inside + outside) / Real(2);
          (stored(middle) == value ? inside : outside) = middle;
        }
        return inside;
      };
      const Real first = end(-3 * gap), last = end(3 * gap);
      if (!(first > Real(m.projection.zNear()) && last < Real(m.projection.zFar())) ||
          stored(Real(w) - Real(3 * gap)) == value)
        continue;
      INFO("trial " << trial << ", " << buffer << ", distance " << w);
      const double reported = at(m, double(last), buffer), share = double(last - first) / reported;
      CHECK(share < 1 + 1e-6);
      ++counted;
      if (share > 0.9) ++tight;
    }
  }
  CHECK(counted > 1500);
  CHECK(tight > counted / 3);
}

TEST_CASE("With the near plane of a gap the buffer resolves it, and with one a little nearer it does not") {
  int found = 0, any = 0, none = 0;
  for (std::uint64_t trial = 0; trial < 400; ++trial) {
    Random random(trial + 58000000);
    DepthMapping m = randomMapping(random);
    if (m.projection.isOrthographic()) continue;
    if (random.chance(0.3)) m.ndcZ = NdcZ::minusOneToOne;
    const double w = randomDistance(random, m.projection), gap = w * random.logUniform(1e-9, 2);
    const OrderedJson row = nearReport(m, gap, std::span(&w, 1))["nears"][0];
    for (const char* const buffer : {"d16", "d24", "f32", "f32Reversed"}) {
      INFO("trial " << trial << ", " << buffer << ", distance " << w << ", gap " << gap);
      const auto gapWith = [&](double near) {
        DepthMapping there = m;
        there.projection = perspectiveWindow(-1, 1, -1, 1, near, m.projection.zFar());
        return at(there, w, buffer);
      };
      const double near = row[buffer].get<double>();
      if (std::isnan(near)) {
        CHECK(!(gapWith(w * (1 - 0x1p-19)) <= gap * (1 - 1e-5)));
        ++none;
      } else if (near == 0) {
        CHECK(gapWith(w * 1e-19) <= gap * 2);  // a step may double below
        ++any;
      } else {
        CHECK(gapWith(near) <= gap);
        CHECK(!(gapWith(near * (1 - 1e-15)) <= gap));
        ++found;
      }
    }
  }
  CHECK(std::min({found, any, none}) > 50);
}
