// viewproj matrix: a camera's matrices, and the camera itself in another form.
#include <algorithm>

#include "commands/command.hpp"
#include "commands/options.hpp"
#include "output/camera_text.hpp"
#include "output/matrix_text.hpp"
#include "output/output_file.hpp"
#include "text/error.hpp"
#include "text/format_number.hpp"
#include "text/names.hpp"
#include "viewproj/matrices.hpp"

namespace viewproj::cmd {
namespace {

enum class Which { view, projection, viewProjection, viewport };

struct WhichRow {
  std::string_view name;
  Which which;
  bool pose, projection, viewport;  ///< what it needs of the camera
};

constexpr WhichRow kWhich[] = {
    {"view", Which::view, true, false, false},
    {"projection", Which::projection, false, true, false},
    {"viewProjection", Which::viewProjection, true, true, false},
    {"viewport", Which::viewport, false, false, true},
};

struct Wanted {
  bool inverse = false, bakeViewport = false, relativeToEye = false;
};

/// What the camera lacks for a matrix, or an empty string.
std::string lacking(const WhichRow& row, const CameraFile& file, bool bakeViewport) {
  const bool needsViewport = row.viewport || (bakeViewport && row.projection);
  if (row.pose && !file.pose) return "a pose";
  if (row.projection && !file.projection) return "a projection";
  if (needsViewport && !file.viewport) return "a viewport; --viewport WIDTHxHEIGHT gives one";
  return "";
}

Mat4 matrixOf(Which which, bool inverse, const CameraFile& file, const Wanted& wanted, const Convention& c) {
  const auto pose = [&] { return wanted.relativeToEye ? relativeToEye(*file.pose) : *file.pose; };
  switch (which) {
    case Which::view:
      return inverse ? worldFromView(pose(), c) : viewFromWorld(pose(), c);
    case Which::projection:
      if (wanted.bakeViewport)
        return inverse ? viewFromScreen(*file.projection, *file.viewport, c)
                       : screenFromView(*file.projection, *file.viewport, c);
      return inverse ? viewFromClip(*file.projection, c) : clipFromView(*file.projection, c);
    case Which::viewProjection:
      if (wanted.bakeViewport)
        return inverse ? worldFromScreen(pose(), *file.projection, *file.viewport, c)
                       : screenFromWorld(pose(), *file.projection, *file.viewport, c);
      return inverse ? worldFromClip(pose(), *file.projection, c) : clipFromWorld(pose(), *file.projection, c);
    case Which::viewport:
      break;
  }
  return inverse ? ndcFromScreen(*file.viewport, c) : screenFromNdc(*file.viewport, c);
}

std::vector<WhichRow> chooseMatrices(const std::optional<std::vector<WhichRow>>& asked, const CameraFile& file,
                                     bool bakeViewport) {
  if (!asked) {
    std::vector<WhichRow> chosen;
    // A baked viewport is in the projection already.
    for (const WhichRow& row : kWhich)
      if (lacking(row, file, bakeViewport).empty() && !(bakeViewport && row.which == Which::viewport))
        chosen.push_back(row);
    if (chosen.empty()) throw InputError(file.name + ": the camera has neither a pose, a projection nor a viewport");
    return chosen;
  }
  for (const WhichRow& row : *asked)
    if (const std::string part = lacking(row, file, bakeViewport); !part.empty())
      throw InputError(file.name + ": " + std::string(row.name) + " needs " + part);
  return *asked;
}

Names<WhichRow> whichNames() {
  Names<WhichRow> names;
  for (const WhichRow& row : kWhich) names.emplace_back(row.name, row);
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
  std::optional<std::vector<WhichRow>> which;
  std::optional<std::string> type;
  std::string format = "json";
  bool asFloat = false;
};

bool any(const std::vector<WhichRow>& rows, bool WhichRow::*needs) {
  return std::any_of(rows.begin(), rows.end(), [&](const WhichRow& row) { return row.*needs; });
}

/// Throws UsageError where what is typed has nothing to act on.
void requireUse(const Options& o) {
  if (o.wanted.bakeViewport && o.which && !any(*o.which, &WhichRow::projection))
    throw UsageError("--bake-viewport folds the viewport into the projection, and --which names no projection");
  if (o.wanted.relativeToEye && o.which && !any(*o.which, &WhichRow::pose))
    throw UsageError("--relative-to-eye is of the view, and --which names no view");
}

/// The same where the camera lacks it.
void requireUse(const Wanted& wanted, const CameraFile& file) {
  const auto lacks = [&](const std::string& option, const std::string& part) {
    return InputError(file.name + ": " + option + " needs " + part);
  };
  if (wanted.relativeToEye && !file.pose) throw lacks("--relative-to-eye", "a pose");
  if (wanted.bakeViewport && !file.projection) throw lacks("--bake-viewport", "a projection");
  if (wanted.bakeViewport && !file.viewport)
    throw lacks("--bake-viewport", "a viewport; --viewport WIDTHxHEIGHT gives one");
}

int run(const Options& o, const CLI::App& app) {
  if (o.camera.lists()) return o.camera.list();
  const bool toCamera = o.format == "camera";
  if (o.type && !toCamera) throw UsageError("--type goes with --to camera");
  for (const char* option : {"--which", "--inverse", "--bake-viewport", "--relative-to-eye", "--float"})
    if (toCamera && app.count(option) > 0)
      throw UsageError(std::string(option) + " goes with matrices, not with --to camera");
  requireUse(o);
  const CameraFile read = o.camera.read();
  if (toCamera) return runCamera(read, o.type, o.camera);
  requireUse(o.wanted, read);
  MatrixSet set;
  set.asFloat = o.asFloat;
  set.convention = o.camera.writing(read);
  const std::vector<WhichRow> chosen = chooseMatrices(o.which, read, o.wanted.bakeViewport);
  const bool sayConvention = !saysNumbersAlone(o.format), depth = any(chosen, &WhichRow::projection);
  o.camera.noteWriting(read,
                       {.axes = true,
                        .range = sayConvention || depth || any(chosen, &WhichRow::viewport),
                        .reversal = sayConvention || depth,
                        .world = any(chosen, &WhichRow::pose)},
                       "--which with a projection");
  for (const WhichRow& row : chosen) {
    set.matrices.push_back({std::string(row.name), matrixOf(row.which, false, read, o.wanted, set.convention)});
    if (o.wanted.inverse)
      set.matrices.push_back(
          {std::string(row.name) + "Inverse", matrixOf(row.which, true, read, o.wanted, set.convention)});
  }
  if (o.wanted.relativeToEye && read.pose) set.eye = read.pose->eye();
  if (set.eye && o.format == "flat")
    o.camera.notes().say("--to flat has no place for the eye: " + formatNumber(set.eye->x) + ", " +
                         formatNumber(set.eye->y) + ", " + formatNumber(set.eye->z));
  set.bakesViewport = o.wanted.bakeViewport;
  writeOutput(writeMatrices(set, o.format, read.name));
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
  addChoices(app, "--which", o->which, whichNames(), "Matrices to write", "all that the camera determines");
  app.add_flag("--inverse", o->wanted.inverse, "Give each one's inverse too");
  app.add_flag("--bake-viewport", o->wanted.bakeViewport, "Fold the viewport into the projection");
  app.add_flag("--relative-to-eye", o->wanted.relativeToEye, "Leave the translation out of the view and give the eye");
  app.add_flag("--float", o->asFloat, "Round to float32 (default: doubles)");
  std::vector<std::string_view> formats = matrixFormats();
  formats.push_back("camera");
  addChoice(app, "--to", "FORM", o->format, namesAlone(formats),
            "Form of the output; camera is the camera file itself");
  addChoice(app, "--type", "TYPE", o->type, namesAlone(cameraTypes()), "With --to camera the projection's form",
            "perspective or orthographic, or intrinsics where the camera's shape is not the viewport's");
  return [o, &app] { return run(*o, app); };
}

}  // namespace viewproj::cmd
