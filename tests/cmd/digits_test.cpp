// What inspect makes of matrices that were printed to a few digits.
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <string_view>

#include "catch.hpp"
#include "input/matrix_numbers.hpp"
#include "random.hpp"
#include "viewproj/viewproj.hpp"

using namespace viewproj;
using namespace viewproj::detail;
using namespace viewproj::cmd;

namespace {

struct Printed {
  std::string text;
  bool hidesWords = false;  ///< a number came out as a bare 0, 1 or -1 that is none
};

Printed print(const Mat4& m, const char* format) {
  Printed printed;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      char number[64];
      std::snprintf(number, sizeof number, format, m[i][j]);
      const std::string text = number;
      const bool isWord = text == "0" || text == "-0" || text == "1" || text == "-1";
      printed.hidesWords |= isWord && std::strtod(number, nullptr) != m[i][j];
      printed.text += text + (j < 3 ? " " : "\n");
    }
  return printed;
}

struct Known {
  double left, right, bottom, top, near, far;  ///< edges at distance 1, or orthographic lengths
  Vec3 eye;
  bool orthographic;
};

bool holds(const Estimate& e, double number) {
  const double rounding = 1e-12 * std::fabs(number);  // of what the test itself computes
  return e.low - rounding <= number && number <= e.high + rounding;
}

}  // namespace

TEST_CASE("Near and far of a matrix printed to a few digits lie in their intervals") {
  std::map<std::string, int> tally;
  for (std::uint64_t trial = 0; trial < 600; ++trial) {
    Random random(trial);
    Known k{};
    k.orthographic = random.uniform(0, 1) < 0.3;
    const bool centred = random.coin();
    const double width = k.orthographic ? random.logUniform(0.5, 30) : random.uniform(0.3, 2);
    const double height = width / random.uniform(0.5, 2.5);
    const double x = centred ? 0 : width * random.uniform(-0.5, 0.5),
                 y = centred ? 0 : height * random.uniform(-0.5, 0.5);
    k.left = x - width / 2;
    k.right = x + width / 2;
    k.bottom = y - height / 2;
    k.top = y + height / 2;
    k.near = random.logUniform(0.05, 5);
    k.far = k.near * random.logUniform(3, 2000);
    const double reach = random.logUniform(1, 100);
    k.eye = {reach * random.uniform(-1, 1), reach * random.uniform(-1, 1), reach * random.uniform(-1, 1)};
    Convention c;
    c.world = random.coin() ? Handedness::right : Handedness::left;
    c.view = random.coin() ? ViewAxes::RUB : random.coin() ? ViewAxes::RUF : ViewAxes::RDF;
    c.ndcZ = random.coin() ? NdcZ::zeroToOne : NdcZ::minusOneToOne;
    c.reverseZ = random.coin();
    c.ndcY = random.coin() ? NdcY::up : NdcY::down;
    c.storage = Storage::rowMajor;
    const Projection p =
        k.orthographic ? orthographic(k.left, k.right, k.bottom, k.top, k.near, k.far)
                       : frustum(k.left * k.near, k.right * k.near, k.bottom * k.near, k.top * k.near, k.near, k.far);
    const Pose pose =
        lookAlong(k.eye, {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}, {0.1, 1, 0.2}, c.world);
    for (const char* format : {"%.3f", "%.5f", "%.7f", "%.3g", "%.5g", "%.7g"})
      for (const auto& [kind, matrix] : {std::pair(MatrixKind::projection, clipFromView(p, c)),
                                         {MatrixKind::view, viewFromWorld(pose, c)},
                                         {MatrixKind::worldFromView, worldFromView(pose, c)},
                                         {MatrixKind::viewProjection, clipFromWorld(pose, p, c)}}) {
        const Printed printed = print(matrix, format);
        const std::string name = std::string(format) + " kind " + std::to_string(static_cast<int>(kind)) +
                                 (k.orthographic ? " orthographic" : " perspective");
        if (printed.hidesWords) {
          ++tally["as a word"];
          continue;
        }
        INFO("trial " << trial << " " << name << "\n" << printed.text);
        const WrittenMatrices read = parseMatrices(printed.text, "printed");
        REQUIRE(read.matrices.size() == 1);
        const WrittenMatrix& m = read.matrices.front();
        const Inspection in = inspectMatrix(m.numbers, EntryPrecision::float64, m.within);
        const Reading* found = nullptr;
        for (const Reading& r : in.readings) {
          const bool same = r.kind == kind && fits(r, c, NumberOrder::rows) &&
                            (!r.lens || r.convention.reverseZ == c.reverseZ) &&
                            (kind == MatrixKind::projection || r.convention.world == c.world);
          if (same) found = &r;
        }
        // Of three digits some leave no axis.
        const bool isRough = std::string_view(format).starts_with("%.3");
        ++tally[found ? "read" : isRough ? "too rough to read" : "not read"];
        if (!found) continue;
        if (!found->lens) continue;
        const LensEstimate& lens = *found->lens;
        if (k.orthographic && kind == MatrixKind::viewProjection) continue;  // counted from the world's origin
        CHECK(holds(lens.near, k.near));
        CHECK(holds(lens.far, k.far));
      }
  }
  CHECK(tally["read"] > 14000);
  CHECK(tally["as a word"] > 0);
  CHECK(tally["too rough to read"] < 20);
  CHECK(tally["not read"] == 0);
}
