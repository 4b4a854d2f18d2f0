// viewproj matrix: a camera's matrices, and pasted matrices in another convention.
#include <algorithm>
#include <cmath>

#include "commands/camera_options.hpp"
#include "commands/command.hpp"
#include "commands/pasted/camera_of_matrices.hpp"
#include "commands/world_options.hpp"
#include "output/matrix_text.hpp"
#include "output/output_file.hpp"
#include "records/model.hpp"
#include "text/error.hpp"
#include "text/file.hpp"
#include "text/names.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

constexpr const char* kModel = "--model";

using Matrices = std::vector<const CameraMatrix*>;

struct MatrixOptions {
  CameraOptions camera;
  bool inverse = false, bakeViewport = false, relativeToEye = false, asFloat = false, all = false;
  std::optional<Matrices> which;
  std::vector<std::string> models;
  WorldOptions world;
  std::string_view format = "json";
};

bool any(const Matrices& rows, bool CameraMatrix::*needs) {
  return std::any_of(rows.begin(), rows.end(), [&](const CameraMatrix* row) { return row->*needs; });
}

/// What the camera lacks for a matrix, or an empty string.
std::string lacking(const CameraMatrix& row, const MatrixSource& source) {
  const CameraFile& file = source.file;
  const bool needsViewport = row.viewport || (source.bakeViewport && row.projection);
  if (row.model && !source.worldFromLocal) return kModel;
  if (row.pose && !file.pose) return "a pose";
  if (row.projection && !file.projection) return "a projection";
  if (row.projection && row.ofCalibration.empty() && !hasDepth(*file.projection)) return "near; --near gives it";
  if (needsViewport && !file.viewport) return "a viewport; --viewport WIDTHxHEIGHT gives one";
  return "";
}

/// An option that changes the matrices that need a part of the camera.
struct Change {
  const char* option;
  bool isGiven;
  bool CameraMatrix::*part;
  const char* matrices;
};

std::array<Change, 3> changesOf(const MatrixOptions& o) {
  return {{{"--bake-viewport", o.bakeViewport, &CameraMatrix::projection, "the projection"},
           {"--relative-to-eye", o.relativeToEye, &CameraMatrix::pose, "the view"},
           {kModel, !o.models.empty(), &CameraMatrix::model, "modelView and modelViewProjection"}}};
}

/// The viewport is no part of a matrix that is of pixels already.
bool isChanged(const Matrices& rows, const Change& change) {
  return std::any_of(rows.begin(), rows.end(), [&](const CameraMatrix* row) {
    return row->*change.part && (row->ofCalibration.empty() || change.part == &CameraMatrix::pose);
  });
}

/// --which; or all that the camera determines. Throws UsageError for an option that changes none of them, and
/// InputError where the camera lacks a part.
Matrices chooseMatrices(const MatrixOptions& o, const MatrixSource& source) {
  const std::string& name = source.file.name;
  Matrices chosen = o.which.value_or(Matrices());
  for (const CameraMatrix* row : chosen) {
    const std::string part = lacking(*row, source), message = std::string(row->name) + " needs " + part;
    if (part == kModel) throw UsageError(message + ", which says where the model stands");
    if (!part.empty()) source.file.fail(name + ": " + message);
  }
  // A baked viewport is in the projection already.
  for (const CameraMatrix& row : cameraMatrices())
    if (!o.which && row.ofCalibration.empty() && lacking(row, source).empty() && !(source.bakeViewport && row.viewport))
      chosen.push_back(&row);
  for (const Change& change : changesOf(o)) {
    if (!change.isGiven || any(chosen, change.part)) continue;
    const std::string option = change.option;
    const auto row = std::find_if(cameraMatrices().begin(), cameraMatrices().end(),
                                  [&](const CameraMatrix& each) { return each.*change.part; });
    source.file.fail(name + ": " + option + " needs " + lacking(*row, source));
  }
  if (chosen.empty()) {
    requireNear(source.file, "projection");
    source.file.fail(name + ": the camera has neither a pose, a projection nor a viewport");
  }
  return chosen;
}

Names<const CameraMatrix*> matrixNames() {
  Names<const CameraMatrix*> names;
  for (const CameraMatrix& row : cameraMatrices()) names.emplace_back(row.name, &row);
  return names;
}

MatrixSet matricesOf(const CameraFile& read, const std::optional<Mat4>& model, const MatrixOptions& o) {
  MatrixSet set;
  set.asFloat = o.asFloat;
  set.convention = o.camera.writing(read.convention);
  const MatrixSource source{.file = read,
                            .convention = set.convention,
                            .worldFromLocal = model,
                            .bakeViewport = o.bakeViewport,
                            .relativeToEye = o.relativeToEye};
  const Matrices chosen = chooseMatrices(o, source);
  if (any(chosen, &CameraMatrix::pose)) o.camera.noteHandedness(read);
  if (read.lens && any(chosen, &CameraMatrix::projection))
    note(read.name + ": a matrix leaves out the lens distortion");
  const auto add = [&](const CameraMatrix& row, bool inverse) {
    try {
      set.matrices.push_back(row.make(source, inverse));
    } catch (const CameraError& e) {
      throw InputError("--model " + joined(o.models, " --model ") + ": " + e.message());
    }
  };
  for (const CameraMatrix* row : chosen) {
    add(*row, false);
    if (o.inverse) add(*row, true);
  }
  if (o.relativeToEye && read.pose) set.eye = read.pose->eye();
  set.bakesViewport = o.bakeViewport;
  return set;
}

/// The matrices of a text in another convention or language, by signs and layout alone.
int runPasted(const MatrixOptions& o, const CLI::App& app, const UnknownFormat& unknown) {
  for (const char* option :
       {"--inverse", "--bake-viewport", "--relative-to-eye", "--model", "--all", "--map", "--scale"})
    if (isGiven(app, option)) throw UsageError(std::string(option) + " is for a camera; " + unknown.what());
  if (o.camera.changesCamera()) throw InputError(unknown.what());
  MatrixQuestion question{o.camera.readAs(), {}};
  for (const CameraMatrix* row : o.which.value_or(Matrices())) {
    const auto kind = rowNamed(kReadingKinds, row->name);
    if (!kind) throw UsageError("--which " + std::string(row->name) + " is of a camera; " + unknown.what());
    question.which.push_back(kind->second);
  }
  const std::string source = shownName(o.camera.file().value_or("-"));
  std::vector<ReadMatrix> matrices = readMatrices(unknown.text, source, unknown.what(), question);
  if (o.which) std::erase_if(matrices, [](const ReadMatrix& m) { return m.found.readings.empty(); });
  if (matrices.empty()) throw InputError(source + ": has no matrix that can be what --which names");
  MatrixSet set;
  set.asFloat = o.asFloat;
  std::optional<Handedness> world;
  const auto writing = [&](const Convention& own) { return o.camera.writing(own); };
  for (std::size_t i = 0; i < matrices.size(); ++i) {
    std::string name = visible(matrices[i].pasted.name);
    const auto isTaken = [&](const NamedMatrix& m) { return m.name == name; };
    if (name.empty() || std::any_of(set.matrices.begin(), set.matrices.end(), isTaken))
      name += (name.empty() ? "matrix " : " ") + std::to_string(i + 1);
    set.matrices.push_back(convertOne(matrices[i], name, writing, world));
  }
  const Convention read = o.camera.readAs().value_or(Convention{});
  set.convention = o.camera.writing(read);
  set.convention.world = world.value_or(read.world);
  writeOutput(writeMatrices(set, o.format, source));
  return 0;
}

int runCamera(const MatrixOptions& o, const CLI::App& app) {
  if (!isGiven(app, "--to") && isEnding(endingOf(outputFile(app)), o.all ? ".json" : ".ndjson .jsonl"))
    throw UsageError(o.all ? "--all writes a line of JSON for each camera, which is no .json; call the file .ndjson"
                           : "-o: one camera's matrices are one JSON document, a .json; --all writes lines");
  const bool isText = o.all && o.format != "json";
  if (isText && o.relativeToEye) throw UsageError("--relative-to-eye with --all is for JSON, where each has its eye");
  for (const Change& change : changesOf(o))
    if (o.which && change.isGiven && !isChanged(*o.which, change))
      throw UsageError(std::string(change.option) + " is for " + change.matrices +
                       ", and --which names no such matrix");
  const auto model = o.models.empty() ? std::nullopt : std::optional(readModel(o.models));
  const bool needsPicture =
      !o.which || any(*o.which, &CameraMatrix::projection) || any(*o.which, &CameraMatrix::viewport);
  if (o.all) {
    std::optional<MatrixSet> whole;  // a text has the matrices of all
    const int status = o.camera.writeEach(needsPicture, [&](const std::string& pick, const CameraFile& camera) {
      MatrixSet set = matricesOf(o.world.mapped(camera), model, o);
      set.camera = pick;
      if (!isText) return writeMatrices(set, o.format, camera.name);
      if (!whole) {
        whole = set;
        whole->matrices.clear();
      }
      if (set.convention != whole->convention)
        throw InputError(camera.name +
                         ": has another convention than the cameras before it; --convention NAME is for all");
      for (NamedMatrix& each : set.matrices) {
        each.name = pick + " " + each.name;
        whole->matrices.push_back(std::move(each));
      }
      return std::string();
    });
    if (whole) writeOutput(writeMatrices(std::move(*whole), o.format, o.camera.file().value_or("-")));
    return status;
  }
  const auto [cameras, pick] = o.camera.readAll();
  const CameraFile read = o.world.mapped(o.camera.readOne(*cameras, cameras->choose(pick), needsPicture));
  writeOutput(writeMatrices(matricesOf(read, model, o), o.format, read.name));
  return 0;
}

int runMatrix(const MatrixOptions& o, const CLI::App& app) {
  try {
    return runCamera(o, app);
  } catch (const UnknownFormat& e) {
    if (e.text.empty()) throw;
    return runPasted(o, app, e);
  }
}

}  // namespace

Action declareMatrix(CLI::App& app) {
  const auto o = std::make_shared<MatrixOptions>();
  describe(
      app,
      "A camera's matrices in any convention, as JSON, text or code; or matrices as pasted, as info reads them, in "
      "another convention.",
      "Examples:\n"
      "  viewproj matrix --fov-y 60 --aspect 16/9 --near 0.1 --convention d3d --to hlsl\n"
      "  viewproj matrix --position 3,2,5 --target 0,0,0 --which view --to text");
  const auto readNames = [](const std::string& option, const std::string& text) {
    Matrices chosen;
    for (const std::string& name : splitNames(option, text)) chosen.push_back(choose(option, name, matrixNames()));
    // The window of OpenXR is both.
    const auto find = [&](std::string_view name) {
      return std::find_if(chosen.begin(), chosen.end(), [&](const CameraMatrix* row) { return row->name == name; });
    };
    if (const auto at = find("tangents"); at != chosen.end() && find("angles") == chosen.end())
      chosen.insert(at + 1, choose(option, "angles", matrixNames()));
    return chosen;
  };
  addValue(app, "--which", "NAMES", o->which, readNames,
           withNames("Matrices to write", known(matrixNames()), "all that the camera determines"));
  addFlag(app, "--inverse", o->inverse, "Write each one's inverse too");
  addFlag(app, "--bake-viewport", o->bakeViewport, "Fold the viewport into the projection");
  CLI::Option* const relative =
      addFlag(app, "--relative-to-eye", o->relativeToEye, "View without translation, and the eye beside it");
  CLI::Option* const model = addModel(app, o->models, "Where a model stands in the world");
  addFlag(app, "--float", o->asFloat, "Round to float32 (default: doubles)");
  const auto forms = matrixForms();
  refuse(addForm(app, o->format, std::span<const FormRow<std::string_view>>(forms), "Output format"), "camera",
         "viewproj convert --to camera writes a camera file");
  addFlag(app, "--all", o->all, "All cameras of the file: JSON lines, or one text");
  o->world.add(app);
  exclude(model, relative);
  exclude(model, findOption(app, "--map"));
  exclude(model, findOption(app, "--scale"));
  o->camera.showMatrices();
  o->camera.addFile(app);
  o->camera.add(app);
  o->camera.addWriting(app);
  return [o, &app] { return runMatrix(*o, app); };
}

}  // namespace viewproj::cmd
