// Scenes, model matrices and what inspect reads: files of JSON or text that are read as a whole.
#include <cmath>
#include <nlohmann/json.hpp>

#include "commands/inspect_report.hpp"
#include "fuzz.hpp"
#include "output/matrix_text.hpp"
#include "records/model.hpp"
#include "records/scene.hpp"
#include "targets.hpp"
#include "text/error.hpp"
#include "viewproj/camera.hpp"
#include "viewproj/cameras_of.hpp"
#include "viewproj/matrices.hpp"
#include "viewproj/scene.hpp"

namespace viewproj::fuzz {

using namespace detail;
namespace {

using namespace cmd;

void readScene(std::string_view input) {
  giveInput(input);
  constexpr Ray kRays[] = {{{0, 0, 0}, {0, 0, -1}}, {{3, 2, 5}, {-0.48, -0.64, -0.6}}, {{1e7, 0, 0}, {-1, 0, 0}}};
  for (const SceneObject& object : cmd::readScene("-", true)) {
    requireJson(object.id, "an id");
    for (const Ray& ray : kRays) {
      const Hits hits = std::visit([&](const auto& shape) { return intersect(ray, shape); }, object.shape);
      for (const Hit& hit : hits)
        if (!(hit.distance >= 0)) found("a hit behind the ray");
      if (hits.count == 2 && hits.hits[0].distance > hits.hits[1].distance) found("hits are not nearest first");
    }
  }
}

void readModelMatrix(std::string_view input) {
  giveInput(input);
  const Mat4 m = readModel("-");
  for (const auto& row : m.m)
    for (const double entry : row)
      if (!std::isfinite(entry)) found("an entry of a model matrix that is not finite");
  (void)cmd::toWorld(m, {1, 2, 3, 1});
}

void inspectOne(const WrittenMatrix& written, bool float32) {
  constexpr std::size_t kMostConverted = 4;
  const InspectQuery query{.isFloat = float32};
  try {
    const OrderedJson report = inspectReport(written, query);
    requireJson(jsonText(report), "inspect");
    (void)tableText(inspectPage(report), 9);
  } catch (const CameraError&) {  // a calibration that is none
  }
  if (written.isCalibration()) return;
  const std::vector<MatrixCamera> readings = statedReadings(written, query);
  for (std::size_t i = 0; i < std::min(kMostConverted, readings.size()); ++i) try {
      MatrixSet set;
      set.convention = conventions::d3d;
      set.convention.world = readings[i].convention.world;
      set.matrices.push_back({written.name, converted(readings[i], set.convention)});
      requireJson(writeMatrices(set, "json", "the fuzzer"), "inspect --convention");
    } catch (const CameraError&) {
    }
}

void inspect(std::string_view input) {
  constexpr std::size_t kMostInspected = 8;
  std::size_t count = 0;
  for (const WrittenMatrix& written : parseMatrices(std::string(input), "the fuzzer").matrices) {
    if (++count > kMostInspected) return;
    for (const double number : written.numbers)
      if (!std::isfinite(number)) found("an entry that is not finite was read");
    inspectOne(written, count % 2 == 0);
  }
}

}  // namespace

void fuzzScene(std::string_view input) { succeeds(readScene, input); }
void fuzzModel(std::string_view input) { succeeds(readModelMatrix, input); }
void fuzzMatrices(std::string_view input) { succeeds(inspect, input); }

}  // namespace viewproj::fuzz
