// viewproj convert: cameras as files of other programs, or as ours.
#include <CLI/App.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <unordered_set>

#include "camera/plain_camera.hpp"
#include "camera/read_pose.hpp"
#include "commands/camera_options.hpp"
#include "commands/command.hpp"
#include "commands/world_options.hpp"
#include "formats/observations.hpp"
#include "formats/pose_chain.hpp"
#include "formats/writer.hpp"
#include "output/output_file.hpp"
#include "text/error.hpp"
#include "text/form.hpp"
#include "text/json_text.hpp"
#include "text/names.hpp"
#include "text/system.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

constexpr std::string_view kCamera = "camera", kObservations = "observations";

struct ConvertOptions {
  CameraOptions camera;
  WorldOptions world;
  std::optional<std::string_view> form;
  const NameRow<EulerOrder>* angles = nullptr;
};

/// A camera that is to be written, in the world of --map and --scale.
struct Chosen {
  CameraFile file;
  std::string name;
  bool isPlaced;     ///< false: its file does not tell where it stands
  std::string path;  ///< of its file; empty: it is of another camera, and the others' poses do not place it
  std::string otherPictures;
};

/// The camera with its pose as angles of --angles, where there is a pose.
CameraFile turned(const ConvertOptions& o, CameraFile file) {
  if (!o.angles || !file.pose) return file;
  Document document = withoutScreen(file);
  const OrderedJson angles = anglesOf(*o.angles, readValues(document), *file.preset, file.pose);
  const CameraAxes own = cameraAxesOf(readValues(document), *file.preset);
  orient(*document.root, "euler", Json(angles));
  if (const CameraAxes axes = axesOfOrder(o.angles->second, file.pose->world(), own); o.angles->second.cameraAxes)
    document.root->erase("cameraAxes");  // the order's own count
  else if (axes != own)
    (*document.root)["cameraAxes"] = nameOf(kCameraAxesNames, axes);
  (*document.root)["position"] = {file.pose->eye().x, file.pose->eye().y, file.pose->eye().z};
  if (file.worldIsEcef) (*document.root)["world"] = nameOf(kWorlds, World::ecef);
  return readCamera(document, file.reading);
}

std::vector<Chosen> chosenOf(const ConvertOptions& o, bool needsPicture) {
  const auto [cameras, pick] = o.camera.readAll();
  std::vector<Chosen> all;
  std::unordered_set<std::string> placed;  // paths
  for (const std::size_t i : cameras->chooseAll(pick)) {
    CameraFile file = o.camera.readOne(*cameras, i, needsPicture);
    const bool isPlaced = !cameras->mayLackPose(i) || hasPose(*file.document.root);
    const std::string path = cameras->isOfAnother(i) ? "" : cameras->fileOf(i);
    if (isPlaced) placed.insert(path);
    all.push_back(
        {turned(o, o.world.mapped(file)), cameras->nameOf(i, file.document), isPlaced, path, cameras->othersOf(i)});
  }
  // One that has no pose is where the others of its file are counted from.
  for (Chosen& camera : all)
    camera.isPlaced = camera.isPlaced || (!camera.path.empty() && placed.contains(camera.path));
  return all;
}

/// One camera's document; or a set, an entry on a line each.
std::string camerasText(const ConvertOptions& o, std::vector<Chosen> cameras) {
  if (cameras.front().file.isTyped)
    o.camera.noteHandedness(cameras.front().file);
  else if (const ConventionPreset* const to = o.camera.convention())
    o.world.noteWorld(cameras.front().file, *to, to->name);
  std::vector<std::string> entries;
  for (Chosen& camera : cameras) {
    if (!camera.name.empty()) {
      camera.file.document = copied(camera.file.document);
      (*camera.file.document.root)["name"] = camera.name;
    }
    if (cameras.size() == 1) return o.camera.written(camera.file);
    entries.push_back(o.camera.written(camera.file, ", "));
  }
  return "{\"cameras\": " + jsonList(entries, ",\n  ") + "}\n";
}

void requireFolder(std::string_view form, const std::string& output) {
  if (output == "-" || pathOf(output).has_extension())
    throw UsageError(std::string(form) + " is several files; give a folder: -o " + (output == "-" ? "FOLDER" : output) +
                     "/");
}

std::vector<WrittenFile> filesOf(const ConvertOptions& o, const std::string& output) {
  const auto row = std::find_if(writers().begin(), writers().end(), [&](const Writer& w) { return w.name == *o.form; });
  if (row != writers().end() && row->endings == "/") requireFolder(row->name, output);
  const bool needsPicture = row == writers().end() || (row->places & kPosesAlone) == 0;
  std::vector<Chosen> chosen = chosenOf(o, needsPicture);
  if (o.form == kCamera) return {{"", camerasText(o, std::move(chosen))}};
  const Writer& writer = *row;
  std::vector<WrittenCamera> cameras;
  for (const Chosen& camera : chosen)
    if (!camera.isPlaced && chosen.size() > 1 && (writer.places & kPosePlace) != 0)
      camera.file.fail(camera.file.name + ": has no pose, and of several cameras " + std::string(writer.name) +
                       " states each; --world-from-camera 0,0,0 puts them at the origin, FILE#NAME picks one");
  const Chosen& first = chosen.front();
  if (chosen.size() == 1 && (writer.places & kStereoPosePlace) != 0 && !first.otherPictures.empty())
    note(first.file.name + ": R and P are of this picture alone; " + first.otherPictures +
         " of the same camera is not written");
  if ((writer.places & kYIsUp) != 0) o.world.noteWorld(chosen.front().file, conventions::opengl, writer.name);
  for (Chosen& camera : chosen) cameras.emplace_back(std::move(camera.file), std::move(camera.name), cameras.size());
  if (const std::string left = requirePlaces(cameras, writer); !left.empty()) note(left);
  const bool mayBeLeftOut = writer.leftOut && o.camera.file();
  if (const std::string left = mayBeLeftOut ? writer.leftOut(splitPick(*o.camera.file()).file) : ""; !left.empty())
    note(left);
  return writer.write(cameras, endingOf(output));
}

/// {"camera", "point", "position", "pixel"} a line, of the cameras that are picked.
void writeObservations(const ConvertOptions& o, const CLI::App& app) {
  for (const char* option : {"--map", "--scale", "--parts", "--world-from-camera", "--camera-from-world"})
    if (isGiven(app, option))
      throw UsageError(std::string(option) + " goes with cameras; observations are written as the file has them");
  if (o.camera.changesCamera() || !o.camera.file())
    throw UsageError("observations are written as a file has them; leave out the options of a camera");
  if (!app.remaining().empty() || app.count("--camera") > 1) throw UsageError("observations are of one file");
  const auto [cameras, pick] = o.camera.readAll();
  std::vector<std::string> names(cameras->size());  // of those that are picked
  for (const std::size_t i : cameras->chooseAll(pick)) names[i] = jsonOf(cameras->pickOf(i));
  constexpr std::size_t kBlock = 1 << 16;
  std::string lines;
  const std::string told = eachObservation(splitPick(*o.camera.file()).file, [&](const Observation& seen) {
    const std::string& name = names.at(seen.camera);
    if (name.empty()) return;
    JsonObject out;
    const auto& [x, y, z] = seen.position;
    out.addText("camera", name).addText("point", std::to_string(seen.point));
    out.addText("position", jsonListOf(std::array{x, y, z}));
    lines += out.addText("pixel", jsonListOf(std::array{seen.pixel.x, seen.pixel.y})).text() + "\n";
    if (lines.size() > kBlock) writeOutput(std::exchange(lines, ""));
  });
  writeOutput(lines);
  if (!told.empty()) note(told);
}

int runConvert(const ConvertOptions& o, const CLI::App& app) {
  if (!o.form) {
    std::vector<std::string_view> names{kCamera};
    for (const Writer& writer : writers()) names.push_back(writer.name);
    names.push_back(kObservations);
    throw UsageError("--to is needed: " + joined(names));
  }
  for (const char* option : {"--convention", "--reverse-z", "--no-reverse-z", "--ndc-z"})
    if (o.form != kCamera && isGiven(app, option))
      throw UsageError(
          std::string(option) + " goes with --to camera; " + std::string(*o.form) +
          " has a convention of its own; --read-as NAME says in which convention the file or the options are");
  const bool isTable = o.form == "csv" && o.angles && (o.angles->first == "opk" || o.angles->first == "rpy");
  if (o.angles && o.form != kCamera && !isTable)
    throw UsageError("--angles goes with --to camera, and opk and rpy with --to csv");
  const std::string name = outputFile(app);
  if (o.form == kObservations) {
    if (!name.empty() && formOfName(name).value_or(Form::json) != Form::json)
      throw UsageError("observations are a JSON object a line, which " + name + " does not say; call the file .ndjson");
    NamedOutput output(name);
    writeObservations(o, app);
    output.keep();
    return 0;
  }
  const std::vector<WrittenFile> files = filesOf(o, name);
  if (!files.front().note.empty()) note(files.front().note);
  if (!files.front().name.empty()) {
    requireFolder(*o.form, name);
    std::vector<std::pair<std::string, std::string>> texts;
    for (const WrittenFile& file : files) texts.emplace_back(file.name, file.text);
    writeFolder(name, texts);
    return 0;
  }
  NamedOutput output(name);
  writeOutput(files.front().text);
  output.keep();
  return 0;
}

}  // namespace

Action declareConvert(CLI::App& app) {
  const auto o = std::make_shared<ConvertOptions>();
  describe(
      app,
      "Cameras as a file of another program, or as ours (--to camera). Takes all cameras of the files, or those that "
      "#NAME picks, with options laid over them. What the file cannot say is an error where it moves a pixel, else "
      "left out with a note.",
      "Examples:\n"
      "  viewproj convert --position 3,2,5 --target 0,0,0 --fov-y 60 \\\n"
      "    --viewport 640x480 --to opencv\n"
      "  viewproj convert --fov-y 60 --aspect 2 --near 0.1 --to camera\n"
      "  viewproj convert --position 3,2,5 --target 0,0,0 --fov-y 60 \\\n"
      "    --viewport 640x480 --map x,-y,-z --to transforms");
  std::vector<FormRow<std::string_view>> forms{{kCamera, kCamera}};
  for (const Writer& writer : writers()) forms.push_back({writer.name, writer.name, writer.endings});
  forms.push_back({kObservations, kObservations});
  addForm(app, o->form, std::span<const FormRow<std::string_view>>(forms), "What to write");
  addAngles(app, o->angles, "Write the pose as turns");
  o->world.add(app);
  o->camera.addFiles(app);
  o->camera.add(app);
  o->camera.addWriting(app);
  return [o, &app] { return runConvert(*o, app); };
}

}  // namespace viewproj::cmd
