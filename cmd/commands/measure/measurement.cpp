#include "commands/measure/measurement.hpp"

#include <algorithm>
#include <functional>

#include "commands/measure/errors.hpp"
#include "commands/measure/textbook.hpp"
#include "commands/measure/timing.hpp"
#include "projection/kernels/kernels.hpp"
#include "viewproj/screen.hpp"

namespace viewproj::cmd {
namespace {

/// A point of the picture and its exact pixel.
struct Visible {
  std::size_t index;
  Vec2 screen;
};

std::vector<Visible> visiblePoints(const Camera& camera, std::span<const Vec3> points) {
  std::vector<Visible> visible;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ScreenPoint p = worldToScreen(camera, points[i], Precision::exact);
    if (p.visible()) visible.push_back({i, {p.x, p.y}});
  }
  return visible;
}

/// Every point's result is somewhere in memory that outlives the work; reading one keeps the compiler honest.
volatile double gConsumed = 0;

/// result(i): screen position of point i.
template <class Result>
void summarise(ModeRow& row, std::span<const Visible> visible, const Result& result) {
  if (visible.empty()) return;
  ErrorTally pixels, inUlps;
  for (const Visible& v : visible) {
    const Vec2 screen = result(v.index);
    pixels.add(errorInPixels(screen, v.screen));
    inUlps.add(errorInUlps(screen, v.screen));
  }
  row.maxErrorPx = pixels.largest();
  row.p99ErrorPx = pixels.percentile99();
  row.maxErrorUlp = inUlps.largest();
  row.missing = pixels.missing();
}

/// Rows and what they time, side by side.
struct Bench {
  std::vector<ModeRow> rows;
  std::vector<std::function<void()>> works;
  std::vector<std::size_t> counts;  ///< points a call
};

/// The library's batches: each is run once for its errors, then kept for the timing.
void addLibrary(Bench& bench, const Camera& camera, std::span<const Vec3> points, std::span<Vec3> screen,
                std::span<const Visible> visible) {
  for (const Precision precision : {Precision::standard, Precision::exact}) {
    ModeRow row(std::string(precisionName(precision)), precision);
    const auto run = [=, &camera] { return worldToScreen(camera, points, screen, precision); };
    const BatchCounts counts = run();
    const double all = static_cast<double>(points.size());
    row.boundPx = boundInPicture(camera, precision).screen;
    row.escalated = static_cast<double>(counts.escalated) / all;
    row.uncertain = static_cast<double>(counts.uncertain) / all;
    summarise(row, visible, [&](std::size_t i) { return Vec2{screen[i].x, screen[i].y}; });
    bench.rows.push_back(std::move(row));
    bench.works.push_back([=] {
      run();
      gConsumed = screen.back().x;
    });
    bench.counts.push_back(points.size());
  }
}

template <class T>
void addTextbook(Bench& bench, const char* mode, const Camera& camera, std::span<const Vector3<T>> points,
                 std::span<Vector3<T>> screen, std::span<const Visible> visible) {
  const auto run = [=, textbook = textbookCamera<T>(camera)] {
    projectByMatrix<T>(textbook, points, screen);
    gConsumed = static_cast<double>(screen.back().x);
  };
  ModeRow row(mode);
  run();
  summarise(row, visible, [&](std::size_t i) {
    return Vec2{static_cast<double>(screen[i].x), static_cast<double>(screen[i].y)};
  });
  bench.rows.push_back(std::move(row));
  bench.works.push_back(run);
  bench.counts.push_back(points.size());
}

/// What an angle is worth in pixels at the picture's middle; nothing in orthographic, where all rays are parallel.
std::optional<double> pixelsPerRadian(const Camera& camera) {
  if (camera.projection().isOrthographic()) return std::nullopt;
  const Viewport& v = camera.viewport();
  const Vec2 corner = pictureCorners(v).first;
  const double x = corner.x + v.width / 2, y = corner.y + v.height / 2;
  const auto across = [&](double dx, double dy) {
    const Vec3 a = screenToRay(camera, {x - dx / 2, y - dy / 2}).direction;
    const Vec3 b = screenToRay(camera, {x + dx / 2, y + dy / 2}).direction;
    return 1 / angleBetween(a, b);
  };
  return std::max(across(1, 0), across(0, 1));
}

void summariseRays(ModeRow& row, const Camera& camera, std::span<const Vec2> pixels, std::span<const Vec3> directions) {
  ErrorTally angles;
  for (std::size_t i = 0; i < pixels.size(); ++i)
    angles.add(angleBetween(directions[i], screenToRay(camera, pixels[i]).direction));
  row.maxErrorRadians = angles.largest();
  row.p99ErrorRadians = angles.percentile99();
  row.missing = angles.missing();
  if (const auto scale = pixelsPerRadian(camera)) {
    row.maxErrorPx = *row.maxErrorRadians * *scale;
    row.p99ErrorPx = *row.p99ErrorRadians * *scale;
    if (row.precision) row.boundPx = kRayDirectionBound * *scale;
  }
}

void addRays(Bench& bench, const Camera& camera, std::span<const Vec2> pixels, std::span<Vec3> directions) {
  if (pixels.empty()) return;
  const auto add = [&](ModeRow row, auto cast) {
    cast();
    summariseRays(row, camera, pixels, directions);
    bench.rows.push_back(std::move(row));
    bench.works.push_back([=] {
      cast();
      gConsumed = directions.back().x;
    });
    bench.counts.push_back(pixels.size());
  };
  add(ModeRow("ray", Precision::standard), [=, &camera] { screenToRayDirections(camera, pixels, directions); });
  add(ModeRow("ray by inverse matrix"),
      [=, inverse = textbookInverse(camera)] { castByInverse(inverse, pixels, directions); });
}

}  // namespace

std::string_view precisionName(Precision precision) { return precision == Precision::standard ? "standard" : "exact"; }

Measurement measure(const Camera& camera, std::span<const Vec3> points) {
  const std::vector<Visible> visible = visiblePoints(camera, points);
  std::vector<Vec3> screen(points.size());
  std::vector<Vector3<float>> floatPoints, floatScreen(points.size());
  for (const Vec3& p : points)
    floatPoints.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
  std::vector<Vec2> pixels;
  for (const Visible& v : visible) pixels.push_back(v.screen);
  std::vector<Vec3> directions(pixels.size());

  Bench bench;
  addLibrary(bench, camera, points, screen, visible);
  addTextbook<double>(bench, "matrix double", camera, points, screen, visible);
  addTextbook<float>(bench, "matrix float", camera, floatPoints, floatScreen, visible);
  const std::size_t projecting = bench.rows.size();
  addRays(bench, camera, pixels, directions);

  const std::vector<Timing> timings = timeInterleaved(bench.works);
  for (std::size_t i = 0; i < bench.rows.size(); ++i) {
    const Timing& t = timings[i];
    bench.rows[i].nsPerPoint = t.least * 1e9 / static_cast<double>(bench.counts[i]);
    bench.rows[i].spread = t.median / t.least;
  }

  Measurement m;
  m.points = points.size();
  m.visible = visible.size();
  m.kernel = detail::kernels().name;
  const auto firstRay = bench.rows.begin() + static_cast<std::ptrdiff_t>(projecting);
  m.projecting.assign(bench.rows.begin(), firstRay);
  m.casting.assign(firstRay, bench.rows.end());
  return m;
}

}  // namespace viewproj::cmd
