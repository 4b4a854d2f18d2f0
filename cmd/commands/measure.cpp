// viewproj measure: time and error of each way to project points, on one scene.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "commands/command.hpp"
#include "commands/stream_options.hpp"
#include "text/error.hpp"
#include "text/file.hpp"
#include "viewproj/lens.hpp"
#include "viewproj/matrices.hpp"
#include "viewproj/screen.hpp"

namespace viewproj::cmd {
namespace {

constexpr std::size_t kRounds = 15;

/// One 4x4 product and a division for each point, as a careful programmer writes it: the closed form of the matrix,
/// which is nearer the true one than a product of rounded matrices, and the viewport's map, all rounded to T. NaN where
/// w is not above 0.
template <class T>
class Textbook {
 public:
  explicit Textbook(const Camera& camera) {
    const Mat4 matrix = viewproj::matrix(camera, Space::clip, Space::world);
    const Mat4 viewport = viewproj::matrix(camera, Space::screen, Space::ndc);
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) m_[i][j] = static_cast<T>(matrix[i][j]);
    for (std::size_t i = 0; i < 3; ++i) {
      scale_[i] = static_cast<T>(viewport[i][i]);
      offset_[i] = static_cast<T>(viewport[i][3]);
    }
  }

  void project(std::span<const Vector3<T>> points, std::span<Vector3<T>> screen) const {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vector3<T> p = points[i];
      const T x = m_[0][0] * p.x + m_[0][1] * p.y + m_[0][2] * p.z + m_[0][3];
      const T y = m_[1][0] * p.x + m_[1][1] * p.y + m_[1][2] * p.z + m_[1][3];
      const T z = m_[2][0] * p.x + m_[2][1] * p.y + m_[2][2] * p.z + m_[2][3];
      const T w = m_[3][0] * p.x + m_[3][1] * p.y + m_[3][2] * p.z + m_[3][3];
      const T perW = w > 0 ? T(1) / w : std::numeric_limits<T>::quiet_NaN();
      screen[i] = {offset_[0] + scale_[0] * (x * perW), offset_[1] + scale_[1] * (y * perW),
                   offset_[2] + scale_[2] * (z * perW)};
    }
  }

 private:
  std::array<std::array<T, 4>, 4> m_{};
  std::array<T, 3> scale_{}, offset_{};  ///< screen x, y and depth of NDC
};

/// A point in the picture and its exact pixel.
struct Visible {
  std::size_t index;
  Vec2 screen;
};

std::vector<Visible> visiblePoints(const Camera& camera, std::span<const Vec3> points) {
  std::vector<Visible> visible;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (const ScreenPoint p = worldToScreen(camera, points[i]); p.visible()) visible.push_back({i, {p.x, p.y}});
  return visible;
}

/// A way to project all points.
struct Mode {
  const char* name;
  std::function<void()> project;
  std::function<Vec2(std::size_t)> pixel;  ///< of a point, as project left it
  double boundPx = NAN;
};

double secondsOf(const Mode& mode, std::size_t repeats) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  for (std::size_t i = 0; i < repeats; ++i) mode.project();
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// The fastest of fifteen runs of each, in seconds. The modes take turns, so that what slows the machine for a while
/// slows all of them. A turn lasts two milliseconds or more.
std::vector<double> timesOf(std::span<const Mode> modes) {
  constexpr double kTurn = 2e-3;
  std::vector<std::size_t> repeats(modes.size(), 1);
  std::vector<double> times(modes.size(), HUGE_VAL);
  for (std::size_t i = 0; i < modes.size(); ++i)
    while (secondsOf(modes[i], repeats[i]) < kTurn) repeats[i] *= 2;
  for (std::size_t round = 0; round < kRounds; ++round)
    for (std::size_t i = 0; i < modes.size(); ++i)
      times[i] = std::min(times[i], secondsOf(modes[i], repeats[i]) / static_cast<double>(repeats[i]));
  return times;
}

OrderedJson rowOf(const Mode& mode, std::span<const Visible> visible, double nsPerPoint) {
  double largest = visible.empty() ? NAN : 0;
  std::size_t missing = 0;
  for (const auto& [index, exact] : visible) {
    const Vec2 at = mode.pixel(index);
    const double error = std::max(std::fabs(at.x - exact.x), std::fabs(at.y - exact.y));
    const bool isFinite = std::isfinite(at.x) && std::isfinite(at.y);
    missing += isFinite ? 0 : 1;
    largest = std::max(largest, isFinite ? error : HUGE_VAL);
  }
  return {{"mode", mode.name},
          {"nsPerPoint", nsPerPoint},
          {"maxErrorPx", largest},
          {"boundPx", mode.boundPx},
          {"missing", missing}};
}

/// The library's exact and standard arithmetic beside the textbook's: one view-projection matrix in double and in
/// float32. The camera has a near plane, and there are points. leftOut: how many records were none.
OrderedJson measureReport(const Camera& camera, std::span<const Vec3> points, std::size_t leftOut) {
  std::vector<Vec3> screen(points.size());
  std::vector<Vector3<float>> floatPoints, floatScreen(points.size());
  for (const Vec3& p : points)
    floatPoints.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
  const Camera pinhole = withoutLens(camera);
  const Textbook<double> inDouble(pinhole);
  const Textbook<float> inFloat(pinhole);
  const std::vector<Visible> visible = visiblePoints(camera, points);

  const auto by = [&](Precision precision) {
    return [&, precision] { worldToScreen(camera, points, std::span(screen), precision); };
  };
  const auto pixel = [&](std::size_t i) { return Vec2{screen[i].x, screen[i].y}; };
  const auto floatPixel = [&](std::size_t i) { return Vec2{floatScreen[i].x, floatScreen[i].y}; };
  const Mode modes[] = {
      {"exact", by(Precision::exact), pixel, boundInPicture(camera, Precision::exact).screen},
      {"standard", by(Precision::standard), pixel, boundInPicture(camera, Precision::standard).screen},
      {"matrix double", [&] { inDouble.project(points, screen); }, pixel},
      {"matrix float32", [&] { inFloat.project(floatPoints, floatScreen); }, floatPixel}};
  const std::vector<double> times = timesOf(modes);
  OrderedJson rows = OrderedJson::array();
  for (std::size_t i = 0; i < times.size(); ++i) {
    modes[i].project();  // they share the screen positions
    rows.push_back(rowOf(modes[i], visible, times[i] * 1e9 / static_cast<double>(points.size())));
  }
  OrderedJson notes{
      "nsPerPoint is the fastest round's. Errors are the larger of x and y, on the points in the picture, "
      "against exact, which is within 0.51 ulp. boundPx is proven. missing: points in the picture whose result "
      "is not finite."};
  if (lensOf(camera))
    notes.push_back("A matrix has no lens: errors of the matrices include how far the lens shifts these points.");
  OrderedJson report{{"points", points.size()}, {"visible", visible.size()}, {"leftOut", leftOut}, {"rounds", kRounds}};
  report.update({{"modes", rows}, {"notes", notes}});
  return report;
}

struct MeasureOptions {
  CameraOptions camera;
  StreamOptions stream;
  ReportOptions report;
};

int runMeasure(const MeasureOptions& o) {
  constexpr std::size_t kMostPoints = 1'000'000;  // kept at once
  StreamSetup setup = o.stream.setup(kPointColumns);
  o.stream.reads(setup);
  const CameraFile file = o.camera.read();
  requireNear(file, "measure");
  const Camera camera = makeCamera(file);
  o.stream.settleOnEarth(setup, file.worldIsEcef);
  const PointReading reading{.columns = setup.columns, .worldIsEcef = file.worldIsEcef};
  std::vector<Vec3> points;
  std::size_t count = 0, leftOut = 0;
  const auto toMeasure = [&](const NumberPlan& plan, const Numbers& numbers) {
    const Vec4 p = toPoint(plan, numbers);
    if (p.w == 1 && ++count > kMostPoints && !setup.keepGoing)
      throw RecordError(0, "is one more than the " + std::to_string(kMostPoints) +
                               " points that are measured at once; a sample of them will do");
    return p;
  };
  const int status = readEachPoint(setup, reading, toMeasure, [&](const Vec4& p, const RecordView&, std::size_t) {
    if (p.w != 1)
      ++leftOut;
    else if (points.size() < kMostPoints)
      points.push_back({p.x, p.y, p.z});
  });
  if (points.empty())
    throw InputError((setup.given.empty() ? shownName(setup.file) : setup.given[0].option) +
                     ": has no points to measure" +
                     (leftOut > 0 ? "; directions and weighted points are left out" : ""));
  o.report.write(measureReport(camera, points, leftOut), "modes");
  return status;
}

}  // namespace

Action declareMeasure(CLI::App& app) {
  const auto o = std::make_shared<MeasureOptions>();
  describe(app,
           "Time and error of each precision on your own points, beside the textbook's: the view-projection matrix in "
           "double and in float32. (Lengths in a picture: ray --fields point, triangulate.)",
           "Example:\n"
           "  seq 1 1000 | awk '{print $1 / 1000, $1 % 7 / 7, -$1}' |\n"
           "    viewproj measure --position 0,0,9 --target 0,0,0 --fov-y 60 \\\n"
           "      --near 0.1 --viewport 1280x720");
  o->report.add(app, 3);
  o->camera.add(app);
  o->stream.addInput(app, "points");
  o->stream.addPoints(app);
  return [o] { return runMeasure(*o); };
}

}  // namespace viewproj::cmd
