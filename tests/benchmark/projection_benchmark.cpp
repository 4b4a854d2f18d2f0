// Time per point beside GLM and Eigen, as ratios to GLM in the same interleaved run.
//   projection_benchmark [ROUNDS [POINTS]]      15 rounds, 1048576 points
// First, all are compared with the exact positions: status 1 if one differs. ROUNDS=0 does that only.
#include <Eigen/Dense>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <random>
#include <string>
#include <vector>

#include "kernels.hpp"
#include "viewproj/viewproj.hpp"

using namespace viewproj;

namespace {

struct Contestant {
  std::string name;
  std::function<void()> run;
  double tolerance = 0;             ///< of its answers
  std::vector<double> nanoseconds;  ///< per point, one number a round
};

/// Runs all in turn, round after round, and prints medians and ratios to the first. Returns whether all were right.
bool race(const char* title, int rounds, std::vector<Contestant> contestants, std::vector<Vec3>& answers,
          const std::vector<Vec3>& truth) {
  bool areRight = true;
  for (const Contestant& c : contestants) {
    std::fill(answers.begin(), answers.end(), Vec3{NAN, NAN, NAN});
    c.run();
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const Vec3 &a = answers[i], &b = truth[i];
      if (std::hypot(a.x - b.x, a.y - b.y, a.z - b.z) <= c.tolerance) continue;
      std::printf("%s is wrong at point %zu\n", c.name.c_str(), i);
      areRight = false;
      break;
    }
  }
  for (int round = -1; round < rounds; ++round)
    for (Contestant& c : contestants) {
      const auto start = std::chrono::steady_clock::now();
      c.run();
      const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - start;
      if (round >= 0) c.nanoseconds.push_back(time.count() / double(truth.size()));
    }
  if (rounds == 0) return areRight;
  std::printf("\n%-34s    median   ratio\n", title);
  const auto median = [](std::vector<double>& v) {
    std::sort(v.begin(), v.end());
    return v[v.size() / 2];
  };
  const double first = median(contestants[0].nanoseconds);
  for (Contestant& c : contestants)
    std::printf("%-34s %6.2f ns %7.3f\n", c.name.c_str(), median(c.nanoseconds), median(c.nanoseconds) / first);
  return areRight;
}

glm::dmat4 toGlm(const Mat4& m) {
  glm::dmat4 g;
  for (int i = 0; i < 16; ++i) g[i % 4][i / 4] = m[std::size_t(i / 4)][std::size_t(i % 4)];
  return g;
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 15;
  const std::size_t count = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : std::size_t(1) << 20;
  const Viewport viewport{.width = 1920, .height = 1080, .origin = Origin::bottomLeft};
  const Camera camera = makeCamera(lookAt({300, 200, 500}, {0, 0, 0}, {0, 1, 0}, Handedness::right),
                                   perspective(60, Aspect(16, 9), 0.1, 10000), viewport);
  const Mat4 view = matrix(camera, Space::view, Space::world), lens = matrix(camera, Space::clip, Space::view);
  const glm::dmat4 glmView = toGlm(view), glmLens = toGlm(lens);
  const glm::dvec4 window(0, 0, 1920, 1080);

  // Points on the screen, 1 to 1000 units away.
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Vec2> pixels(count);
  std::vector<Vec3> points(count), answers(count), screen(count), directions(count);
  for (std::size_t i = 0; i < count; ++i) {
    pixels[i] = {1920 * unit(random), 1080 * unit(random)};
    points[i] = screenToWorldAtDistance(camera, pixels[i], 1 + 1000 * unit(random)).position;
    const ScreenPoint p = worldToScreen(camera, points[i]);
    screen[i] = {p.x, p.y, p.depth};
    directions[i] = screenToRay(camera, pixels[i]).direction;
  }

  std::vector<Contestant> projecting;
  projecting.push_back({"GLM project, double",
                        [&] {
                          for (std::size_t i = 0; i < count; ++i) {
                            const glm::dvec3 p(points[i].x, points[i].y, points[i].z);
                            const glm::dvec3 s = glm::projectNO(p, glmView, glmLens, window);
                            answers[i] = {s.x, s.y, s.z};
                          }
                        },
                        1e-8,
                        {}});
  projecting.push_back({"Eigen, one product, double",
                        [&] {
                          Eigen::Matrix4d v, p;
                          for (int i = 0; i < 16; ++i) {
                            v(i / 4, i % 4) = view[std::size_t(i / 4)][std::size_t(i % 4)];
                            p(i / 4, i % 4) = lens[std::size_t(i / 4)][std::size_t(i % 4)];
                          }
                          const Eigen::Matrix4d m = p * v;
                          for (std::size_t i = 0; i < count; ++i) {
                            const Eigen::Vector4d c = m * Eigen::Vector4d(points[i].x, points[i].y, points[i].z, 1);
                            const double perW = 0.5 / c.w();
                            answers[i] = {(c.x() * perW + 0.5) * 1920, (c.y() * perW + 0.5) * 1080, c.z() * perW + 0.5};
                          }
                        },
                        1e-8,
                        {}});
  bool areRight = true;
  withEachKernel([&](const auto& kernel) {
    const auto add = [&](Precision precision, const char* name, double tolerance) {
      projecting.push_back({name + std::string(kernel.name),
                            [&, precision] { worldToScreen(camera, points, answers, precision); },
                            tolerance,
                            {}});
    };
    add(Precision::standard, "standard, ", 1e-8);
    add(Precision::exact, "exact, ", 0);
    areRight = race("points to the screen", rounds, projecting, answers, screen) && areRight;
    projecting.resize(2);
  });

  std::vector<Contestant> casting;
  casting.push_back({"GLM unProject, twice",
                     [&] {
                       for (std::size_t i = 0; i < count; ++i) {
                         const auto at = [&](double depth) {
                           return glm::unProjectNO(glm::dvec3(pixels[i].x, pixels[i].y, depth), glmView, glmLens,
                                                   window);
                         };
                         const glm::dvec3 d = glm::normalize(at(1) - at(0));
                         answers[i] = {d.x, d.y, d.z};
                       }
                     },
                     1e-9,
                     {}});
  casting.push_back({"rays", [&] { screenToRayDirections(camera, pixels, answers); }, 1e-15, {}});
  areRight = race("pixels to rays", rounds, casting, answers, directions) && areRight;
  return areRight ? 0 : 1;
}
