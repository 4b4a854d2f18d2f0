#include "commands/pasted/camera_of_matrices.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>

#include "formats/finder/finder.hpp"
#include "formats/open.hpp"
#include "formats/value.hpp"
#include "output/output_file.hpp"
#include "output/report.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "text/utf8.hpp"
#include "viewproj/matrices.hpp"

namespace viewproj::cmd {
namespace {

bool canBe(const ReadMatrix& matrix, ReadingKind kind) {
  const std::vector<Reading>& readings = matrix.found.readings;
  return std::any_of(readings.begin(), readings.end(), [&](const Reading& r) { return r.kind == kind; });
}

/// The kind that its name or the words before it tell; where it cannot be that, or has no name, and of a
/// view-projection, that of all its readings.
std::optional<ReadingKind> kindOf(const ReadMatrix& matrix) {
  const std::vector<Reading>& readings = matrix.found.readings;
  if (readings.empty()) return std::nullopt;
  const std::optional<ReadingKind> told = hintOf(matrix.pasted).kind;
  const ReadingKind first = readings.front().kind;
  const auto isOne = [&] {
    return std::all_of(readings.begin(), readings.end(), [&](const Reading& r) { return r.kind == first; });
  };
  if (told && canBe(matrix, *told)) return told;
  const bool isFree = told || matrix.pasted.name.empty() || first == ReadingKind::viewProjection;
  return isFree && isOne() ? std::optional(first) : std::nullopt;
}

std::string shownNameOf(const ReadMatrix& matrix) {
  const PastedMatrix& m = matrix.pasted;
  return m.name.empty() ? "the matrix in line " + std::to_string(m.line) : visible(m.name);
}

/// The tree of JSON or YAML that a file is; null for any other.
const Document* treeOf(const UnknownFormat& file) {
  const auto* const tree = dynamic_cast<const UnknownFile*>(&file);
  return tree && !tree->file.isPlainText && tree->file.root->is_object() ? &tree->file : nullptr;
}

/// Paths of a file's numbers that are in none of the matrices.
std::vector<std::string> othersIn(const Document& file, const std::vector<PastedMatrix>& matrices) {
  std::set<double> known;
  for (const PastedMatrix& matrix : matrices)
    for (const PrintedNumber& number : matrix.numbers) known.insert(number.value);
  return pathsOfOthers(file, known);
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
    Convention c = reading.camera->convention;
    c.view = stated.view;
    c.vectors = stated.vectors;
    c.storage = stated.storage;
    OrderedJson convention = asJson(c);
    for (const ConventionPreset& preset : conventionPresets())
      if (preset.convention == stated) convention.emplace("preset", preset.name);
    Convention axes = c;
    axes.view = c.world == Handedness::left ? ViewAxes::RUF : ViewAxes::RUB;
    const Projection& p = *lens.projection;
    const double scale = p.isOrthographic() ? 1 : p.zNear();
    OrderedJson each{{"convention", convention},
                     {"cameraAxes", nameOf(kViewNames, axes.view)},
                     {"worldFromCamera", asJson(viewproj::matrix(makeCamera(*reading.camera->pose, p, {1, 1}, axes),
                                                                 Space::world, Space::view))},
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

/// The matrices of a text by their kinds: those of one kind alone are a camera's.
struct KnownMatrices {
  std::vector<ReadMatrix> matrices;
  std::vector<std::optional<ReadingKind>> kinds{};

  explicit KnownMatrices(std::vector<ReadMatrix> all) : matrices(std::move(all)) {
    std::transform(matrices.begin(), matrices.end(), std::back_inserter(kinds), kindOf);
  }
  const ReadMatrix* only(ReadingKind kind) const {
    const auto found = std::find(kinds.begin(), kinds.end(), kind);
    return std::count(kinds.begin(), kinds.end(), kind) == 1
               ? &matrices[static_cast<std::size_t>(found - kinds.begin())]
               : nullptr;
  }
  const ReadMatrix* stand() const {
    const ReadMatrix* const view = only(ReadingKind::view);
    return view ? view : only(ReadingKind::pose);
  }
  /// Of a view or pose, only what has the axes of a reading of this projection, if there is such.
  void keepFitting(const ReadMatrix& stand, const ReadMatrix& lens) {
    prefer(matrices[static_cast<std::size_t>(&stand - matrices.data())].found.readings, [&](const Reading& r) {
      return std::any_of(lens.found.readings.begin(), lens.found.readings.end(), [&](const Reading& l) {
        return l.kind == ReadingKind::projection && r.camera && l.camera->convention.view == r.camera->convention.view;
      });
    });
  }
  /// The one K or P of pixels.
  const ReadMatrix* calibration() const {
    const ReadMatrix *const k = only(ReadingKind::k), *const p = only(ReadingKind::p), *const found = k ? k : p;
    return found && !(k && p) && found->found.readings.front().pixels ? found : nullptr;
  }
};

/// The readings that a calibration's view or pose can have: of OpenCV's axes, unless names beside it speak of others.
void keepOfCalibration(ReadMatrix& matrix) {
  std::vector<Reading>& readings = matrix.found.readings;
  const ViewAxes axes = hintOf(matrix.pasted).axes.value_or(ViewAxes::RDF);
  std::erase_if(readings, [&](const Reading& r) { return r.camera && r.camera->convention.view != axes; });
  const MatrixLayout layout = readings.empty() ? MatrixLayout::either : readings.front().layout;
  std::erase_if(readings, [&](const Reading& r) { return r.camera && r.layout != layout; });
  if (readings.empty()) matrix.found.fault = "none of its readings has the K's axes; --world-from-camera adds a pose";
}

/// A preset for each reading that has one.
std::vector<std::string_view> presetsOf(const std::vector<Reading>& readings, bool isInMemoryOrder) {
  std::vector<std::string_view> names;
  for (const Reading& r : readings)
    for (const ConventionPreset& preset : conventionPresets())
      if (fits(r, preset.convention, isInMemoryOrder) && differences(r, preset.convention).empty()) {
        names.push_back(preset.name);
        break;
      }
  return names.empty() ? std::vector<std::string_view>{"NAME"} : names;
}

}  // namespace

std::string_view presetOf(const std::vector<ReadMatrix>& matrices) {
  const KnownMatrices known(matrices);
  const ReadMatrix *const lens = known.only(ReadingKind::projection), *const stand = known.stand();
  if (!lens || !stand) return "";
  const Reading &p = lens->found.readings.front(), &v = stand->found.readings.front();
  for (const ConventionPreset& preset : conventionPresets())
    if (fits(p, preset, lens->pasted.isInMemoryOrder) && fits(v, preset, stand->pasted.isInMemoryOrder))
      return preset.name;
  return "";
}

void noteOthers(const Document& file, const std::vector<PastedMatrix>& matrices) {
  std::vector<std::string> others = othersIn(file, matrices);
  if (file.isPlainText) std::erase_if(others, [](const std::string& path) { return !path.starts_with('#'); });
  if (!others.empty())
    note(file.name + ": numbers that are no matrix: " + someOf(others, 8) + "; viewproj help parts reads them");
}

NamedMatrix convertOne(const ReadMatrix& matrix, const std::string& name,
                       const std::function<Convention(const Convention&)>& writing, std::optional<Handedness>& world) {
  std::vector<Reading> readings = matrix.found.readings;
  if (readings.empty()) throw InputError(name + ": " + matrix.found.fault);
  // A name that tells the kind decides between the kinds.
  const KindHint hint = hintOf(matrix.pasted);
  prefer(readings, [&](const Reading& r) { return r.kind == hint.kind; });
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
      throw AmbiguousMatrix(name + ": can be read in " + std::to_string(readings.size()) +
                            " ways, which give different matrices; --read-as " +
                            alternatives(presetsOf(readings, matrix.pasted.isInMemoryOrder)) +
                            " chooses, and for matrix --which NAME too; viewproj info lists them");
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
  const Document* const tree = treeOf(file);
  const bool areAlone = !tree || othersIn(*tree, pasted.matrices).empty();
  if (pasted.matrices.empty() || (!areAlone && pasted.matrices.size() < 2)) return std::nullopt;
  using enum ReadingKind;
  KnownMatrices known(readMatrices(file.text, source, file.what(), {readAs, {}, !areAlone && !readAs}));
  if (!areAlone) {
    const std::string_view preset = readAs ? "" : presetOf(known.matrices);
    if (!preset.empty())
      throw InputError(std::string(file.what()) + "; --read-as " + std::string(preset) +
                       " reads its matrices as a camera");
    if (!readAs || !known.only(projection) || !known.stand()) return std::nullopt;
    noteOthers(*tree, pasted.matrices);
  }
  // A calibration has a view or a pose beside it, and no more.
  const std::size_t withPose = known.matrices.size() - (known.stand() ? 1 : 0);
  const bool isCalibration = holdsNoOther(pasted) && withPose == 1 && known.calibration();
  if (isCalibration && !readAs) {
    std::for_each(known.matrices.begin(), known.matrices.end(), keepOfCalibration);
    known = KnownMatrices(std::move(known.matrices));
  }
  const ReadMatrix *const calibration = isCalibration ? known.calibration() : nullptr,
                          *const lens = known.only(projection), *const anyView = known.only(view),
                          *stand = known.stand(), *product = nullptr;
  if (!calibration && !(lens && stand)) product = known.only(viewProjection);
  if (!calibration && !lens && !stand && !product) product = known.only(viewProjectionInverse);
  const bool isWhole = calibration || lens || product;
  if (!isWhole && !stand && readAs)
    for (const ReadMatrix& matrix : known.matrices)
      if (matrix.found.readings.empty())
        throw InputError(source + ": " + shownNameOf(matrix) + ": " + matrix.found.fault);
  if (!isWhole && (!stand || tree)) return std::nullopt;
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
    try {
      set.matrices.push_back(convertOne(matrix, source + ": " + shownNameOf(matrix), writing, world));
    } catch (AmbiguousMatrix& e) {
      e.text = file.text;
      throw;
    }
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
  const Reading& reading = calibration->found.readings.front();
  const bool isP = reading.kind == p;
  if (const double error = reading.pixels->errors[0]; error > 1e-5 * reading.pixels->fx)
    note(source + ": " + shownNameOf(*calibration) + ": its digits tell fx and fy to " + formatDigits(error, 1) +
         " pixels");
  const bool isTurned = reading.layout == MatrixLayout::transposed;
  OrderedJson camera{{isP ? "P" : "K", rowsOf(calibration->pasted, isTurned)}};
  if (isTurned && countsFromOne(calibration->pasted) && !stand)  // in the form of MATLAB
    camera = {{"IntrinsicMatrix", rowsOf(calibration->pasted, false)},
              {"RadialDistortion", {0, 0}},
              {"TangentialDistortion", {0, 0}}};
  if (stand) camera[anyView ? "w2c" : "c2w"] = set.matrices.front().matrix.m;
  return camera.dump();
}

}  // namespace viewproj::cmd
