// What makeCamera and its neighbours refuse: a number that is not obeyed is an error, with the field's name.
#include "viewproj/camera.hpp"

#include <cfenv>
#include <cmath>
#include <functional>

#include "catch.hpp"
#include "field_at_fault.hpp"
#include "internals.hpp"
#include "viewproj/geodesy.hpp"
#include "viewproj/viewproj.hpp"

#ifdef __SSE2__
#include <xmmintrin.h>

#endif

using namespace viewproj;
using namespace viewproj::detail;

namespace {

struct Parts {
  Pose pose = lookAt({3, 2, 5}, {0, 0, 0}, {0, 1, 0}, Handedness::right);
  Projection projection = perspective(60, 1.5, 0.1, 100);
  Viewport viewport{600, 400};
  Convention convention;
};

/// "field: message" of the CameraError, "" where there is none.
std::string complaint(const std::function<void(Parts&)>& change) {
  Parts p;
  try {
    change(p);
    makeCamera(p.pose, p.projection, p.viewport, p.convention);
  } catch (const CameraError& e) {
    return e.what();
  }
  return "";
}

struct Row {
  const char* expected;  ///< what the error begins with or, from a space on, contains
  std::function<void(Parts&)> change;
};

std::function<void(Parts&)> lens(double left, double right, double bottom, double top, double near, double far) {
  return [=](Parts& p) { p.projection = perspectiveWindow(left, right, bottom, top, near, far); };
}

std::function<void(Parts&)> box(double left, double right, double bottom, double top, double near, double far) {
  return [=](Parts& p) { p.projection = orthographic(left, right, bottom, top, near, far); };
}

bool fits(const std::string& got, const std::string& expected) {
  const std::size_t space = expected.find(' ');
  return got.starts_with(expected.substr(0, space) + ": ") &&
         (space == std::string::npos || got.find(expected.substr(space + 1)) != std::string::npos);
}

}  // namespace

TEST_CASE("A camera's parts that make none are refused by name") {
  constexpr double kInf = INFINITY, kBig = 1.1e45;
  const Row rows[] = {
      // Poses
      {"pose right-handed world, and the convention's is left-handed",
       [](Parts& p) { p.convention.world = Handedness::left; }},
      {"pose left-handed world, and the convention's is right-handed",
       [](Parts& p) {
         p.pose = lookAt({3, 2, 5}, {0, 0, 0}, {0, 1, 0}, Handedness::left);
       }},
      // Projections
      {"near", lens(-1, 1, -1, 1, -1, 100)},
      {"near", lens(-1, 1, -1, 1, NAN, 100)},
      {"near", lens(-1, 1, -1, 1, kInf, 100)},
      {"far reverseZ", lens(-1, 1, -1, 1, 100, 0.1)},
      {"far", lens(-1, 1, -1, 1, 1, 1)},
      {"far", lens(-1, 1, -1, 1, 1, NAN)},
      {"far", lens(-1, 1, -1, 1, 1, -kInf)},
      {"far finite", box(-1, 1, -1, 1, 0, kInf)},
      {"near", box(-1, 1, -1, 1, -kInf, 1)},
      {"far", box(-1, 1, -1, 1, 2, 1)},
      {"near 1e-45", box(-1, 1, -1, 1, -kBig, 1)},
      {"far 1e-45", lens(-1, 1, -1, 1, 1, kBig)},
      {"right greater than left", lens(1, -1, -1, 1, 1, 2)},
      {"right greater than left", lens(1, 1, -1, 1, 1, 2)},
      {"top greater than bottom", lens(-1, 1, 1e9, 1, 1, 2)},
      {"left", lens(NAN, 1, -1, 1, 1, 2)},
      {"right", lens(-1, kInf, -1, 1, 1, 2)},
      {"bottom", lens(-1, 1, NAN, 1, 1, 2)},
      {"right 1e-45", lens(-1, kBig, -1, 1, 1, 2)},
      {"top 1e-45", lens(-1, 1, 0, 9e-46, 1, 2)},
      {"right window", [](Parts& p) { p.projection = frustum(-1, 1e30, -1, 1, 1e-20, 1); }},
      {"top window", [](Parts& p) { p.projection = frustum(-1, 1, 0, 1e-30, 1e20, 1e21); }},
      // Viewports
      {"viewport.width", [](Parts& p) { p.viewport = {}; }},
      {"viewport.width", [](Parts& p) { p.viewport.width = -600; }},
      {"viewport.width", [](Parts& p) { p.viewport.width = NAN; }},
      {"viewport.height", [](Parts& p) { p.viewport.height = 0; }},
      {"viewport.height", [](Parts& p) { p.viewport.height = kInf; }},
      {"viewport.x", [](Parts& p) { p.viewport.x = NAN; }},
      {"viewport.y", [](Parts& p) { p.viewport.y = -kInf; }},
      {"viewport.pixelCenter", [](Parts& p) { p.viewport.pixelCenter = NAN; }},
      {"viewport.depthRange", [](Parts& p) { p.viewport.depthFirst = NAN; }},
      {"viewport.depthRange", [](Parts& p) { p.viewport.depthSecond = kInf; }},
      {"viewport.depthRange", [](Parts& p) { p.viewport.depthFirst = 1; }},
  };
  CHECK(complaint([](Parts&) {}).empty());
  for (const Row& row : rows) {
    const std::string got = complaint(row.change);
    INFO("expected \"" << row.expected << "\", row " << &row - rows);
    CAPTURE(got);
    CHECK(fits(got, row.expected));
  }
}

TEST_CASE("A thread whose arithmetic is not the library's gets no camera") {
  const auto fieldHere = [] {
    const std::string fault = complaint([](Parts&) {});
    CHECK(fault.empty() == (arithmeticFault() == nullptr));
    return fault.substr(0, fault.find(':'));
  };
  CHECK(arithmeticFault() == nullptr);
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    std::fesetround(mode);
    const std::string field = fieldHere();
    std::fesetround(FE_TONEAREST);
    CAPTURE(mode);
    CHECK(field == "arithmetic");
  }
#ifdef __SSE2__
  for (const unsigned flush : {0x8000u, 0x0040u}) {
    const unsigned control = _mm_getcsr();
    _mm_setcsr(control | flush);
    const std::string field = fieldHere();
    _mm_setcsr(control);
    CAPTURE(flush);
    CHECK(field == "arithmetic");
  }
#endif
  CHECK(arithmeticFault() == nullptr);
}

TEST_CASE("A tile of no picture, or that is none, is refused by name") {
  const Projection lens = perspective(60, 1.5, 0.1, 100);
  const auto fieldOf = [&](const Viewport& viewport, const Crop& crop) -> std::string {
    try {
      cropped(lens, viewport, crop);
    } catch (const CameraError& e) {
      return e.field();
    }
    return "";
  };
  CHECK(fieldOf({600, 400}, {10, 10, 100, 50}).empty());
  CHECK(fieldOf({0, 400}, {10, 10, 100, 50}) == "viewport.width");
  CHECK(fieldOf({600, NAN}, {10, 10, 100, 50}) == "viewport.height");
  CHECK(fieldOf({600, 400}, {NAN, 10, 100, 50}) == "viewport.crop.x");
  CHECK(fieldOf({600, 400}, {10, INFINITY, 100, 50}) == "viewport.crop.y");
  CHECK(fieldOf({600, 400}, {10, 10, -100, 50}) == "viewport.crop.width");
  CHECK(fieldOf({600, 400}, {10, 10, 100, 0}) == "viewport.crop.height");
}

TEST_CASE("An aspect and a tile beyond what doubles can tell apart are refused") {
  for (double aspect : {9e-46, 1.1e45}) CHECK(fieldAtFault([&] { perspective(60, aspect, 0.1, 100); }) == "aspect");
  const Projection lens = perspective(60, 1.5, 0.1, 100);
  CHECK(fieldAtFault([&] { cropped(lens, {1e40, 1}, Crop{0, 0, 1e-10, 1}); }) == "right");
  CHECK(fieldAtFault([&] { cropped(lens, {1, 1e40}, Crop{0, 0, 1, 1e-10}); }) == "top");
}
