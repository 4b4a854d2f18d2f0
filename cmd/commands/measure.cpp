#include "commands/measure.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "commands/command.hpp"
#include "commands/options.hpp"
#include "commands/stream_options.hpp"
#include "records/points.hpp"
#include "stream/filter.hpp"
#include "text/error.hpp"
#include "text/file.hpp"
#include "viewproj/lens.hpp"
#include "viewproj/matrices.hpp"
#include "viewproj/screen.hpp"

namespace viewproj::cmd {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kRounds = 15;

// ---- Time

using Work = std::function<void()>;

double secondsOf(const Work& work, std::size_t repeats) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  for (std::size_t i = 0; i < repeats; ++i) work();
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// The fastest and the median of fifteen runs of each, in seconds. The works take turns, so that what slows the machine
/// for a while slows all of them. A turn lasts two milliseconds or more.
std::vector<std::pair<double, double>> timesOf(std::span<const Work> works) {
  constexpr double kTurn = 2e-3;
  std::vector<std::size_t> repeats;
  for (const Work& work : works) {
    work();  // memory and caches are warm
    std::size_t count = 1;
    while (secondsOf(work, count) < kTurn) count *= 2;
    repeats.push_back(count);
  }
  std::vector<std::vector<double>> runs(works.size());
  for (std::size_t round = 0; round < kRounds; ++round)
    for (std::size_t i = 0; i < works.size(); ++i)
      runs[i].push_back(secondsOf(works[i], repeats[i]) / static_cast<double>(repeats[i]));
  std::vector<std::pair<double, double>> times;
  for (std::vector<double>& run : runs) {
    std::sort(run.begin(), run.end());
    times.emplace_back(run.front(), run[run.size() / 2]);
  }
  return times;
}

// ---- The textbook

/// One 4x4 product and a division a point, as a careful programmer writes it: the closed form of the matrix, which is
/// nearer the true one than a product of rounded matrices, and the viewport's map, all rounded to T. NaN where w is not
/// above 0.
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

// ---- Errors

/// Errors of results, in any unit; a result that is not finite has an infinite one.
struct Errors {
  double largest = std::numeric_limits<double>::quiet_NaN();
  double percentile99 = largest;  ///< 99 of 100 are no larger
  std::size_t missing = 0;        ///< how many results are not finite
};

Errors errorsOf(std::vector<double> errors) {
  if (errors.empty()) return {};
  std::sort(errors.begin(), errors.end());
  const auto missing = errors.end() - std::lower_bound(errors.begin(), errors.end(), kInfinity);
  return {errors.back(), errors[errors.size() - 1 - errors.size() / 100], static_cast<std::size_t>(missing)};
}

double pixelsOff(double result, double exact) { return std::isfinite(result) ? std::fabs(result - exact) : kInfinity; }

/// In units in the last place of the exact number.
double ulpsOff(double result, double exact) {
  if (result == exact) return 0;
  const double size = std::fabs(exact);
  if (!std::isfinite(result) || size == 0) return kInfinity;  // the gap above 0 is no measure of anything
  return std::fabs(result - exact) / (std::nextafter(size, kInfinity) - size);
}

/// A point of the picture and its exact pixel.
struct Visible {
  std::size_t index;
  Vec2 screen;
};

/// Every result is somewhere in memory that outlives the work; reading one keeps the compiler honest.
volatile double gConsumed = 0;

template <class T>
OrderedJson modeRow(const char* mode, std::span<const Visible> visible, std::span<const Vector3<T>> screen) {
  std::vector<double> pixels, ulps;
  for (const auto& [index, exact] : visible) {
    const double x = static_cast<double>(screen[index].x), y = static_cast<double>(screen[index].y);
    pixels.push_back(std::max(pixelsOff(x, exact.x), pixelsOff(y, exact.y)));
    ulps.push_back(std::max(ulpsOff(x, exact.x), ulpsOff(y, exact.y)));
  }
  const Errors errors = errorsOf(std::move(pixels));
  return {{"mode", mode},
          {"nsPerPoint", nullptr},
          {"medianNsPerPoint", nullptr},
          {"maxErrorPx", errors.largest},
          {"p99ErrorPx", errors.percentile99},
          {"maxErrorUlp", errorsOf(std::move(ulps)).largest},
          {"boundPx", nullptr},
          {"escalated", nullptr},
          {"uncertain", nullptr},
          {"missing", errors.missing}};
}

std::vector<Visible> visiblePoints(const Camera& camera, std::span<const Vec3> points) {
  std::vector<Visible> visible;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (const ScreenPoint p = worldToScreen(camera, points[i]); p.visible()) visible.push_back({i, {p.x, p.y}});
  return visible;
}

}  // namespace

OrderedJson measureReport(const Camera& camera, std::span<const Vec3> points, std::size_t leftOut) {
  const std::vector<Visible> visible = visiblePoints(camera, points);
  std::vector<Vec3> screen(points.size());
  std::vector<Vector3<float>> floatPoints, floatScreen(points.size());
  for (const Vec3& p : points)
    floatPoints.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});

  OrderedJson modes = OrderedJson::array();
  std::vector<Work> works;
  const double all = static_cast<double>(points.size());
  for (const Precision precision : {Precision::exact, Precision::standard}) {
    const BatchCounts counts = worldToScreen(camera, points, std::span(screen), precision);
    modes.push_back(modeRow<double>(precision == Precision::exact ? "exact" : "standard", visible, screen));
    modes.back()["boundPx"] = boundInPicture(camera, precision).screen;
    modes.back()["escalated"] = static_cast<double>(counts.escalated) / all;
    modes.back()["uncertain"] = static_cast<double>(counts.uncertain) / all;
    works.push_back([&, precision] {
      worldToScreen(camera, points, std::span(screen), precision);
      gConsumed = screen.back().x;
    });
  }
  const Camera pinhole = withoutLens(camera);  // a matrix knows no lens
  const std::vector<Visible> inPinhole = visiblePoints(pinhole, points);
  const Textbook<double> inDouble(pinhole);
  inDouble.project(points, screen);
  modes.push_back(modeRow<double>("matrix double", inPinhole, screen));
  works.push_back([&] {
    inDouble.project(points, screen);
    gConsumed = screen.back().x;
  });
  const Textbook<float> inFloat(pinhole);
  inFloat.project(floatPoints, floatScreen);
  modes.push_back(modeRow<float>("matrix float32", inPinhole, floatScreen));
  works.push_back([&] {
    inFloat.project(floatPoints, floatScreen);
    gConsumed = static_cast<double>(floatScreen.back().x);
  });

  const auto times = timesOf(works);
  for (std::size_t i = 0; i < times.size(); ++i) {
    modes[i]["nsPerPoint"] = times[i].first * 1e9 / all;
    modes[i]["medianNsPerPoint"] = times[i].second * 1e9 / all;
  }
  return {{"points", points.size()},
          {"visible", visible.size()},
          {"leftOut", leftOut},
          {"rounds", kRounds},
          {"modes", modes},
          {"notes",
           {"Errors: the larger of x and y, on the points in the picture, against exact, which is within 0.51 ulp. "
            "boundPx is proven. escalated and uncertain are shares of all points. missing: points in the picture "
            "whose result is not finite."}}};
}

namespace {

/// Points that are kept at once.
constexpr std::size_t kMostPoints = 1'000'000;

/// What batches take, and how much was left out because they do not.
struct Sample {
  std::vector<Vec3> points;
  std::size_t leftOut = 0;
};

/// Keeps the points of a stream.
class SampleWork final : public RecordWork {
 public:
  SampleWork(Sample& sample, const PointReading& reading, bool keepGoing)
      : sample_(sample), reading_(reading), keepGoing_(keepGoing) {}

  Layout find(const RecordParts& record) const override { return findPoint(record, reading_); }
  void add(const Layout& layout, const Numbers& numbers) override {
    const Vec4 p = toPoint(layout, numbers);
    if (sample_.points.size() == kMostPoints && keepGoing_) return;
    if (sample_.points.size() == kMostPoints)
      throw RecordError(0, "is one more than the " + std::to_string(kMostPoints) +
                               " points that are measured at once; a sample of them will do");
    if (p.w == 1)
      sample_.points.push_back({p.x, p.y, p.z});
    else
      ++sample_.leftOut;
  }

 private:
  Sample& sample_;
  const PointReading& reading_;
  bool keepGoing_;
};

struct MeasureOptions {
  CameraOptions camera;
  StreamOptions stream;
  ReportOptions report;
};

int runMeasure(const MeasureOptions& o) {
  FilterSetup setup = o.stream.setup(kPointColumns);
  o.stream.reads(setup);
  const CameraFile file = o.camera.read();
  requireNear(file, "measure");
  const Camera built = makeCamera(file);

  Sample sample;
  o.stream.settleOnEarth(setup, file.worldIsEcef);
  const PointReading reading{.columns = setup.columns, .worldIsEcef = file.worldIsEcef};
  const int status = readRecords(setup, [&] { return std::make_unique<SampleWork>(sample, reading, setup.keepGoing); });
  if (sample.points.empty())
    throw InputError((setup.given.empty() ? shownName(setup.file) : setup.given[0].option) +
                     ": has no points to measure" +
                     (sample.leftOut > 0 ? "; directions and weighted points are left out" : ""));
  o.report.write(measureReport(built, sample.points, sample.leftOut), "modes");
  return status;
}

}  // namespace

Action declareMeasure(CLI::App& app) {
  const auto o = std::make_shared<MeasureOptions>();
  app.description(
      "Time and error of each precision on your own points, beside the textbook's: the view-projection matrix in "
      "double and in float32.");
  app.footer(
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
