// Numbers that lie half way between two doubles, or off it by as little as can be said: made of sums that are exact.
#include <functional>

#include "catch.hpp"
#include "internals.hpp"
#include "kernels.hpp"
#include "parts.hpp"
#include "reference/exactness.hpp"
#include "reference/scene.hpp"
#include "viewproj/scene.hpp"

using namespace viewproj;
using namespace viewproj::detail;
using namespace reference;

namespace {

/// What comes out where 1 + small is meant.
struct Case {
  const char* name;
  std::function<double(double small)> got;
};

Camera cameraAt(const Vec3& eye, bool orthographic) {
  const Pose pose = lookAlong(eye, {0, 0, -1}, {0, 1, 0}, Handedness::right);
  Convention convention;
  convention.reverseZ = true;
  return makeCamera(pose,
                    orthographic ? viewproj::orthographic(-2, 2, -2, 2, 1, 9) : perspective(90, 1, 1, kInfiniteFar),
                    {1024, 1024}, convention);
}

const Hit only(const Hits& hits) {
  REQUIRE(hits.count >= 1);
  return hits.hits[0];
}

Ray upFrom(double x, double z) { return {{x, 0, z}, {0, 0, 1}}; }

const Case kCases[] = {
    {"a hit's distance, plane",
     [](double s) {
       return only(intersect(upFrom(0, -s), Plane{{0, 0, 1}, {0, 0, 1}})).distance;
     }},
    {"a hit's distance, slanted plane",
     [](double s) {
       return only(intersect(upFrom(-s, 0), Plane{{0, 0, 1}, {1, 0, 1}})).distance;
     }},
    {"a hit's point, slanted plane",
     [](double s) {
       return only(intersect(upFrom(-s, 0), Plane{{0, 0, 1}, {1, 0, 1}})).point.z;
     }},
    {"a hit's distance, triangle",
     [](double s) {
       return only(intersect(upFrom(0, -s), Triangle{{-4, -4, 1}, {4, -4, 1}, {0, 8, 1}})).distance;
     }},
    {"a hit's distance, box",
     [](double s) {
       return only(intersect(upFrom(0, -s), Box{{-1, -1, 1}, {1, 1, 2}})).distance;
     }},
    {"a hit's distance, sphere",
     [](double s) {
       return only(intersect(upFrom(0, -s), Sphere{{0, 0, 3}, 2})).distance;
     }},
    {"a ray's origin, near plane",
     [](double s) {
       return -screenToRay(cameraAt({0, 0, -s}, false), {512, 512}, RayOrigin::nearPlane).origin.z;
     }},
    {"a ray's origin, orthographic",
     [](double s) {
       return screenToRay(cameraAt({s, 0, 0}, true), {768, 512}).origin.x;
     }},
    {"a ray's origin, orthographic, upwards",
     [](double s) {
       return screenToRay(cameraAt({0, s, 0}, true), {512, 256}).origin.y;
     }},
    {"a point at a distance",
     [](double s) {
       return -screenToWorldAtDistance(cameraAt({0, 0, -s}, false), {512, 512}, 1).position.z;
     }},
    {"a point of a depth",
     [](double s) {
       return -screenToWorld(cameraAt({0, 0, -s}, false), {512, 512}, 1).position.z;
     }},
    {"a point of a depth, aside",
     [](double s) {
       return screenToWorld(cameraAt({s, 0, 0}, false), {1024, 512}, 1).position.x;
     }},
    {"a matrix: screenFromNdc",
     [](double s) {
       return screenFromNdc({2, 1, s, 0}, {})[0][3];
     }},
};

}  // namespace

TEST_CASE("What lies half way between two doubles, or next to it, is within 0.51 ulp, and nearest if off the middle") {
  std::size_t ties = 0, near = 0;
  for (const Case& c : kCases)
    for (int k = 0; k <= 52; ++k)
      for (const double sign : {-1.0, 1.0}) {
        // In this order exact, as a double: the middle between 1 and the next, and 2^-k of it off.
        const double off = k == 0 ? 0 : sign * std::ldexp(0x1p-53, -k);
        const Real truth = Real(1) + Real(0x1p-53) + Real(off);
        const double got = c.got(0x1p-53 + off);
        INFO(c.name << ", 2^-" << k << " off, " << sign);
        CHECK(ulps(got, truth) <= kExactUlps);
        if (k == 0) {
          CHECK((got == 1 || got == 1 + 0x1p-52));
          ++ties;
        } else {
          CHECK(got == double(truth));
          ++near;
        }
      }
  CHECK(ties == 2 * std::size(kCases));
  CHECK(near == 104 * std::size(kCases));
}

TEST_CASE("An entry of a matrix half way between two doubles is one of the two") {
  // 5/8 fx 2/1024, with fx = m 2^-40 and 5 m half way: m = 4 mod 8 where 5 m has 56 bits.
  Mat4 view{{{{0.625, 0.78125, 0, 0}, {-0.78125, 0.625, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}}};
  const Pose pose = poseFromCameraFromWorld(view, CameraAxes::RUB);
  for (double m = 0x1.cp52 + 4; m < 0x1.cp52 + 4000; m += 8) {
    const double fx = m * 0x1p-40;
    const Projection lens = intrinsics(fx, 1000, 512, 512, {1024, 1024}, 1, kInfiniteFar);
    const double got = clipFromWorld(pose, lens, {})[0][0];
    const Real truth = Real(0.625) * Real(fx) * Real(2) / Real(1024);
    INFO(m);
    CHECK(ulps(got, truth) == 0.5);
  }
}
