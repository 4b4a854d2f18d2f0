// Scenes, model matrices and pasted matrices: files of JSON or text that are read as a whole.
#include <cmath>
#include <nlohmann/json.hpp>

#include "commands/pasted/report.hpp"
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
  const Mat4 m = readModel({"-"});
  for (const auto& row : m.m)
    for (const double entry : row)
      if (!std::isfinite(entry)) found("an entry of a model matrix that is not finite");
  (void)cmd::toWorld(m, {1, 2, 3, 1});
}

void readPasted(std::string_view input) {
  constexpr std::size_t kMostRead = 8, kMostConverted = 4;
  std::vector<ReadMatrix> matrices = readMatrices(input, "the fuzzer", "no matrix", {});
  if (matrices.size() > kMostRead) matrices.resize(kMostRead);
  for (const ReadMatrix& matrix : matrices) {
    if (matrix.pasted.numbers.size() != matrix.pasted.rows * matrix.pasted.columns)
      found("a matrix that lacks numbers");
    requireJson(jsonText(matrixReport(matrix)), "info");
    (void)tableText(matrixPage(matrix, nullptr, 1, 1), 9);
    const std::vector<Reading>& readings = matrix.found.readings;
    for (std::size_t i = 0; i < std::min(kMostConverted, readings.size()); ++i) try {
        MatrixSet set;
        set.convention = conventions::d3d;
        set.matrices.push_back(
            {matrix.pasted.name, converted(readings[i], matrixOf(matrix.pasted, readings[i].layout), set.convention)});
        requireJson(writeMatrices(set, "json", "the fuzzer"), "matrix");
      } catch (const CameraError&) {  // a calibration
      }
  }
}

}  // namespace

void fuzzScene(std::string_view input) { succeeds(readScene, input); }
void fuzzModel(std::string_view input) { succeeds(readModelMatrix, input); }
void fuzzMatrices(std::string_view input) { succeeds(readPasted, input); }

}  // namespace viewproj::fuzz
