#include <cstdio>
#include <viewproj/geodesy.hpp>
#include <viewproj/viewproj.hpp>

int main() {
  using namespace viewproj;
  using namespace viewproj::detail;
  const Camera camera = makeCamera(lookAt({3, 2, 5}, {0, 0, 0}, {0, 1, 0}, Handedness::right),
                                   perspective(60, 16.0 / 9, 0.1, 1000), {.width = 1280, .height = 720});
  const ScreenPoint p = worldToScreen(camera, Vec3{1, 1, 1});
  std::printf("%.17g %.17g, the equator at %.0f m\n", p.x, p.y, geodeticToEcef({0, 0, 0}).x);
}
