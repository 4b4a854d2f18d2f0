#include "commands/pasted/camera_of_matrices.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "camera/plain_camera.hpp"
#include "formats/open.hpp"
#include "formats/value.hpp"
#include "output/output_file.hpp"
#include "output/report.hpp"
#include "text/names.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

bool canBe(const ReadMatrix& matrix, ReadingKind kind) {
  const std::vector<Reading>& readings = matrix.found.readings;
  return std::any_of(readings.begin(), readings.end(), [&](const Reading& r) { return r.kind == kind; });
}

/// The kind that its name or the words before it tell, where P is called a projection too; of a matrix without a name,
/// and of a view-projection, that of all its readings.
std::optional<ReadingKind> kindOf(const ReadMatrix& matrix) {
  const std::vector<Reading>& readings = matrix.found.readings;
  if (readings.empty()) return std::nullopt;
  const std::optional<ReadingKind> told = hintOf(matrix.pasted).kind;
  const ReadingKind first = readings.front().kind;
  const auto isOne = [&] {
    return std::all_of(readings.begin(), readings.end(), [&](const Reading& r) { return r.kind == first; });
  };
  if (told && canBe(matrix, *told)) return told;
  const bool isP = told == ReadingKind::projection && first == ReadingKind::p;
  const bool needsNoName = isP || matrix.pasted.name.empty() || first == ReadingKind::viewProjection;
  return needsNoName && !(told && !isP) && isOne() ? std::optional(first) : std::nullopt;
}

std::string shownNameOf(const ReadMatrix& matrix) {
  const PastedMatrix& m = matrix.pasted;
  return m.name.empty() ? "the matrix in line " + std::to_string(m.line) : visible(m.name);
}

std::size_t countNumbers(const Json& value) {
  if (!value.is_structured()) {
    const auto numbers = value.is_boolean() || value.is_null() ? std::nullopt : numbersIn(value);
    return numbers ? numbers->size() : 0;
  }
  std::size_t count = 0;
  for (const Json& part : value) count += countNumbers(part);
  return count;
}

bool isTree(const UnknownFormat& file) {
  const auto* const tree = dynamic_cast<const UnknownFile*>(&file);
  return tree && !tree->file.isPlainText && tree->file.root->is_object();
}

/// Of a tree of JSON or YAML: whether all of its numbers are the matrices'.
bool holdsMatricesAlone(const UnknownFormat& file, const PastedMatrices& pasted) {
  if (!isTree(file)) return true;
  std::size_t numbers = 0;
  for (const PastedMatrix& m : pasted.matrices) numbers += m.numbers.size();
  const std::size_t count = countNumbers(*dynamic_cast<const UnknownFile&>(file).file.root);
  return count == 0 || count == numbers;
}

/// Whether the text has no other named numbers, which may be a distortion or a place.
bool holdsNoOther(const PastedMatrices& pasted) {
  return std::all_of(pasted.passedOver.begin(), pasted.passedOver.end(),
                     [](const PassedOver& over) { return over.name.empty(); });
}

/// The camera of a view-projection or its inverse, which all readings give. Throws InputError after its name.
std::string cameraOfProduct(const ReadMatrix& matrix, const std::string& name, const Convention& stated) {
  OrderedJson camera;
  for (const Reading& reading : matrix.found.readings) {
    if (reading.kind != matrix.found.readings.front().kind) continue;
    const MatrixLens& lens = *reading.camera->lens;
    if (!lens.projection)
      throw InputError(name + ": " +
                       (lens.depthFault.empty()
                            ? "its digits do not tell near and far; info tells its eye, axes and fields of view"
                            : lens.depthFault));
    Convention c = stated;
    c.world = reading.camera->convention.world;
    c.ndcZ = reading.camera->convention.ndcZ;
    c.ndcY = reading.camera->convention.ndcY;
    c.reverseZ = reading.camera->convention.reverseZ;
    OrderedJson convention = asJson(c);
    for (const ConventionPreset& preset : conventionPresets())
      if (preset.convention == stated) convention.emplace("preset", preset.name);
    const bool isLeft = c.world == Handedness::left;
    const auto [x, t] = worldFromCamera(plainPose(*reading.camera->pose), isLeft ? CameraAxes::RUF : CameraAxes::RUB);
    const Projection& p = *lens.projection;
    const double scale = p.isOrthographic() ? 1 : p.zNear();
    OrderedJson each{{"convention", convention},
                     {"cameraAxes", isLeft ? "RUF" : "RUB"},
                     {"worldFromCamera",
                      {{x[0].x, x[1].x, x[2].x, t.x}, {x[0].y, x[1].y, x[2].y, t.y}, {x[0].z, x[1].z, x[2].z, t.z}}},
                     {"projection",
                      {{"type", p.isOrthographic() ? "orthographic" : "frustum"},
                       {"left", p.left() * scale},
                       {"right", p.right() * scale},
                       {"bottom", p.bottom() * scale},
                       {"top", p.top() * scale},
                       {"near", p.zNear()}}}};
    if (std::isfinite(p.zFar())) each["projection"]["far"] = p.zFar();
    if (!camera.is_null() && camera != each)
      throw InputError(name + ": can be read in several ways; viewproj info lists them, --read-as NAME chooses");
    camera = std::move(each);
  }
  const bool isOrthographic = camera["projection"]["type"] == "orthographic";
  note(name + ": is made a camera, which agrees to the digits that it has" +
       (isOrthographic ? "; it does not tell the eye, from which viewDistance counts" : ""));
  return camera.dump();
}

/// As it stands, or turned.
OrderedJson numbersOf(const PastedMatrix& m, MatrixLayout layout) {
  const bool isTurned = layout == MatrixLayout::transposed;
  OrderedJson rows = OrderedJson::array();
  for (std::size_t i = 0; i < (isTurned ? m.columns : m.rows); ++i) {
    rows.push_back(OrderedJson::array());
    for (std::size_t j = 0; j < (isTurned ? m.rows : m.columns); ++j)
      rows.back().push_back(isTurned ? m.at(j, i) : m.at(i, j));
  }
  return rows;
}

/// The matrices of a text by their kinds: those of one kind alone are a camera's.
struct KnownMatrices {
  std::vector<ReadMatrix> matrices;
  std::vector<std::optional<ReadingKind>> kinds;

  KnownMatrices(const UnknownFormat& file, const std::string& source, const std::optional<Convention>& readAs)
      : matrices(readMatrices(file.text, source, file.what(), {readAs, {}})) {
    std::transform(matrices.begin(), matrices.end(), std::back_inserter(kinds), kindOf);
  }
  const ReadMatrix* only(ReadingKind kind) const {
    const auto found = std::find(kinds.begin(), kinds.end(), kind);
    return std::count(kinds.begin(), kinds.end(), kind) == 1
               ? &matrices[static_cast<std::size_t>(found - kinds.begin())]
               : nullptr;
  }
  /// Of a view or pose, only what has the axes of a reading of this projection, if there is such.
  void keepFitting(const ReadMatrix& stand, const ReadMatrix& lens) {
    const auto axesOf = [](const Reading& r) {
      return r.camera ? std::optional(r.camera->convention.view) : std::nullopt;
    };
    const auto fitsLens = [&](const Reading& r) {
      return std::any_of(lens.found.readings.begin(), lens.found.readings.end(),
                         [&](const Reading& l) { return l.kind == ReadingKind::projection && axesOf(l) == axesOf(r); });
    };
    const bool doSome = std::any_of(stand.found.readings.begin(), stand.found.readings.end(), fitsLens);
    if (doSome)
      std::erase_if(matrices[static_cast<std::size_t>(&stand - matrices.data())].found.readings,
                    [&](const Reading& r) { return !fitsLens(r); });
  }
  /// The one K or P of pixels.
  const ReadMatrix* calibration() const {
    const ReadMatrix *const k = only(ReadingKind::k), *const p = only(ReadingKind::p), *const found = k ? k : p;
    return found && !(k && p) && found->found.readings.front().pixels ? found : nullptr;
  }
};

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
  const PastedMatrices pasted = findMatrices(file.text);
  if (pasted.matrices.empty() || !holdsMatricesAlone(file, pasted)) return std::nullopt;
  using enum ReadingKind;
  KnownMatrices known(file, source, readAs);
  // A calibration has a view or a pose beside it, and no more.
  const std::size_t withPose = known.matrices.size() - (known.only(view) || known.only(ReadingKind::pose) ? 1 : 0);
  const bool isCalibration = holdsNoOther(pasted) && withPose == 1 && known.calibration();
  if (isCalibration && !readAs) known = KnownMatrices(file, source, conventions::opencv.convention);
  const ReadMatrix *const calibration = isCalibration ? known.calibration() : nullptr,
                          *const lens = known.only(projection), *const anyView = known.only(view),
                          *stand = anyView ? anyView : known.only(pose), *product = nullptr;
  if (!calibration && !(lens && stand)) product = known.only(viewProjection);
  if (!calibration && !lens && !stand && !product) product = known.only(viewProjectionInverse);
  const bool isWhole = calibration || lens || product;
  if (!isWhole && !stand && readAs)
    for (const ReadMatrix& matrix : known.matrices)
      if (matrix.found.readings.empty())
        throw InputError(source + ": " + shownNameOf(matrix) + ": " + matrix.found.fault);
  if (!isWhole && (!stand || isTree(file))) return std::nullopt;
  if (product || (calibration && calibration->found.readings.front().kind == p)) stand = nullptr;

  if (stand && lens) known.keepFitting(*stand, *lens);

  MatrixSet set;
  std::optional<Handedness> world;
  set.convention = isCalibration ? conventions::opencv.convention : readAs.value_or(Convention{});
  if (lens)
    for (const Reading& reading : lens->found.readings)
      if (reading.kind == projection) set.convention.reverseZ = reading.camera->convention.reverseZ;
  const auto writing = [&](const Convention& own) {
    Convention c = set.convention;
    c.world = own.world;
    return c;
  };
  const auto add = [&](const ReadMatrix& matrix, std::string name) {
    set.matrices.push_back(convertOne(matrix, source + ": " + shownNameOf(matrix), writing, world));
    set.matrices.back().name = std::move(name);
  };
  if (stand) add(*stand, anyView ? "view" : "viewInverse");
  if (lens && !product) add(*lens, "projection");
  set.convention.world = world.value_or(set.convention.world);

  std::string others;
  for (std::size_t i = 0; i < known.matrices.size(); ++i) {
    const ReadMatrix& matrix = known.matrices[i];
    const auto kind = known.kinds[i];
    const bool isOfThem = kind == viewProjection || kind == viewProjectionInverse || kind == projectionInverse;
    if (&matrix == stand || &matrix == lens || &matrix == product || &matrix == calibration || isOfThem) continue;
    others += (others.empty() ? "" : ", ") + shownNameOf(matrix);
    if (matrix.found.readings.empty())
      others += " (" + matrix.found.fault + ")";
    else if (!stand && !product && !kind && canBe(matrix, view))
      others += " (a view or a pose; 'view =' or 'pose =' in front of it says which)";
  }
  if (!others.empty()) note(source + ": not read: " + others);
  if (product) return cameraOfProduct(*product, source + ": " + shownNameOf(*product), readAs.value_or(Convention{}));
  if (!calibration) return writeMatrices(set, "json", source);
  const bool isP = calibration->found.readings.front().kind == p;
  OrderedJson camera{{isP ? "P" : "K", numbersOf(calibration->pasted, calibration->found.readings.front().layout)}};
  if (stand) camera[anyView ? "w2c" : "c2w"] = set.matrices.front().matrix.m;
  return camera.dump();
}

}  // namespace viewproj::cmd
