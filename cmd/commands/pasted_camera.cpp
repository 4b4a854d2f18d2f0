#include "commands/pasted_camera.hpp"

#include <algorithm>

#include "text/names.hpp"

namespace viewproj::cmd {
namespace {

/// The kind that its name tells, else the likeliest.
ReadingKind kindOf(const ReadMatrix& matrix) {
  const std::vector<Reading>& readings = matrix.found.readings;
  const KindHint hint = hintOf(matrix.pasted);
  const auto named =
      std::find_if(readings.begin(), readings.end(), [&](const Reading& r) { return r.kind == hint.kind; });
  return named == readings.end() ? readings.front().kind : named->kind;
}

}  // namespace

NamedMatrix convertOne(const ReadMatrix& matrix, const std::string& name,
                       const std::function<Convention(const Convention&)>& writing, std::optional<Handedness>& world) {
  std::vector<Reading> readings = matrix.found.readings;
  if (readings.empty()) throw InputError(name + ": " + matrix.found.fault);
  // A name that tells the kind decides between the kinds.
  const KindHint hint = hintOf(matrix.pasted);
  const auto isNamed = [&](const Reading& r) { return r.kind == hint.kind; };
  if (std::any_of(readings.begin(), readings.end(), isNamed))
    std::erase_if(readings, [&](const Reading& r) { return !isNamed(r); });
  std::optional<Mat4> result;
  for (const Reading& r : readings) {
    Mat4 each;
    try {
      const Convention own = r.camera ? r.camera->convention : Convention{};
      each = converted(r, matrixOf(matrix.pasted, r.layout), writing(own));
    } catch (const CameraError& e) {
      throw InputError(name + ": " + e.message());
    }
    if (result && !(*result == each))
      throw InputError(
          name + ": can be read in " + std::to_string(readings.size()) +
          " ways, which give different matrices; viewproj info lists them, --read-as NAME chooses, and for matrix "
          "--which NAME too");
    result = each;
  }
  if (readings.front().camera->pose) {
    const Handedness own = readings.front().camera->convention.world;
    if (world.value_or(own) != own)
      throw InputError(name + ": its world is " + std::string(nameOf(kWorldNames, own)) +
                       "-handed, unlike that of the matrices before it; --which picks");
    world = own;
  }
  return {name, *result};
}

std::optional<std::string> cameraOfMatrices(const UnknownFormat& file, const std::string& source,
                                            const std::optional<Convention>& readAs) {
  if (findMatrices(file.text).matrices.empty()) return std::nullopt;
  const ReadMatrix *pose = nullptr, *projection = nullptr;
  const std::vector<ReadMatrix> matrices = readMatrices(file.text, source, file.what(), {readAs, {}});
  for (const ReadMatrix& matrix : matrices) {
    if (matrix.found.readings.empty()) continue;
    const ReadingKind kind = kindOf(matrix);
    const bool isPose = kind == ReadingKind::view || kind == ReadingKind::pose;
    if (!isPose && kind != ReadingKind::projection) continue;
    const ReadMatrix*& found = isPose ? pose : projection;
    if (found) return std::nullopt;
    found = &matrix;
  }
  if (!pose || !projection) return std::nullopt;
  MatrixSet set;
  std::optional<Handedness> world;
  set.convention = readAs.value_or(Convention{});
  const auto writing = [&](const Convention& own) {
    Convention c = set.convention;
    c.world = own.world;
    return c;
  };
  for (const ReadMatrix* matrix : {pose, projection}) {
    set.matrices.push_back(convertOne(*matrix, source + ": " + matrix->pasted.name, writing, world));
    const ReadingKind kind = kindOf(*matrix);
    set.matrices.back().name = kind == ReadingKind::projection ? "projection"
                               : kind == ReadingKind::view     ? "view"
                                                               : "viewInverse";
  }
  set.convention.world = *world;
  return writeMatrices(set, "json", source);
}

}  // namespace viewproj::cmd
