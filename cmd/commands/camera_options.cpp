#include "commands/camera_options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "camera/check.hpp"
#include "camera/fields.hpp"
#include "camera/read_pose.hpp"
#include "camera/write_camera.hpp"
#include "output/output_file.hpp"
#include "text/error.hpp"
#include "text/names.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {
namespace {

Names<ConventionPreset> presets() {
  Names<ConventionPreset> names;
  for (const ConventionPreset& preset : conventionPresets()) names.emplace_back(preset.name, preset);
  return names;
}

/// For a command that asks for near and far alone: an opening like any other where the options name none.
void assumeOpening(std::vector<Patch>& patches, bool hasViewport) {
  bool hasLens = false, isOrthographic = false;
  for (const Patch& patch : patches) {
    const Field* const field = findField(patch.path);
    if (!field || field->types == 0) continue;
    if (field->group == Group::lens) return;
    hasLens = true;
    isOrthographic = isOrthographic || *patch.value == "orthographic";
  }
  if (!hasLens) return;
  patches.push_back(optionPatch(*findField(isOrthographic ? "projection.height" : "projection.fovY"), "60"));
  if (!hasViewport) patches.push_back(optionPatch(*findField("projection.aspect"), "1"));
}

}  // namespace

Names<Convention> presetConventions() {
  Names<Convention> names;
  for (const ConventionPreset& preset : conventionPresets()) names.emplace_back(preset.name, preset.convention);
  return names;
}

void CameraOptions::add(CLI::App& app) {
  app.option_defaults()->group(kCameraGroup);
  addValue(app, "-c,--camera", "FILE[#NAME]", camera_, readFileName,
           "Camera file, or JSON; #NAME picks one of several");
  addValue(app, "--viewport", "WxH", viewport_, readSize, "Size of the picture in pixels, as in 1920x1080");
  addRepeatable(
      app, "--set", "FIELD=VALUE",
      [this](const std::string&, const std::string& text) { patches_.push_back(setPatch(text)); },
      "Set a field, as in projection.fovY=75");
  for (const Field& field : kFields)
    if (!field.option.empty())
      addOption(
          app, std::string(field.option), std::string(wordsOfKind(field.kind).placeholder),
          [this, &field](const std::string&, const std::string& text) { patches_.push_back(optionPatch(field, text)); },
          std::string(field.help));
  app.add_flag_callback(
      "--orthographic", [this] { patches_.push_back(orthographicPatch()); }, "The projection is orthographic");
  app.add_flag("--allow-stretch", allowStretch_, "Allow another aspect ratio than the viewport's");
  app.add_flag("--ignore-distortion", ignoreDistortion_, "Leave out the distortion of the lens");
  app.option_defaults()->group(kConventionGroup);
  addValue(
      app, "--read-as", "NAME", readAs_,
      [](const std::string& option, const std::string& text) {
        return choose(option, text, namesAlone(presetNames()));
      },
      "Read a file that states no convention as NAME");
  app.option_defaults()->group("Options");
}

void CameraOptions::addWriting(CLI::App& app) {
  app.option_defaults()->group(kConventionGroup);
  addValue(
      app, "--convention", "NAME", convention_,
      [](const std::string& option, const std::string& text) { return choose(option, text, presets()); },
      "Write in it; without a file also read options in it");
  CLI::Option* const reversed = app.add_flag_callback(
      "--reverse-z", [this] { reverseZ_ = true; }, "Write depth with near and far exchanged");
  app.add_flag_callback(
         "--no-reverse-z", [this] { reverseZ_ = false; }, "Write depth that grows with the distance")
      ->excludes(reversed);
  addChoice(app, "--ndc-z", "RANGE", ndcZ_, rowsOf(kNdcZNames), "Range of NDC z that is written", "");
  app.option_defaults()->group("Options");
}

void CameraOptions::addFile(CLI::App& app) {
  takesFile_ = true;
  addValue(app, "FILE", "", file_, readFileName, "Camera file, where -c was not given; absent or - for standard input")
      ->group(kCameraGroup);
}

CameraSource CameraOptions::source() const {
  if (camera_ && file_) throw UsageError("-c gives the camera already; leave out one of it and " + *file_);
  if (!camera_ && !takesFile_)
    throw UsageError("-c FILE is needed: the camera; or options that say it, such as --position, --target and --fov-y");
  return splitPick(camera_ ? *camera_ : file_.value_or("-"));
}

bool CameraOptions::isTyped() const {
  return !camera_ && !file_ &&
         std::any_of(patches_.begin(), patches_.end(), [](const Patch& patch) { return patch.isOption; });
}

bool CameraOptions::hasPlace() const {
  return std::any_of(patches_.begin(), patches_.end(), [](const Patch& patch) {
    return (patch.path == "position" || patch.path == "target") && patch.value->is_object() &&
           patch.value->contains("lat");
  });
}

CameraPatches CameraOptions::patches() const {
  CameraPatches all{readAs(), patches_};
  if (viewport_)
    for (const Patch& patch : viewportPatches(viewport_->width, viewport_->height)) all.patches.push_back(patch);
  requireConsistent(all.patches);
  if (readAs_)
    for (const Patch& patch : patches_)
      if (patch.path == "convention" || patch.path == "convention.preset")
        throw UsageError(patch.label + " and --read-as both say how the file is read; keep one");
  if (anyOpening_ && isTyped()) assumeOpening(all.patches, viewport_.has_value());
  return all;
}

std::unique_ptr<CameraDocuments> CameraOptions::open(const CameraSource& picked) const {
  CameraPatches all = patches();  // whatever is wrong with the options is told before any file is opened
  if (isTyped()) return std::make_unique<CameraDocuments>(std::move(all));
  return std::make_unique<CameraDocuments>(load(picked.file, camera_ ? "--camera" : "FILE"), std::move(all));
}

std::string CameraOptions::readAs() const {
  if (readAs_ || !isTyped() || !convention_) return readAs_.value_or("");
  // A place makes the world right-handed.
  if (hasPlace() && convention_->convention.world == Handedness::left) return "";
  return std::string(convention_->name);
}

ReadOptions CameraOptions::reading(bool needsPicture) const {
  return {allowStretch_, ignoreDistortion_, needsPicture && !anyOpening_};
}

CameraFile CameraOptions::read(bool needsPicture) const {
  const CameraSource picked = isTyped() ? CameraSource{} : source();
  const auto cameras = open(picked);
  const Document document = cameras->document(cameras->choose(picked.pick));
  CameraFile file = readCamera(document, reading(needsPicture));
  statesConvention_ = readAs_ || isTyped() || file.statesConvention || file.worldIsEcef;
  for (const std::string& note : file.notes) cmd::note(note);
  return file;
}

int CameraOptions::writeEach(
    bool needsPicture,
    const std::function<std::string(const std::string& pick, const CameraFile& camera)>& textOf) const {
  if (isTyped()) throw UsageError("--all is of the cameras of a file, and there is none");
  const CameraSource picked = source();
  if (picked.pick) throw UsageError("--all is of every camera of the file; leave out #" + *picked.pick);
  const auto cameras = open(picked);
  int status = 0;
  for (std::size_t i = 0; i < cameras->size(); ++i) {
    std::string text;
    try {
      const CameraFile camera = readCamera(cameras->document(i), reading(needsPicture));
      for (const std::string& note : camera.notes) cmd::note(note);
      statesConvention_ = readAs_ || camera.statesConvention;
      text = textOf(cameras->pickOf(i), camera);
    } catch (const InputError& e) {
      complain(e.what());
      status = 1;
      continue;
    }
    writeOutput(text);
  }
  return status;
}

std::string CameraOptions::written(const CameraFile& file) const {
  return writeCamera(file, convention_ ? *convention_ : *readConvention(file.document).preset, writing(file));
}

std::pair<std::unique_ptr<CameraDocuments>, std::optional<std::string>> CameraOptions::readAll() const {
  const CameraSource picked = isTyped() ? CameraSource{} : source();
  return {open(picked), picked.pick};
}

CameraFile CameraOptions::readOne(const CameraDocuments& cameras, std::size_t which) const {
  CameraFile file = readCamera(cameras.document(which), reading(true));
  for (const std::string& note : file.notes) cmd::note(note);
  return file;
}

bool CameraOptions::fromStandardInput() const {
  if (isTyped() || (!camera_ && !takesFile_)) return false;
  return splitPick(camera_ ? *camera_ : file_.value_or("-")).file == "-";
}

Convention CameraOptions::writing(const CameraFile& file) const {
  Convention c = file.convention;
  if (convention_) {
    c = convention_->convention;
    c.world = file.convention.world;
  }
  if (reverseZ_) c.reverseZ = *reverseZ_;
  if (ndcZ_) c.ndcZ = *ndcZ_;
  return c;
}

CameraAxes CameraOptions::writtenAxes(const CameraFile& file) const {
  const bool fits = convention_ && convention_->convention.world == file.convention.world;
  return fits ? convention_->cameraAxes : file.cameraAxes;
}

void CameraOptions::noteHandedness(const CameraFile& file) const {
  if (!convention_) return;
  const std::string name(convention_->name);
  const auto hand = [](Handedness world) { return std::string(nameOf(kWorldNames, world)) + "-handed"; };
  const ConventionPreset& usual = conventionPresets().front();
  if (isTyped()) {
    if (readAs_ || readAs().empty()) return;
    const Vec3 up = convention_->up;
    if (convention_->convention.world == usual.convention.world && up == usual.up) return;
    note("--convention " + name + " also says how the options are read: the world is " +
         hand(convention_->convention.world) + " and up is " + formatNumber(up.x) + "," + formatNumber(up.y) + "," +
         formatNumber(up.z) + "; --read-as opengl reads them in the default convention");
    return;
  }
  if (statesConvention_ || convention_->convention.world == file.convention.world) return;
  note(file.name + ": states no convention, so its world stays " + hand(file.convention.world) + "; " + name +
       "'s is " + hand(convention_->convention.world) + "; --read-as " + name + " reads the file so");
}

}  // namespace viewproj::cmd
