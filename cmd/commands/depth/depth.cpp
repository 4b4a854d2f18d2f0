// viewproj depth: what a depth buffer resolves.
#include <algorithm>
#include <cmath>
#include <limits>

#include "camera/camera.hpp"
#include "commands/camera_options.hpp"
#include "commands/command.hpp"
#include "commands/depth/report.hpp"
#include "commands/options.hpp"
#include "output/output_file.hpp"
#include "text/error.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

constexpr double kLargest = std::numeric_limits<double>::max();

/// Without the noise of the last digits.
double rounded(double value) { return parseNumber(formatDigits(value, 15)).value_or(value); }

/// digit * 10^exponent; infinite beyond the doubles.
double decimal(const char* digit, int exponent) {
  return parseNumber(digit + ("e" + std::to_string(exponent))).value_or(kInfiniteFar);
}

/// As far as an infinite view is told of by default: this many near distances.
constexpr double kInfiniteReach = 1e8;

/// In a table; of a longer range every second, third, ... decade is told.
constexpr int kMostDecades = 24;

/// Decades from near to far (to kInfiniteReach near distances, if far is infinite), with 2 and 5 between them in a
/// short range, and half of near before them. Orthographic: tenths of the range.
std::vector<double> defaultDistances(const DepthMapping& m) {
  std::vector<double> distances;
  if (m.orthographic) {
    for (int i = 1; i < 10; ++i) distances.push_back(rounded(m.near + (m.far - m.near) * i / 10));
    distances.insert(distances.begin(), m.near);
    distances.push_back(m.far);
    return distances;
  }
  distances = {m.near};
  if (m.near / 2 > 0) distances.insert(distances.begin(), m.near / 2);
  const double end = std::isinf(m.far) ? std::min(m.near * kInfiniteReach, kLargest) : m.far;
  const bool fine = end / m.near < 1000;
  const int first = static_cast<int>(std::floor(std::log10(m.near)));
  const int last = static_cast<int>(std::ceil(std::log10(end)));
  const int stride = 1 + (last - first) / kMostDecades;
  for (int exponent = first; exponent < last; exponent += stride)
    for (const char* digit : {"1", "2", "5"}) {
      const double distance = decimal(digit, exponent);
      if (distance > m.near && distance < end && (fine || *digit == '1')) distances.push_back(distance);
    }
  distances.push_back(std::isinf(m.far) ? rounded(end) : end);
  return distances;
}

std::vector<double> readDistances(const std::string& option, const std::string& text) {
  return readNumbers(option, text, 1, SIZE_MAX, "distances separated by commas, as in 1,10,100");
}

std::vector<double> readDepths(const std::string& option, const std::string& text) {
  return readNumbers(option, text, 1, SIZE_MAX, "depths separated by commas, as in 0.9,0.99");
}

/// Throws UsageError for what the camera cannot see.
void requireInFront(const std::vector<double>& distances, const DepthMapping& m) {
  for (double distance : distances)
    if (!m.orthographic && !(distance > 0))
      throw UsageError("--at " + formatNumber(distance) + ": expected a distance above 0, in front of the eye");
}

/// The camera's near and far forward, reversed, and with far infinite.
std::vector<NamedMapping> mappingsOf(const Projection& projection, double first, double second, bool reverseZ) {
  std::vector<NamedMapping> mappings;
  const bool finite = std::isfinite(projection.zFar());
  for (bool infinite : {false, true}) {
    if (infinite ? projection.isOrthographic() : !finite) continue;
    ProjectionParts p = parts(projection);
    if (infinite) p.far = kInfiniteFar;
    for (bool reversed : {false, true})
      mappings.push_back({reversed   ? (infinite ? "infinite reversed" : "reversed")
                          : infinite ? "infinite"
                                     : "forward",
                          depthMapping(p, first, second, reversed), infinite != finite && reversed == reverseZ,
                          reversed});
  }
  return mappings;
}

/// d16, d24, d32f, as far as they hold the depth range.
std::vector<NamedFormat> formatsFor(double largest, std::vector<std::string>& notes) {
  if (largest <= 1) return {{"d16", unormDepth(16)}, {"d24", unormDepth(24)}, {"d32f", kFloatDepth}};
  notes.push_back("The depth range goes beyond 1: d16 and d24 store whole numbers.");
  std::vector<NamedFormat> formats;
  for (int bits : {16, 24}) {
    const DepthFormat format = integerDepth(bits);
    const std::string name = "d" + std::to_string(bits);
    if (largest <= format.largest)
      formats.push_back({name, format});
    else
      notes.push_back(name + " does not hold it: its largest is " + formatNumber(format.largest) + ".");
  }
  formats.push_back({"d32f", kFloatDepth});
  return formats;
}

struct Options {
  CameraOptions camera;
  std::optional<std::vector<double>> at, depths;
  ReportForm form = ReportForm::table;
};

int run(const Options& o) {
  if (o.camera.lists()) return o.camera.list();
  if (o.depths && o.at) throw UsageError("--depth only turns depths into distances; leave out --at");
  const CameraFile read = o.camera.read();
  if (!read.projection) throw InputError(read.name + ": the camera has no projection");
  requireNear(read, "depth");
  const Viewport viewport = read.viewport.value_or(Viewport{});
  const double first = viewport.depthFirst, second = viewport.depthSecond;
  if (std::min(first, second) < 0)
    throw InputError(read.name + ": viewport.depthRange reaches below 0, where no depth buffer stores anything");

  if (o.depths) {
    const DepthsReport distances{mappingsOf(*read.projection, first, second, read.convention.reverseZ), *o.depths};
    writeOutput(o.form == ReportForm::json ? distancesAsJson(distances) : distancesAsTable(distances));
    return 0;
  }
  DepthReport report;
  report.mappings = mappingsOf(*read.projection, first, second, read.convention.reverseZ);
  report.formats = formatsFor(std::max(first, second), report.notes);
  const DepthMapping& own = report.own();
  if (o.at) requireInFront(*o.at, own);
  report.distances = o.at ? *o.at : defaultDistances(own);
  if (read.convention.ndcZ == NdcZ::minusOneToOne)
    report.notes.push_back(
        "With NDC z of -1..1 reversed d32f gains nothing: (z + 1) / 2 in float32 rounds to 2^-24 first. What is told "
        "of it needs 0..1 (glClipControl).");
  report.notes.push_back("Depths are taken as exact until they are stored; float32 in matrix and shader comes on top.");
  writeOutput(o.form == ReportForm::json ? depthAsJson(report) : depthAsTable(report));
  return 0;
}

}  // namespace

Action defineDepth(CommandLine& line) {
  const auto o = std::make_shared<Options>();
  line.setDescription(
      "What a depth buffer resolves: the camera's window depth, its slope, and one step of d16, d24 and d32f as a "
      "length at each distance; forward, reversed and infinite side by side. Lengths are in the camera's unit.");
  line.setExample("viewproj depth samples/reversed-infinite-depth/camera.json --at 1,10,100");
  o->camera.add(line);
  o->camera.addFile(line);
  o->camera.takeAnyOpening();
  addValue(line, "--at", "DISTANCES", o->at, readDistances,
           "Distances along the viewing axis (default: decades from near to far)");
  addValue(line, "--depth", "DEPTHS", o->depths, readDepths,
           "Only turn these depths into distances along the viewing axis, of each mapping: window depths, and NDC z of "
           "-1..1");
  addReportForm(line, o->form);
  return [o] { return run(*o); };
}

}  // namespace viewproj::cmd
