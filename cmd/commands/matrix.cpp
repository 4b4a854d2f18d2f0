// viewproj matrix: a camera's matrices, and the camera itself in another form.
#include <algorithm>

#include "commands/command.hpp"
#include "commands/options.hpp"
#include "commands/output_option.hpp"
#include "input/model.hpp"
#include "output/camera_matrices.hpp"
#include "output/camera_text.hpp"
#include "output/matrix_text.hpp"
#include "output/output_file.hpp"
#include "text/error.hpp"
#include "text/format_number.hpp"
#include "text/names.hpp"

namespace viewproj::cmd {
namespace {

struct Wanted {
  bool inverse = false, bakeViewport = false, relativeToEye = false;
};

/// What the camera lacks for a matrix, or an empty string.
std::string lacking(const CameraMatrix& row, const MatrixSource& source) {
  const CameraFile& file = source.file;
  const bool needsViewport = row.viewport || (source.bakeViewport && row.projection);
  if (row.model && !source.worldFromLocal) return "--model";
  if (row.pose && !file.pose) return "a pose";
  if (row.projection && !file.projection) return "a projection";
  if (needsViewport && !file.viewport) return "a viewport; --viewport WIDTHxHEIGHT gives one";
  return "";
}

using Matrices = std::vector<const CameraMatrix*>;

Matrices chooseMatrices(const std::optional<Matrices>& asked, const MatrixSource& source) {
  const std::string& name = source.file.name;
  if (!asked) {
    Matrices chosen;
    // A baked viewport is in the projection already.
    for (const CameraMatrix& row : cameraMatrices())
      if (lacking(row, source).empty() && !(source.bakeViewport && row.viewport)) chosen.push_back(&row);
    if (chosen.empty()) throw InputError(name + ": the camera has neither a pose, a projection nor a viewport");
    return chosen;
  }
  for (const CameraMatrix* row : *asked)
    if (const std::string part = lacking(*row, source); !part.empty())
      throw InputError(name + ": " + std::string(row->name) + " needs " + part);
  return *asked;
}

Names<const CameraMatrix*> matrixNames() {
  Names<const CameraMatrix*> names;
  for (const CameraMatrix& row : cameraMatrices()) names.emplace_back(row.name, &row);
  return names;
}

/// --to camera: the file, and a note where its doubles do not suffice.
int runCamera(CameraFile file, const std::optional<std::string>& type, const CameraOptions& camera) {
  camera.noteWriting(file, {}, "");
  if (const auto typed = type || camera.allowsStretch() ? std::nullopt : camera.asTyped(file)) {
    writeOutput(*typed);
    return 0;
  }
  file.convention = camera.writing(file);
  const WrittenCamera written = writeCamera(file, type.value_or(""), camera.allowsStretch());
  writeOutput(written.text);
  const auto& [pixels, depth] = written.moved;
  if (!(pixels <= kKeptPixels))
    camera.notes().say(file.name + ": in doubles, as written, points move by up to " + formatDigits(pixels, 1) +
                       " pixels");
  if (!(depth <= kKeptDepth))
    camera.notes().say(file.name + ": in doubles, as written, depths move by up to " + formatDigits(depth, 1) +
                       " of their range");
  return 0;
}

struct Options {
  CameraOptions camera;
  Wanted wanted;
  std::optional<Matrices> which;
  std::optional<std::string> type, model;
  std::string format = "json";
  std::optional<std::size_t> digits;
  bool asFloat = false, all = false;
};

bool any(const Matrices& rows, bool CameraMatrix::*needs) {
  return std::any_of(rows.begin(), rows.end(), [&](const CameraMatrix* row) { return row->*needs; });
}

/// Throws UsageError where what is typed has nothing to act on.
void requireUse(const Options& o) {
  if (o.wanted.bakeViewport && o.which && !any(*o.which, &CameraMatrix::projection))
    throw UsageError("--bake-viewport folds the viewport into the projection, and --which names no projection");
  if (o.wanted.relativeToEye && o.which && !any(*o.which, &CameraMatrix::pose))
    throw UsageError("--relative-to-eye is of the view, and --which names no view");
  if (o.wanted.relativeToEye && o.model)
    throw UsageError("--relative-to-eye is for points of the world; modelView has no large numbers to be rid of");
  if (!o.model && o.which && any(*o.which, &CameraMatrix::model))
    throw UsageError("modelView and modelViewProjection need --model, which says where the model stands");
  if (o.model && o.which && !any(*o.which, &CameraMatrix::model))
    throw UsageError("--model is of modelView and modelViewProjection, and --which names neither");
}

/// The same where the camera lacks it.
void requireUse(const Options& o, const CameraFile& file) {
  const Wanted& wanted = o.wanted;
  const auto lacks = [&](const std::string& option, const std::string& part) {
    return InputError(file.name + ": " + option + " needs " + part);
  };
  if (wanted.relativeToEye && !file.pose) throw lacks("--relative-to-eye", "a pose");
  if (o.model && !file.pose) throw lacks("--model", "a pose");
  if (wanted.bakeViewport && !file.projection) throw lacks("--bake-viewport", "a projection");
  if (wanted.bakeViewport && !file.viewport)
    throw lacks("--bake-viewport", "a viewport; --viewport WIDTHxHEIGHT gives one");
}

MatrixSet matricesOf(const CameraFile& read, const std::optional<Mat4>& model, const Options& o) {
  requireUse(o, read);
  MatrixSet set;
  set.asFloat = o.asFloat;
  set.digits = static_cast<int>(o.digits.value_or(0));
  set.convention = o.camera.writing(read);
  const MatrixSource source{.file = read,
                            .convention = set.convention,
                            .worldFromLocal = model,
                            .bakeViewport = o.wanted.bakeViewport,
                            .relativeToEye = o.wanted.relativeToEye};
  const Matrices chosen = chooseMatrices(o.which, source);
  const bool sayConvention = !saysNumbersAlone(o.format), depth = any(chosen, &CameraMatrix::projection);
  o.camera.noteWriting(read,
                       {.axes = true,
                        .range = sayConvention || depth || any(chosen, &CameraMatrix::viewport),
                        .reversal = sayConvention || depth,
                        .world = any(chosen, &CameraMatrix::pose)},
                       "--which with a projection");
  const auto add = [&](const CameraMatrix& row, bool inverse) {
    try {
      set.matrices.push_back({std::string(row.name) + std::string(inverse ? kInverse : ""), row.make(source, inverse)});
    } catch (const CameraError& e) {
      throw InputError("--model " + *o.model + ": " + e.message());
    }
  };
  for (const CameraMatrix* row : chosen) {
    add(*row, false);
    if (o.wanted.inverse) add(*row, true);
  }
  if (o.wanted.relativeToEye && read.pose) set.eye = read.pose->eye();
  if (set.eye && o.format == "flat")
    o.camera.notes().say("--to flat has no place for the eye: " + formatNumber(set.eye->x) + ", " +
                         formatNumber(set.eye->y) + ", " + formatNumber(set.eye->z));
  set.bakesViewport = o.wanted.bakeViewport;
  return set;
}

int run(const Options& o, const CLI::App& app) {
  if (o.camera.lists()) return o.camera.list();
  const bool toCamera = o.format == "camera";
  if (o.type && !toCamera) throw UsageError("--type goes with --to camera");
  for (const char* option :
       {"--which", "--inverse", "--bake-viewport", "--relative-to-eye", "--float", "--digits", "--model"})
    if (toCamera && app.count(option) > 0)
      throw UsageError(std::string(option) + " goes with matrices, not with --to camera");
  if (const CLI::Option* const output = app.get_option("--output"); output->count() > 0 && app.count("--to") == 0) {
    const bool isLines = isEnding(endingOf(output->as<std::string>()), ".ndjson .jsonl");
    if (o.all && isEnding(endingOf(output->as<std::string>()), ".json"))
      throw UsageError("--all writes JSON, a line a camera, which is no .json; call the file .ndjson");
    if (!o.all && isLines)
      throw UsageError("-o: one camera's matrices are one JSON document, a .json; --all writes lines");
  }
  if (o.all && o.format != "json") throw UsageError("--all writes JSON, a line a camera; leave out --to " + o.format);
  requireUse(o);
  requireOneStandardInput({{"the camera", o.camera.fromStandardInput()}, {"the model", isStandardInput(o.model)}});
  const auto model = o.model ? std::optional(readModel(*o.model)) : std::nullopt;
  if (o.all) {
    for (const auto& [pick, camera] : o.camera.readAll()) {
      MatrixSet set = matricesOf(camera, model, o);
      set.camera = pick;
      writeOutput(writeMatrices(set, o.format, camera.name));
    }
    return 0;
  }
  const CameraFile read = o.camera.read();
  if (toCamera) return runCamera(read, o.type, o.camera);
  writeOutput(writeMatrices(matricesOf(read, model, o), o.format, read.name));
  return 0;
}

}  // namespace

Action defineMatrix(CLI::App& app) {
  const auto o = std::make_shared<Options>();
  app.description(
      "A camera's matrices, in any convention, as JSON, text or source code; or the camera itself in another form.");
  app.footer("viewproj matrix samples/picking-a-pixel/camera.json --convention d3d --which projection --to text");
  o->camera.add(app);
  o->camera.addWriting(app);
  o->camera.addFile(app);
  addChoices(app, "--which", o->which, matrixNames(), "Matrices to write", "all that the camera determines");
  app.add_flag("--all", o->all, "Of every camera of the file, a line of JSON each");
  app.add_flag("--inverse", o->wanted.inverse, "Give each one's inverse too");
  app.add_flag("--bake-viewport", o->wanted.bakeViewport, "Fold the viewport into the projection");
  app.add_flag("--relative-to-eye", o->wanted.relativeToEye, "Leave the translation out of the view and give the eye");
  addModelOption(app, o->model, "points", "modelView and modelViewProjection are written too");
  addDigits(app, o->digits, "all that tell the number from others");
  app.add_flag("--float", o->asFloat, "Round to float32 (default: doubles)");
  std::vector<FormRow<std::string>> forms = matrixForms();
  forms.push_back({"camera", "camera"});
  addForm(app, o->format, std::span<const FormRow<std::string>>(forms),
          "Form of the output; camera is the camera file itself");
  addChoice(app, "--type", "TYPE", o->type, namesAlone(cameraTypes()), "With --to camera the projection's form",
            "perspective or orthographic, or intrinsics where the camera's shape is not the viewport's");
  return [o, &app] { return run(*o, app); };
}

}  // namespace viewproj::cmd
