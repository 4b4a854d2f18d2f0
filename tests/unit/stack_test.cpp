// What is noexcept runs on a thread with little stack.
#ifndef _WIN32
#include <pthread.h>

#include <functional>

#include "catch.hpp"
#include "viewproj/geodesy.hpp"
#include "viewproj/matrices.hpp"
#include "viewproj/scene.hpp"
#include "viewproj/viewproj.hpp"

using namespace viewproj;

namespace {

/// On a thread of 64 KiB, beyond which a guard page ends the program.
void onSmallThread(const std::function<void()>& work) {
  pthread_attr_t attributes;
  REQUIRE(pthread_attr_init(&attributes) == 0);
  REQUIRE(pthread_attr_setstacksize(&attributes, 64 * 1024) == 0);
  pthread_t thread;
  const auto run = [](void* argument) -> void* {
    (*static_cast<const std::function<void()>*>(argument))();
    return nullptr;
  };
  REQUIRE(pthread_create(&thread, &attributes, run, const_cast<std::function<void()>*>(&work)) == 0);
  REQUIRE(pthread_join(thread, nullptr) == 0);
}

}  // namespace

TEST_CASE("Points, rays, matrices and shapes that take exact arithmetic run on a thread of 64 KiB") {
  Mat4 view{{{{0.6, 0.8, 0, 0.1}, {-0.8, 0.6, 1e-70, 0.2}, {0, 1e-80, 1, 1e70}, {0, 0, 0, 1}}}};
  const Pose poses[] = {
      lookAt({1e70, 2e-70, 3}, {-4e-80, 5, 1e80}, {1e-90, 1, 1e90}, Handedness::right),
      lookAtPlace({47.3, 8.5, 400}, {47.4, 8.6, 0}),
      poseFromRotation({1e90, 1e-90, 3}, {1e-90, 1, 1e-40, 1e-80}, CameraAxes::RUB, Handedness::right),
      poseFromWorldFromCamera(view, CameraAxes::RUB, Handedness::right),
      poseFromCameraFromWorld(view, CameraAxes::RUB, Handedness::right)};
  const Projection lenses[] = {perspective(60, 1.5, 0.1, 1000), orthographic(-1, 1, -1, 1, -1, 1e80)};
  int verdicts = 0;
  for (const Pose& pose : poses)
    for (const Projection& lens : lenses) {
      const Camera camera = makeCamera(pose, lens, {600, 400});
      const Frustum frustum = viewFrustum(camera);
      const Vec3 eye = pose.eye(), beside{eye.x, std::nextafter(eye.y, 0), 5e-324};
      onSmallThread([&] {
        for (const Vec3& p : {eye, beside, Vec3{5e-324, 1e90, -3e-310}})
          for (const double w : {1.0, 0.0, 0.3, 1e-90, -1e90}) {
            verdicts += worldToScreen(camera, Vec4{p.x, p.y, p.z, w}).certain;
            verdicts += boundOfPoint(camera, Vec4{p.x, p.y, p.z, w}, Precision::standard).screen > 0;
            (void)worldTo(camera, Space::clip, {p.x, p.y, p.z, w}, camera.convention());
          }
        Vec3 points[1000] = {eye, beside};
        worldToScreen(camera, points, points);
        verdicts += screenToWorld(camera, {10, 20}, 0.9999999).status == DepthStatus::point;
        verdicts += storedMatrix<double>(camera, Space::view, Space::world)[0] > 0;
        verdicts += cull(frustum, Box{{-1e90, -1e90, 1e-300}, eye}).side;
        verdicts += cull(frustum, Triangle{eye, beside, {1e-310, 1e90, 3}}).side;
        verdicts += clipSegment(frustum, eye, beside).visible;
        // Tangents and edges, which no double-double decides.
        const Ray ray{{-1e90, 1e-90, 0}, {1, 0, 0}}, down{{0, 0, 5e-324}, {1e-300, 1e60, 1}};
        verdicts += intersect(ray, Sphere{{0, 0, 0}, 1e-90}).count;
        verdicts += intersect(ray, Ellipsoid{1e-90, 2e-90}).count;
        verdicts += intersect(down, Triangle{{0, 0, 1e-300}, {1e-290, 1e90, 1}, {-1, 1e80, 1e30}}).count;
        verdicts += intersect(down, Box{{0, 0, 0}, {1e-310, 1e90, 1e50}}).count;
        verdicts += intersect(down, Plane{{0, 1e-300, 1e90}, {1e-90, 1, -1e60}}).count;
      });
    }
  CHECK(verdicts > 0);
}
#endif
