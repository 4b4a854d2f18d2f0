
#include "input/readings/readings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "catch.hpp"
#include "internals.hpp"
#include "matrix_numbers.hpp"
#include "random.hpp"
#include "viewproj/viewproj.hpp"

using namespace viewproj;
using namespace viewproj::detail;
using namespace viewproj::cmd;

namespace {

Numbers asFloats(Numbers n) {
  for (double& number : n) number = static_cast<double>(static_cast<float>(number));
  return n;
}

bool holds(const Estimate& e, double number) { return e.low <= number && number <= e.high; }

/// Up to what the rounding of the entries leaves of numbers of this size.
bool isNear(double value, double truth, double size) { return std::fabs(value - truth) <= 1e-13 * size; }

Convention preset(const char* name) { return conventionPreset(name).value(); }

Pose somePose(Handedness world) { return lookAt({3, 2, 5}, {-1, 0.5, 0.25}, {0, 1, 0}, world); }

constexpr MatrixKind kKinds[] = {MatrixKind::projection, MatrixKind::view, MatrixKind::worldFromView,
                                 MatrixKind::viewProjection};

Mat4 write(MatrixKind kind, const Pose& pose, const Projection& p, const Convention& c) {
  switch (kind) {
    case MatrixKind::projection:
      return clipFromView(p, c);
    case MatrixKind::view:
      return viewFromWorld(pose, c);
    case MatrixKind::worldFromView:
      return worldFromView(pose, c);
    case MatrixKind::viewProjection:
      return clipFromWorld(pose, p, c);
  }
  return {};
}

/// The readings of a kind that fit a convention, reverseZ included.
std::vector<Reading> fitting(const Inspection& in, MatrixKind kind, const Convention& c, NumberOrder order) {
  std::vector<Reading> result;
  for (const Reading& r : in.readings)
    if (r.kind == kind && fits(r, c, order) && (!r.lens || r.convention.reverseZ == c.reverseZ)) result.push_back(r);
  return result;
}

/// The same parameters, as far as the reading tells them.
void checkParameters(const Reading& r, const Pose& pose, const Projection& p, const Convention& c) {
  if (r.lens) {
    CHECK(r.lens->orthographic == parts(p).orthographic);
    // An orthographic view-projection counts from the world's origin.
    const bool fromOrigin = parts(p).orthographic && r.kind == MatrixKind::viewProjection;
    const DDVec3 eye = toDoubleDouble(pose.eye());
    const auto counted = [&](DoubleDouble number, const DDVec3& axis) {
      return fromOrigin ? (number + dot(axis, eye)).hi : number.hi;
    };
    const double size = std::max({std::fabs(parts(p).left.hi), std::fabs(parts(p).right.hi),
                                  std::fabs(parts(p).bottom.hi), std::fabs(parts(p).top.hi), maxAbs(eye)});
    CHECK(isNear(r.lens->left, counted(parts(p).left, parts(pose).rows.right), size));
    CHECK(isNear(r.lens->right, counted(parts(p).right, parts(pose).rows.right), size));
    CHECK(isNear(r.lens->bottom, counted(parts(p).bottom, parts(pose).rows.up), size));
    CHECK(isNear(r.lens->top, counted(parts(p).top, parts(pose).rows.up), size));
    CHECK(holds(r.lens->near, counted(parts(p).near, parts(pose).rows.forward)));
    CHECK(
        holds(r.lens->far, std::isinf(parts(p).far) ? parts(p).far : counted(parts(p).far, parts(pose).rows.forward)));
  }
  if (!r.pose) return;
  CHECK(r.convention.world == c.world);
  if (r.place->eyeIsKnown)
    for (std::size_t i = 0; i < 3; ++i) CHECK(isNear(r.place->eye[i], pose.eye()[i], maxAbs(pose.eye())));
  const Vec3 got[] = {r.place->right, r.place->up, r.place->forward};
  const Vec3 want[] = {rounded(parts(pose).rows.right), rounded(parts(pose).rows.up),
                       rounded(parts(pose).rows.forward)};
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t i = 0; i < 3; ++i) CHECK(isNear(got[a][i], want[a][i], 1));
}

/// How often a test has met each case.
using Tally = std::map<std::string, int>;

/// Written again in its own convention: near and far are rounded once, so that entries may be an ulp off.
void checkRoundTrip(const Reading& r, const Mat4& m, const Convention& c) {
  const Mat4 again = converted(r, c);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      // A translation is the sum of products of its row's entries with the eye, and of a z row also of depth.
      const double size = j == 3 ? std::fabs(m[i][0]) + std::fabs(m[i][1]) + std::fabs(m[i][2]) : 0;
      if (!(std::fabs(again[i][j] - m[i][j]) <= 2 * halfUlp(std::max(std::fabs(m[i][j]), size)) + 1e-17))
        FAIL_CHECK("row " << i + 1 << ", column " << j + 1 << ": " << again[i][j] << " for " << m[i][j]);
    }
}

}  // namespace

TEST_CASE("Every matrix that can be written has its convention and its parameters among the readings") {
  const Projection lenses[] = {perspectiveFovY(60, DoubleDouble(16) / DoubleDouble(9), 0.1, 1000),
                               perspectiveFovY(60, DoubleDouble(16) / DoubleDouble(9), 0.1, kInfiniteFar),
                               frustum(-1, 3, -0.5, 1.5, 0.7, 90),
                               frustum(-1, 3, -0.5, 1.5, 0.7, kInfiniteFar),
                               orthographic(-16, 16, -9, 9, -3, 100),
                               orthographic(-4, 20, 1, 9, 0.5, 30)};
  int checked = 0;
  for (const ConventionPreset& named : conventionPresets())
    for (const Projection& p : lenses)
      for (bool reverseZ : {false, true})
        for (NdcZ ndcZ : {NdcZ::minusOneToOne, NdcZ::zeroToOne})
          for (Handedness world : {Handedness::right, Handedness::left})
            for (Vectors vectors : {Vectors::column, Vectors::row})
              for (Storage storage : {Storage::columnMajor, Storage::rowMajor})
                for (MatrixKind kind : kKinds) {
                  Convention c = named.convention;
                  c.reverseZ = reverseZ;
                  c.ndcZ = ndcZ;
                  c.world = world;
                  c.vectors = vectors;
                  c.storage = storage;
                  const Pose pose = somePose(c.world);
                  const Mat4 m = write(kind, pose, p, c);
                  INFO(named.name << " kind " << int(kind) << " near " << parts(p).near << " far " << parts(p).far
                                  << " reversed " << reverseZ << " 0..1 " << int(ndcZ));
                  const Inspection memory = inspectMatrix(inStorageOrder(m, c));
                  const Inspection paper = inspectMatrix(rowsOf(laidOut(m, c)));
                  for (const auto& [in, order] :
                       {std::pair{memory, NumberOrder::memory}, std::pair{paper, NumberOrder::rows}}) {
                    const std::vector<Reading> found = fitting(in, kind, c, order);
                    REQUIRE(found.size() == 1);
                    checkParameters(found.front(), pose, p, c);
                    checkRoundTrip(found.front(), m, c);
                    ++checked;
                  }
                }
  CHECK(checked == 11 * 6 * 2 * 2 * 2 * 2 * 2 * 4 * 2);
}

TEST_CASE(
    "A view-projection matrix has one reading a handedness and depth range, and one range where only one can be") {
  // Reversed 0..1 has only that range if far > 2 near; all else can be read with the other range and another near or
  // far.
  struct Row {
    double near, far;
    NdcZ ndcZ;
    bool reverseZ;
    std::size_t ranges;
  };
  const Row rows[] = {
      {0.1, 1000, NdcZ::zeroToOne, true, 1},          {0.1, kInfiniteFar, NdcZ::zeroToOne, true, 1},
      {0.1, 0.15, NdcZ::zeroToOne, true, 2},          {0.1, 1000, NdcZ::minusOneToOne, true, 2},
      {0.1, 1000, NdcZ::zeroToOne, false, 2},         {0.1, 1000, NdcZ::minusOneToOne, false, 2},
      {0.1, kInfiniteFar, NdcZ::zeroToOne, false, 2}, {0.1, kInfiniteFar, NdcZ::minusOneToOne, true, 2},
  };
  for (const Row& row : rows)
    for (Handedness world : {Handedness::right, Handedness::left}) {
      Convention c;
      c.world = world;
      c.ndcZ = row.ndcZ;
      c.reverseZ = row.reverseZ;
      const Inspection in =
          inspectMatrix(rowsOf(clipFromWorld(somePose(world), perspectiveFovY(60, 1.5, row.near, row.far), c)));
      INFO("near " << row.near << " far " << row.far << " reversed " << row.reverseZ);
      CHECK(in.readings.size() == 2 * row.ranges);
      std::size_t ofWorld = 0;
      for (const Reading& r : in.readings) {
        CHECK(r.kind == MatrixKind::viewProjection);
        if (r.convention.world == world) ++ofWorld;
      }
      CHECK(ofWorld == row.ranges);
    }
}

TEST_CASE("Intervals hold near and far of random cameras, in doubles and in float32") {
  Tally tally;
  for (std::uint64_t trial = 0; trial < 1500; ++trial) {
    Random random(trial);
    const bool ortho = random.coin(), infinite = !ortho && random.coin(), single = random.coin();
    const double near = ortho ? random.uniform(-50, 50) : random.logUniform(1e-6, 1e6);
    const double far = infinite ? kInfiniteFar
                       : ortho  ? near + random.logUniform(0.1, 1e4)
                                : near * random.logUniform(1.1, single ? 1e9 : 1e18);
    const double size = random.logUniform(1e-4, 1e4) * (ortho ? 1 : near), aspect = random.logUniform(0.1, 10);
    const double x = random.coin() ? 0 : random.uniform(-1, 1), y = random.coin() ? 0 : random.uniform(-1, 1);
    const double l = size * aspect * (x - 1), r = size * aspect * (x + 1), b = size * (y - 1), t = size * (y + 1);
    const Projection p = ortho ? orthographic(l, r, b, t, near, far) : frustum(l, r, b, t, near, far);
    Convention c;
    c.world = random.coin() ? Handedness::right : Handedness::left;
    c.view = random.coin() ? ViewAxes::RUB : random.coin() ? ViewAxes::RUF : ViewAxes::RDF;
    c.ndcZ = random.coin() ? NdcZ::zeroToOne : NdcZ::minusOneToOne;
    c.reverseZ = random.coin();
    c.ndcY = random.coin() ? NdcY::up : NdcY::down;
    const double reach = random.logUniform(0.1, single ? 1e4 : 1e12);
    const Vec3 eye{reach * random.uniform(-1, 1), reach * random.uniform(-1, 1), reach * random.uniform(-1, 1)};
    const Pose pose =
        lookAlong(eye, {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}, {0.1, 1, 0.2}, c.world);
    INFO("trial " << trial);
    tally["float32"] += single;
    tally["float64"] += !single;
    tally["orthographic"] += ortho;
    tally["infinite"] += infinite;
    tally["off-centre"] += x != 0;
    for (MatrixKind kind : kKinds) {
      Numbers numbers = rowsOf(write(kind, pose, p, c));
      if (single) numbers = asFloats(numbers);
      const Inspection in = inspectMatrix(numbers, single ? EntryPrecision::float32 : EntryPrecision::float64);
      c.storage = Storage::rowMajor;
      const std::vector<Reading> rows = fitting(in, kind, c, NumberOrder::memory);
      REQUIRE(rows.size() == 1);
      if (!rows.front().lens) continue;
      const Estimate& f = rows.front().lens->far;
      // An orthographic view-projection counts from the world's origin.
      const bool fromOrigin = ortho && kind == MatrixKind::viewProjection;
      const auto counted = [&](double distance) {
        return fromOrigin ? (DoubleDouble(distance) + dot(parts(pose).rows.forward, toDoubleDouble(eye))).hi : distance;
      };
      CHECK(holds(rows.front().lens->near, counted(near)));
      CHECK(holds(f, counted(far)));
      tally["far not determined"] += !infinite && std::isinf(f.high);
      tally["far determined"] += !infinite && f.high - f.low < 1e-3 * std::fabs(f.value);
      tally["near not determined"] += rows.front().lens->near.low == 0;
    }
  }
  for (const auto& [name, count] : tally) {
    INFO(name);
    CHECK(count > 0);
  }
  CHECK(tally.size() == 8);
}

TEST_CASE("Intervals are no wider than the rounding of the entries makes them") {
  // Entries moved within half a float32 step, and read as doubles: every value stays inside, some come close to an end.
  constexpr std::uint64_t kTrials = 25;
  Tally tally;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    Random random(trial);
    Convention c;
    c.reverseZ = random.coin();
    c.ndcZ = random.coin() ? NdcZ::zeroToOne : NdcZ::minusOneToOne;
    const double near = random.logUniform(0.01, 10);
    const Projection p =
        frustum(-1.5 * near, near, -near, random.coin() ? near : 2 * near, near, near * random.logUniform(2, 1e4));
    const Pose pose =
        lookAt({random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(1, 9)}, {0, 0, 0}, {0.1, 1, 0.2}, c.world);
    for (MatrixKind kind : {MatrixKind::projection, MatrixKind::viewProjection}) {
      const Numbers numbers = asFloats(rowsOf(write(kind, pose, p, c)));
      c.storage = Storage::rowMajor;
      const auto only = [&](const Numbers& n, EntryPrecision precision) {
        const auto found = fitting(inspectMatrix(n, precision), kind, c, NumberOrder::memory);
        REQUIRE(found.size() == 1);
        return found.front();
      };
      const Reading whole = only(numbers, EntryPrecision::float32);
      const auto parameters = [](const Reading& r) { return std::array<Estimate, 2>{r.lens->near, r.lens->far}; };
      const std::array<Estimate, 2> of = parameters(whole);
      std::array<double, 2> reached{};
      for (int sample = 0; sample < 256; ++sample) {
        Numbers moved = numbers;
        const std::size_t count = kind == MatrixKind::projection ? 12 : 16;  // a w row of 0 0 +-1 0 stays
        for (std::size_t k = 0; k < count; ++k) {
          double& number = moved[k];
          const auto narrow = static_cast<float>(number);
          if (number == 0) continue;
          const double to = static_cast<double>(std::nextafter(narrow, random.coin() ? INFINITY : -INFINITY));
          number += (to - number) / 2;
        }
        const std::array<Estimate, 2> there = parameters(only(moved, EntryPrecision::float64));
        for (std::size_t k = 0; k < of.size(); ++k) {
          const double half = (of[k].high - of[k].low) / 2, off = there[k].value - (of[k].low + half);
          INFO("trial " << trial << " parameter " << k);
          CHECK(std::fabs(off) <= half * (1 + 1e-4));
          reached[k] = std::max(reached[k], std::fabs(off) / half);
        }
      }
      for (std::size_t k = 0; k < of.size(); ++k) {
        INFO("trial " << trial << " kind " << int(kind) << " parameter " << k);
        // A projection's parameter hangs on two or three entries, so that some sample takes all to their ends.
        CHECK(reached[k] > (kind == MatrixKind::projection ? 0.99 : 0.2));
        ++tally[kind == MatrixKind::projection ? "projection" : "viewProjection"];
      }
    }
  }
  CHECK(tally["projection"] == kTrials * 2);
  CHECK(tally["viewProjection"] == kTrials * 2);
}

TEST_CASE("A forward matrix of doubles does not determine a far plane 1e15 or 1e17 times as far as near") {
  for (NdcZ ndcZ : {NdcZ::minusOneToOne, NdcZ::zeroToOne}) {
    Convention c;
    c.ndcZ = ndcZ;
    const auto farOf = [&](double far) {
      const Inspection in = inspectMatrix(rowsOf(clipFromView(perspectiveFovY(60, 1, 1, far), c)));
      for (const Reading& r : in.readings)
        if (r.convention.ndcZ == ndcZ) return r.lens->far;
      FAIL("no reading");
      return Estimate{};
    };
    const Estimate hardly = farOf(1e15);
    CHECK(holds(hardly, 1e15));
    CHECK(hardly.high / hardly.low > 1.1);
    CHECK(hardly.high / hardly.low < 1.4);
    const Estimate none = farOf(1e17);
    CHECK(none.value == kInfiniteFar);
    CHECK(none.high == kInfiniteFar);
    CHECK(none.low > 4e15);
    CHECK(none.low < 2e16);
    // Any far within the interval is written as the same matrix, and one outside is not.
    const auto same = [&](double far, double as) {
      return clipFromView(perspectiveFovY(60, 1, 1, far), c)[2][2] ==
             clipFromView(perspectiveFovY(60, 1, 1, as), c)[2][2];
    };
    CHECK(same(hardly.low * (1 + 1e-9), 1e15));
    CHECK(same(hardly.high * (1 - 1e-9), 1e15));
    CHECK_FALSE(same(hardly.low * (1 - 1e-9), 1e15));
    CHECK_FALSE(same(hardly.high * (1 + 1e-9), 1e15));
    CHECK(same(none.low * (1 + 1e-9), 1e17));
    CHECK_FALSE(same(none.low * (1 - 1e-9), 1e17));
  }
  Convention reversed;
  reversed.ndcZ = NdcZ::zeroToOne;
  reversed.reverseZ = true;
  const Inspection in = inspectMatrix(rowsOf(clipFromView(perspectiveFovY(60, 1, 1, 1e15), reversed)));
  REQUIRE(in.readings.size() == 1);
  CHECK(in.readings[0].lens->far.value == Approx(1e15).epsilon(1e-15));
  CHECK(in.readings[0].lens->far.high / in.readings[0].lens->far.low < 1 + 1e-15);
}

TEST_CASE("near keeps the digits that the matrix has, at any size and any ratio") {
  for (double near : {1e-110, 1e-12, 0.1, 1e30})
    for (double ratio : {1.0000001, 2.0, 1e6, 1e15})
      for (const ConventionPreset& named : conventionPresets()) {
        const Convention& c = named.convention;
        const Inspection in = inspectMatrix(rowsOf(clipFromView(perspectiveFovY(60, 1, near, near * ratio), c)));
        Convention rows = c;
        rows.storage = c.vectors == Vectors::row ? Storage::columnMajor : Storage::rowMajor;
        const auto found = fitting(in, MatrixKind::projection, rows, NumberOrder::memory);
        INFO(named.name << " " << near << " " << ratio);
        REQUIRE(found.size() == 1);
        const Estimate& n = found[0].lens->near;
        CHECK(holds(n, near));
        // near = B / (D - A): the two relative half ulps and no more, D - A cancels only where far is next to near.
        CHECK(n.high - n.low <= 8 * halfUlp(near) * (ratio < 2 ? 1e7 : 1));
      }
}

TEST_CASE("The identity is a view, a pose and a projection, and every reading of it is listed") {
  const Inspection in = inspectMatrix({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
  std::map<MatrixKind, int> kinds;
  for (const Reading& r : in.readings) {
    ++kinds[r.kind];
    CHECK(r.layout == MatrixLayout::either);
  }
  CHECK(kinds ==
        std::map<MatrixKind, int>{{MatrixKind::projection, 6}, {MatrixKind::view, 3}, {MatrixKind::worldFromView, 3}});
}

TEST_CASE("A last entry a few units in the last place from 1 divides a view or a pose, exactly") {
  for (int steps : {-8, -5, -4, -1, 1, 2, 4, 5})
    for (bool turned : {false, true}) {
      const double ulp = 0x1p-52, last = 1 + steps * ulp;
      Numbers n = {0.6,  0, 0.8, 0.36, 0, 1, 0, -0.48,
                   -0.8, 0, 0.6, 0.8,  0, 0, 0, last};  // a translation of unit length
      if (turned)
        for (std::size_t i = 0; i < 4; ++i)
          for (std::size_t j = 0; j < i; ++j) std::swap(n[4 * i + j], n[4 * j + i]);
      const Inspection in = inspectMatrix(n);
      std::size_t poses = 0;
      for (const Reading& r : in.readings) {
        if (r.kind != MatrixKind::view && r.kind != MatrixKind::worldFromView) continue;
        ++poses;
        CHECK(r.layout == (turned ? MatrixLayout::transposed : MatrixLayout::asWritten));
        CHECK(r.scale == last);
        Convention c = preset("opengl");
        c.view = r.convention.view;
        c.world = r.convention.world;
        const Mat4 m = converted(r, c);
        for (std::size_t i = 0; i < 3; ++i)
          for (std::size_t j = 0; j < 4; ++j)
            CHECK(m[i][j] == static_cast<double>(static_cast<long double>(n[turned ? 4 * j + i : 4 * i + j]) / last));
        for (std::size_t i = 0; i < 3; ++i) CHECK(isNear(r.place->eye[i], parts(*r.pose).eye[i], 1));
        CHECK(worldOf(parts(*r.pose)) == r.convention.world);
      }
      CHECK(poses == (steps < -4 || steps > 4 ? 0 : 6));
    }
  // Of float32s it is their units that count.
  const double last = 1 - 2 * 0x1p-23;
  const Numbers n = {0, 0, 1, 3, 0, 1, 0, 4, -1, 0, 0, 5, 0, 0, 0, last};
  CHECK(inspectMatrix(n, EntryPrecision::float32).readings.front().kind == MatrixKind::view);
  CHECK(inspectMatrix(n).readings.front().kind != MatrixKind::view);
}

TEST_CASE("An infinite 0..1 projection with near 1 is symmetric, so that it does not tell its layout") {
  const Inspection in = inspectMatrix(rowsOf(clipFromView(perspectiveFovY(60, 1, 1, kInfiniteFar), preset("metal"))));
  for (const Reading& r : in.readings) CHECK(r.layout == MatrixLayout::either);
  CHECK(in.readings.size() == 2);
}

TEST_CASE("A matrix whose far lies well behind the eye is no projection") {
  // NDC z = 5/6 - 5/6 / W: 0 at 1, and 1 at -5.
  const double o = 5.0 / 6;
  const Inspection in = inspectMatrix({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -o, -o, 0, 0, -1, 0});
  for (const Reading& r : in.readings) CHECK(r.kind != MatrixKind::projection);
  // And 1 + 1/64 - (1 + 1/64) / W: 1 at -65 is a tweaked infinity no more.
  const double q = 1 + 1.0 / 64;
  const Inspection almost = inspectMatrix({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -q, -q, 0, 0, -1, 0});
  for (const Reading& r : almost.readings) CHECK((r.kind != MatrixKind::projection || !r.lens->beyondInfinity));
}

TEST_CASE("A matrix times a number is the same camera, and the number is told") {
  for (MatrixKind kind : {MatrixKind::projection, MatrixKind::viewProjection}) {
    const Convention c = preset("vulkan");
    Numbers numbers = rowsOf(write(kind, somePose(c.world), perspectiveFovY(60, 1, 0.1, 100), c));
    for (double& number : numbers) number *= 8;
    const Inspection in = inspectMatrix(numbers);
    Convention rows = c;
    rows.storage = Storage::rowMajor;
    const auto found = fitting(in, kind, rows, NumberOrder::memory);
    REQUIRE(found.size() == 1);
    CHECK(found[0].scale == Approx(8).epsilon(1e-15));
    CHECK(holds(found[0].lens->near, 0.1));
    CHECK(holds(found[0].lens->far, 100));
  }
}

TEST_CASE("What no camera has written is told with its fault, either way round") {
  const auto fault = [](const Numbers& n) {
    const Inspection in = inspectMatrix(n);
    CHECK(in.readings.empty());
    return in.asWrittenFault;
  };
  CHECK(fault({}).find("w row is 0 0 0 0") != std::string::npos);
  CHECK(fault({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -2}).find("w row is 0 0 0 -2") != std::string::npos);
  CHECK(fault({1, 0.5, 0, 3, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}).find("right angles") != std::string::npos);
  CHECK(fault({1, 0, 0, 3, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}).find("flattens") != std::string::npos);
  // Nothing but rounding is left of x across the picture.
  for (double n : {7.0, 1.1, 1e-3}) {
    CHECK(fault({n, n, n, n, n, n, n, n, n, n, n, n, n, n, n, n}).find("across the picture") != std::string::npos);
    CHECK(fault({1, 0, 0, 0, n, n, n, n, 0, 0, 1, 0, n, n, n, n}).find("across the picture") != std::string::npos);
  }
  CHECK(fault({1, 0, 0, 0, 0, 1, 0, 0, 0.2, 0.1, -1, -0.5, 0, 0, -1, 0}).find("oblique") != std::string::npos);
  CHECK(fault({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -0.5, 100, 0, 0, -1, 0}).find("viewport") != std::string::npos);
  CHECK(fault({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, NAN, 0, 0, -1, 0}).find("finite") != std::string::npos);
}

TEST_CASE("Angles of view come back, from the narrowest to the widest, and only where the window is symmetric") {
  for (double fov : {1e-6, 0.5, 45.0, 60.0, 90.0, 120.0, 179.9, 179.999999})
    for (double aspect : {0.5, 1.0, 1.7}) {
      const Inspection in = inspectMatrix(rowsOf(clipFromView(perspectiveFovY(fov, aspect, 1, 9), {})));
      REQUIRE_FALSE(in.readings.empty());
      const LensEstimate& lens = *in.readings[0].lens;
      INFO(fov << " " << aspect);
      REQUIRE(lens.fovY);
      REQUIRE(lens.fovX);
      // The angle's own rounding and a half ulp of its tangent: no more than that.
      CHECK(std::fabs(*lens.fovY - fov) <= 4 * halfUlp(fov));
      CHECK(std::fabs(lens.aspect - aspect) <= 4 * halfUlp(aspect));
    }
  const Inspection in = inspectMatrix(rowsOf(clipFromView(frustum(-1, 1, -1, 2, 1, 9), {})));
  CHECK(in.readings[0].lens->fovX);
  const LensEstimate& lens = *in.readings[0].lens;
  REQUIRE(lens.fovY);
  // atan(2) + atan(1); 2 atan(1); and between (-1, 2, 1) and (1, -1, 1), as (-1, -1, 1) and (1, 2, 1) are apart.
  CHECK(isNear(*lens.fovX, 90, 90));
  CHECK(isNear(*lens.fovY, 108.43494882292202, 90));
  CHECK(isNear(*lens.fovDiagonal, 118.12550570205571, 90));
  CHECK(isNear((*lens.focalLength)[0], 0.5, 1));
  CHECK(isNear((*lens.focalLength)[1], 1.0 / 3, 1));
  CHECK(isNear((*lens.principalPoint)[0], 0.5, 1));
  CHECK(isNear((*lens.principalPoint)[1], 2.0 / 3, 1));
}
