// Once a camera is built nothing allocates or throws, and a stack of 64 KiB is enough.
#include <pthread.h>

#include <cstdlib>
#include <new>
#include <vector>

#include "catch.hpp"
#include "internals.hpp"
#include "kernels.hpp"
#include "parts.hpp"
#include "viewproj/geodesy.hpp"
#include "viewproj/scene.hpp"
#include "viewproj/viewproj.hpp"

using namespace viewproj;
using namespace viewproj::detail;

namespace {

std::size_t allocations = 0;

void* counted(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}

}  // namespace

// Arrays come through these, and so does what takes std::nothrow.
void* operator new(std::size_t size) { return counted(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  ++allocations;
  void* memory = nullptr;
  if (::posix_memalign(&memory, static_cast<std::size_t>(alignment), size) != 0) throw std::bad_alloc();
  return memory;
}
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace {

/// How often f allocates, on a thread with little stack, beyond which a guard page ends the program; and so does a
/// throw.
template <class F>
std::size_t allocationsOf(const F& f) {
  pthread_attr_t attributes;
  REQUIRE(pthread_attr_init(&attributes) == 0);
  REQUIRE(pthread_attr_setstacksize(&attributes, 64 * 1024) == 0);
  const auto run = [](void* argument) noexcept -> void* {
    (*static_cast<const F*>(argument))();
    return nullptr;
  };
  const std::size_t before = allocations;
  pthread_t thread;
  const bool isStarted = pthread_create(&thread, &attributes, run, const_cast<F*>(&f)) == 0;
  const bool isJoined = isStarted && pthread_join(thread, nullptr) == 0;
  const std::size_t count = allocations - before;
  REQUIRE(isJoined);
  return count;
}

}  // namespace

TEST_CASE("Nothing allocates, throws or takes much stack once the camera is built") {
  CHECK(allocations > 0);  // by Catch: they are counted
  std::size_t calls = 0;
  const auto none = [&](const char* what, const auto& f) {
    INFO(what);
    CHECK(allocationsOf(f) == 0);
    ++calls;
  };
  const Pose poses[] = {
      lookAt({3, 2, 5}, {0, 0, 0}, {0, 1, 0}, Handedness::right), poseFromHeadingPitchRoll({47, 8, 400}, {10, -20, 30}),
      poseFromCameraFromWorld(viewFromWorld(lookAt({3, 2, 5}, {0, 0, 0}, {0, 1, 0}, Handedness::right), {}),
                              CameraAxes::RUB),
      // Of numbers that take exact arithmetic to its most limbs.
      lookAt({1e40, 2e-40, 3}, {-4e-42, 5, 1e42}, {1e-45, 1, 1e45}, Handedness::right),
      poseFromRotation({1e45, 1e-45, 3}, {1e-45, 1, 1e-20, 1e-40}, CameraAxes::RUB)};
  const Projection lenses[] = {perspective(60, 1.5, 0.1, kInfiniteFar), orthographic(-3, 3, -2, 2, -10, 1e40)};
  for (const Pose& pose : poses)
    for (const Projection& lens : lenses) {
      const Viewport viewport{600, 400};
      const Convention convention;
      const Camera c = makeCamera(pose, lens, viewport, convention);
      const Vec3 eye = pose.eye();
      // In the picture, on the eye plane, behind, not finite: among them what the exact rows settle.
      std::vector<Vec3> points;
      for (int i = 0; i < 1000; ++i) {
        const double w = i % 5 == 0 ? 0 : i % 7 == 0 ? -1 : 0.01 * i;
        const DDVec3 p = toDoubleDouble(eye) + parts(pose).columns.forward * DoubleDouble(w) +
                         parts(pose).columns.right * DoubleDouble(w * (i % 11 - 5) * 0.1);
        points.push_back(rounded(p));
      }
      points[3].x = NAN;
      points[11] = {5e-324, 1e45, -3e-310};
      points[12] = {eye.x, std::nextafter(eye.y, 0), 5e-324};
      std::vector<Vec3> screen(points.size());
      std::vector<ScreenPoint> full(points.size());
      std::vector<Vec2> pixels(points.size(), Vec2{300.5, 17});
      pixels[4].x = 1e45;
      for (const Precision precision : {Precision::standard, Precision::exact}) {
        none("worldToScreen", [&] {
          for (const Vec3& p : points) {
            (void)worldToScreen(c, p, precision);
            (void)worldToScreen(c, Vec4{p.x, p.y, p.z, 0}, precision);
            (void)worldToScreen(c, Vec4{p.x, p.y, p.z, 2}, precision);
            (void)boundOfPoint(c, p, precision);
          }
        });
        none("bounds", [&] { (void)boundInPicture(c, precision); });
        withEachKernel([&](const Kernels& kernel) {
          none(kernel.name, [&] {
            worldToScreen(c, points, screen, precision);
            worldToScreen(c, points, full, precision);
          });
        });
      }
      none("screenToRay", [&] {
        for (const Vec2& p : pixels) (void)screenToRay(c, p, RayOrigin::nearPlane);
      });
      none("batches", [&] { screenToRayDirections(c, pixels, screen); });
      none("screenToWorld", [&] {
        for (const Vec2& p : pixels) {
          (void)screenToWorld(c, p, 0.5);
          (void)screenToWorldAtDistance(c, p, 3);
        }
      });
      none("stages", [&] {
        for (const Vec3& p : points) {
          const Vec4 point{p.x, p.y, p.z, 1};
          for (const Space to : {Space::view, Space::clip, Space::ndc}) (void)worldTo(c, to, point, convention);
        }
      });
      none("matrices", [&] {
        constexpr Space kSpaces[] = {Space::world, Space::view, Space::clip, Space::screen};
        for (const Space to : kSpaces)
          for (const Space from : kSpaces) {
            (void)storedMatrix<float>(c, to, from);
            (void)inStorageOrder(matrix(c, to, from), convention);
          }
      });
      const Frustum f = viewFrustum(c);
      none("the scene", [&] {
        const Ray ray = screenToRay(c, {10, 20});
        for (const Vec3& p : points) {
          (void)cull(f, p);
          (void)cull(f, Sphere{p, 1});
          (void)cull(f, Box{eye, p});
          (void)cull(f, Triangle{eye, p, {1, 2, 3}});
          (void)intersect(ray, Plane{p, {0, 1, 0}});
          (void)intersect(ray, Sphere{p, 1});
          (void)intersect(ray, Box{eye, p});
          (void)intersect(ray, Triangle{eye, p, {1, 2, 3}});
          (void)intersect(ray, kWgs84);
          (void)intersect(Ray{{-1e45, 1e-45, 0}, {1, 0, 0}}, Sphere{{0, 0, 0}, 1e-45});
          (void)intersect(Ray{{0, 0, 5e-324}, {1e-300, 1e40, 1}}, Box{{0, 0, 0}, {1e-310, 1e45, 1e30}});
          (void)clipSegment(f, eye, p);
          (void)pointAlong(eye, p, 0.25);
        }
      });
      none("places", [&] {
        (void)geodeticToEcef({47, 8, 400});
        (void)ecefToGeodetic(eye);
        (void)exactNormal({47, 8, 400});
      });
    }
  CHECK(calls > 100);
}
