#include <cstdio>
#include <viewproj/viewproj.hpp>

int main() {
  using namespace viewproj;
  const Camera camera = makeCamera(lookAt({3, 2, 5}, {0, 0, 0}, {0, 1, 0}, Handedness::right),
                                   perspective(60, 16.0 / 9, 0.1, 1000), {.width = 1280, .height = 720});
  const ScreenPoint p = worldToScreen(camera, {1, 1, 1});
  std::printf("%.17g %.17g\n", p.x, p.y);
}
