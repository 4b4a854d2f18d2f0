// Time per point of every precision and of peers, as ratios to GLM in double in the same interleaved run.
//   projection_benchmark [ROUNDS [POINTS]]      15 rounds, of up to 16777216 points
// Before they race, all are compared with the exact positions: status 1 where one differs. ROUNDS=0 does that only.
#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "camera/camera.hpp"
#include "parts.hpp"
#include "peers.hpp"
#include "projection/kernels/kernels.hpp"

using namespace viewproj;
using namespace viewproj::detail;

namespace {

struct Contestant {
  std::string name;
  std::function<void()> run;
  std::function<double()> error = {};  ///< after a run: the largest, NaN where there is no answer
  double tolerance = 0;
  std::vector<double> nanoseconds;  ///< per point, a round each
};

double median(std::vector<double> v) {
  std::nth_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2), v.end());
  return v[v.size() / 2];
}

bool wrong = false;

void check(const std::vector<Contestant>& contestants) {
  for (const Contestant& c : contestants) {
    if (!c.error) continue;
    c.run();
    const double error = c.error();
    if (error <= c.tolerance) continue;
    std::printf("%s is off by %g\n", c.name.c_str(), error);
    wrong = true;
  }
}

/// Runs all contestants in turn, round after round, and prints medians, minima and ratios to the first.
void race(const std::string& title, std::size_t points, int rounds, std::vector<Contestant> contestants) {
  check(contestants);
  if (rounds == 0) return;
  // One measurement takes about two milliseconds at least.
  const std::size_t repeats = std::max<std::size_t>(1, 400000 / points);
  for (int round = -1; round < rounds; ++round)
    for (Contestant& c : contestants) {
      const auto start = std::chrono::steady_clock::now();
      for (std::size_t i = 0; i < repeats; ++i) c.run();
      const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - start;
      if (round >= 0) c.nanoseconds.push_back(time.count() / double(repeats) / double(points));
    }
  std::printf("\n%s\n%-34s %9s %9s %7s\n", title.c_str(), "", "median", "minimum", "ratio");
  const double reference = median(contestants[0].nanoseconds);
  for (const Contestant& c : contestants)
    std::printf("%-34s %6.2f ns %6.2f ns %7.3f\n", c.name.c_str(), median(c.nanoseconds),
                *std::min_element(c.nanoseconds.begin(), c.nanoseconds.end()), median(c.nanoseconds) / reference);
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 15;
  const std::size_t most = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : std::size_t(1) << 24;
  if (rounds < 0 || most < 1) {
    std::puts("usage: projection_benchmark [ROUNDS [POINTS]]");
    return 2;
  }
  const Viewport viewport{.width = 1920, .height = 1080, .origin = Origin::bottomLeft};
  const Pose pose = lookAt({300, 200, 500}, {0, 0, 0}, {0, 1, 0}, Handedness::right);
  const Projection projection = perspective(60, Aspect(16, 9), 0.1, 10000);
  const Camera camera = makeCamera(pose, projection, viewport);
  const benchmark::PeerCamera peer{viewFromWorld(pose, {}), clipFromView(projection, {}), 1920, 1080};
  std::printf("best kernel here: %s, %d rounds\n", kernels().name, rounds);

  for (const std::size_t count : {std::size_t(4096), std::size_t(1) << 20, std::size_t(1) << 24}) {
    if (count > most && count > 4096) break;
    // Points on screen, 1 to 1000 units away.
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<Vec3> points(count), screen(count);
    for (Vec3& p : points)
      p = screenToWorldAtDistance(camera, {1920 * unit(random), 1080 * unit(random)}, 1 + 1000 * unit(random)).position;
    std::vector<benchmark::Vec3f> singles(count), singleScreen(count);
    for (std::size_t i = 0; i < count; ++i) singles[i] = {float(points[i].x), float(points[i].y), float(points[i].z)};
    std::vector<ScreenPoint> exact(count);
    for (std::size_t i = 0; i < count; ++i) exact[i] = worldToScreen(camera, points[i]);

    std::vector<Contestant> contestants;
    // Forgets the answers when it is asked, so that the next one has to give its own.
    const auto errorOf = [&exact](auto& answers) {
      return [&] {
        double worst = 0;
        for (std::size_t i = 0; i < exact.size(); ++i) {
          const double off = std::hypot(double(answers[i].x) - exact[i].x, double(answers[i].y) - exact[i].y) +
                             std::fabs(double(answers[i].z) - exact[i].depth);
          if (!(off <= worst)) worst = off;
          answers[i] = {NAN, NAN, NAN};
        }
        return worst;
      };
    };
    // Pixels; depths are at most 1.
    const auto add = [&](const std::string& name, double tolerance, std::function<void()> run) {
      contestants.push_back({name, std::move(run), errorOf(screen), tolerance, {}});
    };
    using benchmark::peersO2, benchmark::peersO3;
    add("GLM double project, -O2", 1e-8, [&] { peersO2.glmProjectDouble(peer, points, screen); });
    add("GLM double project, -O3", 1e-8, [&] { peersO3.glmProjectDouble(peer, points, screen); });
    contestants.push_back({"GLM float project, -O3",
                           [&] { peersO3.glmProjectFloat(peer, singles, singleScreen); },
                           errorOf(singleScreen),
                           1,
                           {}});
    add("Eigen double, cached product, -O2", 1e-8, [&] { peersO2.eigenCachedDouble(peer, points, screen); });
    contestants.push_back({"copy of the bytes",
                           [&] { std::memcpy(screen.data(), points.data(), points.size() * sizeof(Vec3)); },
                           {},
                           0,
                           {}});
    // What a kernel leaves unsettled has its answer already.
    const auto settle = [&](std::vector<std::uint64_t>& unsettled) {
      for (std::size_t word = 0; word < unsettled.size(); ++word)
        for (std::uint64_t& rest = unsettled[word]; rest; rest &= rest - 1) {
          const std::size_t i = 64 * word + static_cast<std::size_t>(std::countr_zero(rest));
          screen[i] = {exact[i].x, exact[i].y, exact[i].depth};
        }
    };
    std::vector<std::uint64_t> unsettled(count / 64 + 1);
    for (const Kernels* k : allKernels()) {
      if (!isSupported(*k)) continue;
      const std::string suffix = std::string(" ") + k->name;
      const auto run = [&](auto kernel) {
        return [&, kernel] {
          kernel(parts(camera).constants, &points[0].x, &screen[0].x, nullptr, count, unsettled.data());
          settle(unsettled);
        };
      };
      add("standard" + suffix, 1e-8, run(k->standard));
      add("exact" + suffix, 0, run(k->exact));
    }
    race(std::to_string(count) + " points", count,
         count > (1u << 22) ? std::min(rounds, std::max(3, rounds / 3)) : rounds, contestants);
    if (worldToScreen(camera, points, screen, Precision::exact).escalated > count / 1000) {
      std::printf("more than one in a thousand exact points was not certified by the kernel\n");
      wrong = true;
    }
  }

  const std::size_t count = 1 << 16;
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Vec2> pixels(count);
  std::vector<Vec3> directions(count);
  for (Vec2& p : pixels) p = {1920 * unit(random), 1080 * unit(random)};
  std::vector<Contestant> contestants;
  const auto error = [&] {
    double worst = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 exact = screenToRay(camera, pixels[i]).direction;
      const double length = std::hypot(directions[i].x - exact.x, directions[i].y - exact.y, directions[i].z - exact.z);
      if (!(length <= worst)) worst = length;
      directions[i] = {NAN, NAN, NAN};
    }
    return worst;
  };
  contestants.push_back({"GLM double unProject, twice",
                         [&] { benchmark::peersO3.glmUnProjectTwice(peer, pixels, directions); },
                         error,
                         1e-9,
                         {}});
  contestants.push_back({"rays", [&] { screenToRayDirections(camera, pixels, directions); }, error, 1e-15, {}});
  std::vector<Contestant> building;
  building.push_back({"building a camera",
                      [&] {
                        for (std::size_t i = 0; i < 1000; ++i)
                          directions[i] = parts(makeCamera(lookAt({300 + double(i), 200, 500}, {0, 0, 0}, {0, 1, 0},
                                                                  Handedness::right),
                                                           perspective(60, 1.5, 0.1, 10000), viewport))
                                              .constants.rayX;
                      },
                      {},
                      0,
                      {}});
  race("1000 cameras", 1000, rounds, building);
  return wrong ? 1 : 0;
}
