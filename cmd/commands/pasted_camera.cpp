#include "commands/pasted_camera.hpp"

#include <algorithm>
#include <iterator>

#include "output/output_file.hpp"
#include "text/names.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

/// The kind that its name or the words before it tell; of a matrix without a name, that of all its readings.
std::optional<ReadingKind> kindOf(const ReadMatrix& matrix) {
  const std::vector<Reading>& readings = matrix.found.readings;
  if (readings.empty()) return std::nullopt;
  const std::optional<ReadingKind> told = hintOf(matrix.pasted).kind;
  const ReadingKind kind = told.value_or(readings.front().kind);
  const auto is = [&](const Reading& r) { return r.kind == kind; };
  const bool fits = told ? std::any_of(readings.begin(), readings.end(), is)
                         : matrix.pasted.name.empty() && std::all_of(readings.begin(), readings.end(), is);
  return fits ? std::optional(kind) : std::nullopt;
}

std::string shownNameOf(const ReadMatrix& matrix) {
  const PastedMatrix& m = matrix.pasted;
  return m.name.empty() ? "the matrix in line " + std::to_string(m.line) : visible(m.name);
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
  const std::vector<ReadMatrix> matrices = readMatrices(file.text, source, file.what(), {readAs, {}});
  std::vector<std::optional<ReadingKind>> kinds;
  std::transform(matrices.begin(), matrices.end(), std::back_inserter(kinds), kindOf);
  const auto only = [&](ReadingKind kind) -> const ReadMatrix* {
    const auto found = std::find(kinds.begin(), kinds.end(), kind);
    return std::count(kinds.begin(), kinds.end(), kind) == 1
               ? &matrices[static_cast<std::size_t>(found - kinds.begin())]
               : nullptr;
  };
  const ReadMatrix *const view = only(ReadingKind::view), *const pose = view ? view : only(ReadingKind::pose),
                          *const projection = only(ReadingKind::projection);
  if (!pose && !projection) return std::nullopt;
  MatrixSet set;
  std::optional<Handedness> world;
  set.convention = readAs.value_or(Convention{});
  if (projection)
    for (const Reading& reading : projection->found.readings)
      if (reading.kind == ReadingKind::projection) set.convention.reverseZ = reading.camera->convention.reverseZ;
  const auto writing = [&](const Convention& own) {
    Convention c = set.convention;
    c.world = own.world;
    return c;
  };
  const auto add = [&](const ReadMatrix& matrix, std::string name) {
    set.matrices.push_back(convertOne(matrix, source + ": " + shownNameOf(matrix), writing, world));
    set.matrices.back().name = std::move(name);
  };
  if (pose) add(*pose, view ? "view" : "viewInverse");
  if (projection) add(*projection, "projection");
  set.convention.world = world.value_or(set.convention.world);
  std::string others;
  for (std::size_t i = 0; i < matrices.size(); ++i) {
    const bool isOfThem = kinds[i] == ReadingKind::viewProjection || kinds[i] == ReadingKind::viewProjectionInverse ||
                          kinds[i] == ReadingKind::projectionInverse;
    if (&matrices[i] != pose && &matrices[i] != projection && !isOfThem)
      others += (others.empty() ? "" : ", ") + shownNameOf(matrices[i]);
  }
  if (!others.empty()) note(source + ": not read: " + others);
  return writeMatrices(set, "json", source);
}

}  // namespace viewproj::cmd
