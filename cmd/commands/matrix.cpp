// viewproj matrix: a camera's matrices, and the camera itself in another form.
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

std::vector<WhichRow> chooseMatrices(const std::string& list, const CameraFile& file, bool bakeViewport) {
  std::vector<WhichRow> chosen;
  if (list.empty()) {
    // A baked viewport is in the projection already.
    for (const WhichRow& row : kWhich)
      if (lacking(row, file, bakeViewport).empty() && !(bakeViewport && row.which == Which::viewport))
        chosen.push_back(row);
    if (chosen.empty()) throw InputError(file.name + ": the camera has neither a pose, a projection nor a viewport");
    return chosen;
  }
  for (const std::string& name : splitNames("--which", list)) {
    std::vector<std::string_view> known;
    const std::size_t before = chosen.size();
    for (const WhichRow& row : kWhich) {
      known.push_back(row.name);
      if (row.name == name) chosen.push_back(row);
    }
    if (chosen.size() == before) failUnknown("--which", name, known);
    if (const std::string part = lacking(chosen.back(), file, bakeViewport); !part.empty())
      throw InputError(file.name + ": " + name + " needs " + part);
  }
  return chosen;
}

/// --to camera: the file, and on standard error a word where its doubles do not suffice.
int runCamera(CameraFile file, const std::string& type, const CameraOptions& camera) {
  file.convention = camera.writing(file);
  const WrittenCamera written = writeCamera(file, type, camera.allowsStretch());
  writeOutput(written.text);
  const auto& [pixels, depth] = written.moved;
  if (!(pixels <= kKeptPixels))
    complain(file.name + ": in doubles, as written, points move by up to " + formatDigits(pixels, 1) + " pixels");
  if (!(depth <= kKeptDepth))
    complain(file.name + ": in doubles, as written, depths move by up to " + formatDigits(depth, 1) +
             " of their range");
  return 0;
}

struct Options {
  CameraOptions camera;
  Wanted wanted;
  std::string which, type, format = "json";
  bool asFloat = false;
};

int run(const Options& o, const CLI::App& app) {
  std::vector<std::string_view> formats = matrixFormats();
  formats.push_back("camera");
  requireKnown("--to", o.format, formats);
  if (!o.type.empty()) requireKnown("--type", o.type, cameraTypes());
  const bool toCamera = o.format == "camera";
  if (!o.type.empty() && !toCamera) throw UsageError("--type goes with --to camera");
  for (const char* option : {"--which", "--inverse", "--bake-viewport", "--relative-to-eye", "--float"})
    if (toCamera && app.count(option) > 0)
      throw UsageError(std::string(option) + " goes with matrices, not with --to camera");
  const CameraFile read = o.camera.read();
  if (toCamera) return runCamera(read, o.type, o.camera);
  MatrixSet set;
  set.asFloat = o.asFloat;
  set.convention = o.camera.writing(read);
  for (const WhichRow& row : chooseMatrices(o.which, read, o.wanted.bakeViewport)) {
    set.matrices.push_back({std::string(row.name), matrixOf(row.which, false, read, o.wanted, set.convention)});
    if (o.wanted.inverse)
      set.matrices.push_back(
          {std::string(row.name) + "Inverse", matrixOf(row.which, true, read, o.wanted, set.convention)});
  }
  if (o.wanted.relativeToEye && read.pose) set.eye = read.pose->eye;
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
  app.add_option("--which", o->which,
                 "Matrices to write: view,projection,viewProjection,viewport (default: all that the camera determines)")
      ->type_name("NAMES");
  app.add_flag("--inverse", o->wanted.inverse, "Give each one's inverse too");
  app.add_flag("--bake-viewport", o->wanted.bakeViewport, "Fold the viewport into the projection");
  app.add_flag("--relative-to-eye", o->wanted.relativeToEye, "Leave the translation out of the view and give the eye");
  app.add_flag("--float", o->asFloat, "Round to float32 (default: doubles)");
  app.add_option("--to", o->format,
                 "Form of the output: " + joined(matrixFormats()) + ", camera: the camera file itself (default: json)")
      ->type_name("FORM");
  app.add_option("--type", o->type,
                 "With --to camera the projection's form: " + joined(cameraTypes()) + " (default: as it was read)")
      ->type_name("TYPE");
  return [o, &app] { return run(*o, app); };
}

}  // namespace viewproj::cmd
