#include "commands/pasted/camera_of_matrices.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>

#include "camera/plain_camera.hpp"
#include "formats/finder/finder.hpp"
#include "formats/open.hpp"
#include "formats/value.hpp"
#include "output/output_file.hpp"
#include "output/report.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "text/pasted_parts.hpp"
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

/// Whether they are called the picture's size: imageResolution, img.shape with its channels.
bool isSize(const PassedOver& over) {
  const std::string name = pasted::lower(over.name);
  constexpr std::string_view kWords[] = {"size", "resolution", "shape"};
  if (over.numbers == 1) return name.ends_with("width") || name.ends_with("height");
  return (over.numbers == 2 || over.numbers == 3) &&
         std::any_of(std::begin(kWords), std::end(kWords), [&](std::string_view word) { return name.ends_with(word); });
}

/// Whether the text has no other numbers with a name or in a list, which may be a distortion or a place.
bool holdsNoOther(const PastedMatrices& pasted) {
  return std::all_of(pasted.passedOver.begin(), pasted.passedOver.end(), [](const PassedOver& over) {
    return isSize(over) || (over.name.empty() && !(over.isList && over.numbers > 2));
  });
}

/// Whether a preset has its world, range of depth and NDC y.
bool isOfPreset(const Reading& r) {
  return std::any_of(conventionPresets().begin(), conventionPresets().end(), [&](const Convention& c) {
    return fitsButVectors(r, c) && c.world == r.camera->convention.world;
  });
}

/// The presets that choose this reading; those that have all of it, if there are such.
std::vector<std::string_view> presetsOf(const Reading& reading, const std::vector<Reading>& readings,
                                        bool isInMemoryOrder) {
  std::vector<std::string_view> whole, others;
  for (const ConventionPreset& preset : conventionPresets()) {
    const std::vector<Reading> chosen = readingsIn(readings, preset, isInMemoryOrder);
    if (!chosen.empty() && chosen.front().kind == reading.kind && chosen.front().layout == reading.layout &&
        chosen.front().camera->convention == reading.camera->convention)
      (differences(reading, preset).empty() ? whole : others).push_back(preset.name);
  }
  return whole.empty() ? others : whole;
}

/// The presets that choose between these readings, those of the first one first.
std::vector<std::string_view> presetsOf(const std::vector<Reading>& readings, bool isInMemoryOrder) {
  std::vector<std::string_view> names;
  for (const Reading& reading : readings)
    for (const std::string_view name : presetsOf(reading, readings, isInMemoryOrder))
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  return names.empty() ? std::vector<std::string_view>{"NAME"} : names;
}

/// What each of the readings says and not all do: {"ndcZ 0..1, near 0.5", ...}.
std::vector<std::string> whatDiffers(const std::vector<Reading>& readings) {
  std::vector<std::string> all(readings.size());
  const auto add = [&](const auto& factOf) {
    std::vector<std::string> facts;
    std::transform(readings.begin(), readings.end(), std::back_inserter(facts), factOf);
    if (std::equal(facts.begin() + 1, facts.end(), facts.begin())) return;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (!facts[i].empty()) all[i] += (all[i].empty() ? "" : ", ") + facts[i];
  };
  add([](const Reading& r) { return std::string(nameOf(kReadingKinds, r.kind)); });
  add([](const Reading& r) { return std::string(r.layout == MatrixLayout::transposed ? "transposed" : "as written"); });
  add([](const Reading& r) { return "view " + std::string(nameOf(kViewNames, r.camera->convention.view)); });
  add([](const Reading& r) { return "ndcY " + std::string(nameOf(kNdcYNames, r.camera->convention.ndcY)); });
  add([](const Reading& r) { return "ndcZ " + std::string(nameOf(kNdcZNames, r.camera->convention.ndcZ)); });
  add([](const Reading& r) {
    const auto& lens = r.camera->lens;
    return lens && lens->depthFault.empty() ? "near " + formatDigits(lens->zNear.value, 3) : std::string();
  });
  return all;
}

[[noreturn]] void failAmbiguous(const std::string& name, const std::vector<Reading>& readings, bool isInMemoryOrder) {
  const std::vector<std::string> facts = whatDiffers(readings);
  constexpr std::size_t kMostWays = 4, kMostPresets = 5;
  std::string ways;
  for (std::size_t i = 0; i < std::min(readings.size(), kMostWays); ++i) {
    std::vector<std::string_view> presets = presetsOf(readings[i], readings, isInMemoryOrder);
    if (presets.size() > kMostPresets) presets.resize(kMostPresets);
    ways += (i == 0 ? ": " : "; ") + facts[i] + (presets.empty() ? "" : " (--read-as " + alternatives(presets) + ")");
  }
  const bool areOfKinds =
      std::any_of(readings.begin(), readings.end(), [&](const Reading& r) { return r.kind != readings.front().kind; });
  throw AmbiguousMatrix(name + ": can be read in " + std::to_string(readings.size()) +
                        " ways, which give different matrices" + ways +
                        (areOfKinds ? "; of matrix --which KIND chooses too" : "") + "; viewproj info lists them");
}

/// Notes that a camera is made without near and far, since its readings have others.
void noteLackOfDepth(const std::string& name, const std::vector<Reading>& readings, bool isInMemoryOrder) {
  const std::string& fault = readings.front().camera->lens->depthFault;
  note(name + ": " +
       (readings.size() > 1
            ? "can be read in " + std::to_string(readings.size()) +
                  " ways, which differ in depth alone, so that the camera has no near and far; "
                  "--read-as " +
                  alternatives(presetsOf(readings, isInMemoryOrder)) + " gives them"
            : (fault.empty() ? "its digits do not tell near and far" : fault) + ", so that the camera has neither"));
}

/// The camera of a view-projection or its inverse by a reading, with near and far or without.
OrderedJson cameraOfReading(const Reading& reading, const Convention& stated, bool hasDepth) {
  const MatrixLens& lens = *reading.camera->lens;
  Convention c = hasDepth ? reading.camera->convention : Convention{};
  c.world = reading.camera->convention.world;
  if (hasDepth) {
    c.view = stated.view;
    c.vectors = stated.vectors;
    c.storage = stated.storage;
  }
  OrderedJson convention = asJson(c);
  for (const ConventionPreset& preset : conventionPresets())
    if (preset.convention == stated) convention.emplace("preset", preset.name);
  Convention axes = c;
  axes.view = c.world == Handedness::left ? ViewAxes::RUF : ViewAxes::RUB;
  const Projection p =
      hasDepth ? *lens.projection : perspectiveWindow(lens.left, lens.right, lens.bottom, lens.top, 0, kInfiniteFar);
  OrderedJson camera{{"convention", convention},
                     {"cameraAxes", nameOf(kViewNames, axes.view)},
                     {"worldFromCamera", asJson(viewproj::matrix(makeCamera(*reading.camera->pose, p, {1, 1}, axes),
                                                                 Space::world, Space::view))}};
  if (!hasDepth) {
    camera["projection"] = {{"type", "matrix"}, {"matrix", asJson(clipFromView(p, c))}};
    return camera;
  }
  const double scale = p.isOrthographic() ? 1 : p.zNear();
  camera["projection"] = {{"type", p.isOrthographic() ? "orthographic" : "frustum"},
                          {"left", p.left() * scale},
                          {"right", p.right() * scale},
                          {"bottom", p.bottom() * scale},
                          {"top", p.top() * scale},
                          {"near", p.zNear()}};
  if (std::isfinite(p.zFar())) camera["projection"]["far"] = p.zFar();
  return camera;
}

template <class Values>
bool areAlike(const Values& values) {
  return std::adjacent_find(values.begin(), values.end(), std::not_equal_to<>()) == values.end();
}

/// The camera of a view-projection or its inverse, which all readings give. Throws InputError after its name.
std::string cameraOfProduct(const ReadMatrix& matrix, const std::string& name, const Convention& stated) {
  const bool isInMemoryOrder = matrix.pasted.isInMemoryOrder;
  std::vector<Reading> readings = matrix.found.readings;
  const ReadingKind kind = readings.front().kind;
  std::erase_if(readings, [&](const Reading& r) { return r.kind != kind; });
  prefer(readings, isOfPreset);
  const auto camerasWith = [&](bool hasDepth) {
    std::vector<OrderedJson> cameras;
    for (const Reading& r : readings) cameras.push_back(cameraOfReading(r, stated, hasDepth));
    return cameras;
  };
  const bool isOrthographic = readings.front().camera->lens->orthographic;
  const bool haveDepth = std::all_of(readings.begin(), readings.end(), [](const Reading& r) {
    return r.camera->lens->projection && r.camera->lens->depthFault.empty();
  });
  if (isOrthographic && !haveDepth) throw InputError(name + ": its digits do not tell near and far");
  std::vector<OrderedJson> cameras = camerasWith(haveDepth);
  const bool lacksDepth = !haveDepth || (!isOrthographic && !areAlike(cameras));
  if (lacksDepth && haveDepth) cameras = camerasWith(false);
  if (!areAlike(cameras)) failAmbiguous(name, readings, isInMemoryOrder);
  if (lacksDepth) noteLackOfDepth(name, readings, isInMemoryOrder);
  note(name + ": is made a camera, which agrees to the digits that it has" +
       (isOrthographic ? "; it does not tell the eye, from which viewDistance counts" : ""));
  return cameras.front().dump();
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
  /// Of a projection and of a view or pose, the readings with axes that both can have, and of these with the axes of
  /// which the names beside them speak, where there are such. Returns those of which names chose.
  std::vector<const ReadMatrix*> keepFitting(const ReadMatrix* stand, const ReadMatrix* lens) {
    std::vector<ReadMatrix*> both;
    for (ReadMatrix& matrix : matrices)
      if (&matrix == stand || &matrix == lens) both.push_back(&matrix);
    const auto has = [](const ReadMatrix& m, ViewAxes axes) {
      return std::any_of(m.found.readings.begin(), m.found.readings.end(),
                         [&](const Reading& r) { return r.camera && r.camera->convention.view == axes; });
    };
    const auto keep = [&](const auto& isKept) {
      std::vector<const ReadMatrix*> changed;
      for (ReadMatrix* matrix : both) {
        const std::size_t before = matrix->found.readings.size();
        prefer(matrix->found.readings,
               [&](const Reading& r) { return !r.camera || isKept(r.camera->convention.view); });
        if (matrix->found.readings.size() < before) changed.push_back(matrix);
      }
      return changed;
    };
    keep([&](ViewAxes axes) { return std::all_of(both.begin(), both.end(), [&](auto* m) { return has(*m, axes); }); });
    std::optional<ViewAxes> named;
    for (const ReadMatrix* matrix : both)
      if (const auto axes = hintOf(matrix->pasted).axes; axes && has(*matrix, *axes)) named = axes;
    return named ? keep([&](ViewAxes axes) { return axes == *named; }) : std::vector<const ReadMatrix*>();
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

}  // namespace

namespace {

/// The preset by which a projection and a view or pose are read in their first readings; or empty.
std::string_view presetOf(const KnownMatrices& known) {
  const ReadMatrix *const lens = known.only(ReadingKind::projection), *const stand = known.stand();
  if (!lens || !stand) return "";
  const Reading &p = lens->found.readings.front(), &v = stand->found.readings.front();
  for (const ConventionPreset& preset : conventionPresets())
    if (fits(p, preset, lens->pasted.isInMemoryOrder) && fits(v, preset, stand->pasted.isInMemoryOrder))
      return preset.name;
  return "";
}

std::optional<Vec2> sizeBeside(const std::string& text, const Reading& reading) {
  if (reading.pixels) return sizeIn(text, Vec2{reading.pixels->cx, reading.pixels->cy}, 0);
  if (!reading.camera || !reading.camera->lens) return std::nullopt;
  const MatrixLens& lens = *reading.camera->lens;
  return sizeIn(text, {}, (lens.right - lens.left) / (lens.top - lens.bottom));
}

}  // namespace

std::string optionsOf(const std::vector<ReadMatrix>& matrices, const std::string& text, bool isTree) {
  const KnownMatrices known(matrices);
  const ReadMatrix *const stand = known.stand(), *const calibration = known.calibration(),
                          *const lens = known.only(ReadingKind::projection),
                          *const product = known.only(ReadingKind::viewProjection);
  const ReadMatrix* const shape = calibration ? calibration : lens ? lens : product;
  const std::string viewport = viewportOption(shape ? sizeBeside(text, shape->found.readings.front()) : std::nullopt);
  std::string preset(presetOf(known));
  if (!preset.empty()) return " --read-as " + preset + viewport;
  if (isTree) return "";
  const bool isWhole = matrices.size() == (stand ? 2 : 1);
  if (calibration)
    return isWhole && calibration->pasted.numbers.size() <= 12 && holdsNoOther(findMatrices(text)) ? viewport : "";
  const ReadMatrix* const alone = stand ? stand : product;
  if (!alone || matrices.size() > 1) return "";
  std::vector<Reading> readings = alone->found.readings;
  const ReadingKind kind = product                         ? ReadingKind::viewProjection
                           : known.only(ReadingKind::view) ? ReadingKind::view
                                                           : ReadingKind::pose;
  prefer(readings, [&](const Reading& r) { return r.kind == kind; });
  preset = presetsOf(readings, alone->pasted.isInMemoryOrder).front();
  return " --read-as " + preset + (stand ? fovIn(text) : "") + viewport;
}

void noteOthers(const Document& file, const std::vector<PastedMatrix>& matrices) {
  std::vector<std::string> others = othersIn(file, matrices);
  if (file.isPlainText) std::erase_if(others, [](const std::string& path) { return !path.starts_with('#'); });
  if (!others.empty())
    note(file.name + ": numbers that are no matrix: " + someOf(others, 8) + "; viewproj help parts reads them");
}

NamedMatrix convertOne(const ReadMatrix& matrix, const std::string& name,
                       const std::function<Convention(const Convention&)>& writing, std::optional<Handedness>& world,
                       bool mayLackDepth) {
  std::vector<Reading> readings = matrix.found.readings;
  if (readings.empty()) throw InputError(name + ": " + matrix.found.fault);
  // A name that tells the kind decides between the kinds.
  const KindHint hint = hintOf(matrix.pasted);
  prefer(readings, [&](const Reading& r) { return r.kind == hint.kind; });
  std::vector<Mat4> all;
  for (const Reading& r : readings) try {
      const Convention own = r.camera ? r.camera->convention : Convention{};
      all.push_back(converted(r, matrixOf(matrix.pasted, r.layout), writing(own)));
    } catch (const CameraError& e) {
      throw InputError(name + ": " + e.message());
    }
  const bool isLens = std::all_of(readings.begin(), readings.end(), [](const Reading& r) {
    return r.kind == ReadingKind::projection && !r.camera->lens->orthographic;
  });
  const bool lacksDepth = mayLackDepth && isLens && !areAlike(all);
  if (lacksDepth)
    for (Mat4& each : all) each[2] = {};
  if (!areAlike(all)) failAmbiguous(name, readings, matrix.pasted.isInMemoryOrder);
  if (lacksDepth) noteLackOfDepth(name, readings, matrix.pasted.isInMemoryOrder);
  if (readings.front().camera->pose) {
    const Handedness own = readings.front().camera->convention.world;
    if (world.value_or(own) != own)
      throw InputError(name + ": its world is " + std::string(nameOf(kWorldNames, own)) +
                       "-handed, unlike that of the matrices before it; --which picks");
    world = own;
  }
  return {name, all.front()};
}

namespace {

std::optional<std::string> cameraIn(const UnknownFormat& file, const std::string& source,
                                    const std::optional<Convention>& readAs) {
  const PastedMatrices pasted = findMatrices(file.text);
  const Document* const tree = treeOf(file);
  const bool areAlone = !tree || othersIn(*tree, pasted.matrices).empty();
  if (pasted.matrices.empty() || (!areAlone && pasted.matrices.size() < 2)) return std::nullopt;
  using enum ReadingKind;
  KnownMatrices known(readMatrices(file.text, source, file.what(), {readAs, {}, !areAlone && !readAs}));
  if (!areAlone) {
    const std::string_view preset = readAs ? "" : presetOf(known);
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

  if (const auto named = known.keepFitting(stand, lens); !named.empty()) {
    std::vector<std::string> names;
    for (const ReadMatrix* matrix : named) names.push_back(shownNameOf(*matrix));
    note(source + ": " + joined(names) + ": names choose the view's axes " +
         std::string(nameOf(kViewNames, named.front()->found.readings.front().camera->convention.view)) +
         "; --read-as NAME reads others");
  }

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
    set.matrices.push_back(convertOne(matrix, source + ": " + shownNameOf(matrix), writing, world, true));
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
  if (std::any_of(pasted.passedOver.begin(), pasted.passedOver.end(), isSize))
    if (const auto size = sizeBeside(file.text, reading)) camera.update({{"width", size->x}, {"height", size->y}});
  return camera.dump();
}

}  // namespace

std::optional<std::string> cameraOfMatrices(const UnknownFormat& file, const std::string& source,
                                            const std::optional<Convention>& readAs) {
  try {
    return cameraIn(file, source, readAs);
  } catch (AmbiguousMatrix& e) {
    e.text = file.text;
    throw;
  }
}

}  // namespace viewproj::cmd
