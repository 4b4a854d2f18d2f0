#include "commands/camera_options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "camera/fields.hpp"
#include "camera/write_camera.hpp"
#include "commands/pasted/camera_of_matrices.hpp"
#include "formats/open.hpp"
#include "formats/words.hpp"
#include "output/output_file.hpp"
#include "text/error.hpp"
#include "text/file.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {
namespace {

/// For a command that needs near and far alone: the usual field of view where the options name no lens.
void assumeLens(std::vector<Patch>& patches, bool hasViewport) {
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

/// For a command that moves the camera: the origin, where the options turn it and do not place it.
void assumePosition(std::vector<Patch>& patches) {
  const auto isGiven = [&](const auto&... paths) {
    return std::any_of(patches.begin(), patches.end(), [&](const Patch& p) { return ((p.path == paths) || ...); });
  };
  if (isGiven("direction", "rotation", "euler") && !isGiven("position"))
    patches.push_back(optionPatch(*findField("position"), "0,0,0"));
}

}  // namespace

Names<ConventionPreset> presetChoices() {
  Names<ConventionPreset> names;
  for (const ConventionPreset& preset : conventionPresets()) names.emplace_back(preset.name, preset);
  return names;
}

void CameraOptions::add(CLI::App& app) {
  app_ = &app;
  const OptionGroup camera(app, kCameraGroup);
  addValues(app, "-c,--camera", "FILE[#NAME]", cameras_, readFileName, "Camera file or JSON; #NAME picks one");
  const auto anyText = [](const std::string&, const std::string& text) { return text; };
  addValue(app, "--parts", "NAME=PATH,...", parts_, anyText, "Any file by its parts: 'K=mtx, ...' (help parts)");
  addValues(app, "--world-from-camera", "POSE", worldFromCamera_, readFileName,
            "'x,y,z rpy:0,0,9' (degrees), quat, rvec or FILE[#N]; a chain: base-arm, arm-hand, hand-camera");
  addValues(app, "--camera-from-world", "POSE", cameraFromWorld_, readFileName,
            "Inverse: 'x,y,z rvec:0,0,1', solvePnP's");
  const auto readViewport = [this](const std::string& option, const std::string& text) {
    const double percent = parseNumber(text.substr(0, text.find('%'))).value_or(0);
    if (text.ends_with('%') && percent > 0)
      resize_ = percent / 100;
    else
      viewport_ = readSize(option, text);
  };
  addOption(app, "--viewport", "WxH|P%", readViewport, "Size; other programs' files are resized, by 50% any");
  addOption(app, "--geoid", "N|FILE", setGeoid, "Sea level above the ellipsoid: metres, or a .pgm");
  const auto lay = [this](const std::string&, const std::string& text) { patches_.push_back(setPatch(text)); };
  addOption(app, "--set", "FIELD=VALUE", lay, "Set a field, as in projection.fovY=75", true);
  for (const Field& field : kFields) {
    if (field.option.empty()) continue;
    const auto layField = [this, &field](const std::string&, const std::string& text) {
      patches_.push_back(optionPatch(field, text));
    };
    addOption(app, std::string(field.option), std::string(rowOf(field.kind).placeholder), layField,
              std::string(field.help));
  }
  app.add_flag_callback(
      "--orthographic", [this] { patches_.push_back(orthographicPatch()); }, "Orthographic projection");
  addFlag(app, "--allow-stretch", allowStretch_, "Allow another aspect ratio than the viewport's");
  addFlag(app, "--ignore-distortion", ignoreDistortion_, "Ignore the distortion of the lens");
  const OptionGroup convention(app, kConventionGroup);
  const auto chooseName = [](const std::string& option, const std::string& text) {
    return std::string(choose(option, text, presetChoices()).name);
  };
  addChoice(app, "--convention", "NAME", convention_, presetChoices(), "")
      ->description("Write in NAME; of a camera by options alone, also read them in it");
  addValue(app, "--read-as", "NAME", readAs_, chooseName, "Read a file that states no convention as NAME");
}

void CameraOptions::addFile(CLI::App& app) {
  addValue(app, "FILE", "", operand_, readFileName,
           "Camera file; absent or - for standard input, unless options give the camera")
      ->group(kCameraGroup);
}

void CameraOptions::addFiles(CLI::App& app) {
  addValue(app, "FILE", "", operand_, readFileName,
           "Camera files; absent or - for standard input, unless options give the camera")
      ->expected(1, CLI::detail::expected_max_vector_size)
      ->group(kCameraGroup);
  app.allow_extras();  // CLI11 would split "[a,b]" of an option that takes several
}

void CameraOptions::addReversed(CLI::App& app) {
  readsDepth_ = true;
  const OptionGroup convention(app, kConventionGroup);
  app.add_flag_callback(
      "--reverse-z", [this] { reverseZ_ = true; }, "Depth with near and far exchanged");
}

void CameraOptions::addWriting(CLI::App& app) {
  onlyReads_ = false;
  const OptionGroup convention(app, kConventionGroup);
  CLI::Option* const reversed = app.add_flag_callback(
      "--reverse-z", [this] { reverseZ_ = true; }, "Write depth with near and far exchanged");
  app.add_flag_callback(
         "--no-reverse-z", [this] { reverseZ_ = false; }, "Write depth that grows with the distance")
      ->excludes(reversed);
  addChoice(app, "--ndc-z", "RANGE", ndcZ_, rowsOf(kNdcZNames), "Range of NDC z to write");
}

std::optional<std::string> CameraOptions::file(bool mayLack) const {
  if (!cameras_.empty() && operand_) throw UsageError("-c and " + *operand_ + " are both a camera; give one");
  if (!cameras_.empty()) return cameras_.front();
  if (const auto input = fileIsCamera(*app_) ? inputFile(*app_) : std::nullopt) return input;
  const bool hasPose = !worldFromCamera_.empty() || !cameraFromWorld_.empty();
  if (!mayLack && !hasPose &&
      std::none_of(patches_.begin(), patches_.end(), [](const Patch& patch) { return patch.isOption; }))
    throw UsageError("a camera is needed: -c FILE, or options such as --position, --target and --fov-y");
  return std::nullopt;
}

CameraPatches CameraOptions::patches(bool isTyped) const {
  CameraPatches all{readAs_.value_or(""), patches_, resize_, otherwise_};
  if (isTyped && resize_) throw UsageError("--viewport: a part of a picture needs a file's; expected WIDTHxHEIGHT");
  // Options are read as they are written; but a place makes the world right-handed.
  const bool hasPlace = std::any_of(patches_.begin(), patches_.end(), [](const Patch& patch) {
    return (patch.path == "position" || patch.path == "target") && patch.value->is_object() &&
           patch.value->contains("lat");
  });
  if (isTyped && !readAs_ && convention_ && (convention_->convention.world == Handedness::right || !hasPlace))
    all.readAs = convention_->name;
  if (isTyped && (!readAs_ || readsDepth_) && reverseZ_)
    all.patches.push_back(setPatch(std::string("convention.reverseZ=") + (*reverseZ_ ? "true" : "false")));
  if (viewport_)
    for (const Patch& patch : viewportPatches(viewport_->width, viewport_->height)) all.patches.push_back(patch);
  requireConsistent(all.patches);
  if (readAs_)
    for (const Patch& patch : patches_)
      if (patch.path == "convention" || patch.path == "convention.preset")
        throw UsageError(patch.label + " and --read-as both say how the file is read; keep one");
  if (takesAnyLens_ && isTyped) assumeLens(all.patches, viewport_.has_value());
  if (takesAnyPosition_ && isTyped) assumePosition(all.patches);
  return all;
}

std::pair<std::unique_ptr<CameraSet>, std::optional<std::string>> CameraOptions::readAll(bool mayLack) const {
  const std::optional<std::string> first = file(mayLack);
  std::vector<std::string> names = cameras_;
  if (names.empty() && first) names.push_back(*first);
  for (const std::string& name : app_->remaining())
    if (name != "--") names.push_back(readFileName("FILE", name));
  if (names.size() < 2) return open(first);
  std::vector<CameraSet::Picked> files;
  for (const std::string& name : names) {
    try {
      auto [cameras, pick] = open(name);
      std::vector<std::size_t> which = cameras->chooseAll(pick);
      files.push_back({std::move(cameras), std::move(which)});
    } catch (const UnknownFormat& e) {  // is not asked about, nor its matrices: it is one of several
      throw InputError(e.what());
    }
  }
  return {std::make_unique<CameraSet>(files), std::nullopt};
}

void CameraOptions::requirePoseCounts(const std::string& option) const {
  std::vector<std::string> given;
  std::string path;
  for (const Patch& patch : patches_) {
    if (!patch.isOption || !isAmong(patch.path, "position target direction rotation euler heading")) continue;
    given.push_back(patch.label);
    path = patch.path;
  }
  if (given.size() == 1)
    throw UsageError(given.front() + " is part of the pose, and " + option +
                     " is all of it; keep one, or replace that part with --set " + path + "=VALUE");
  if (!given.empty())
    throw UsageError(joined(given, " and ") + " are the pose, and so is " + option +
                     "; keep one, or give each pose to --world-from-camera, base first");
}

std::pair<std::unique_ptr<CameraSet>, std::optional<std::string>> CameraOptions::open(
    const std::optional<std::string>& name) const {
  if (name && onlyReads_ && convention_)
    throw UsageError("--convention is of matrices, and this command writes none; --read-as " +
                     std::string(convention_->name) + " reads a file that states no convention");
  if (name && readsDepth_ && reverseZ_)
    throw UsageError("--reverse-z is of a camera by options; --set convention.reverseZ=true reads a file's depth so");
  if (!worldFromCamera_.empty() && !cameraFromWorld_.empty())
    throw UsageError(
        "--world-from-camera and --camera-from-world are both the pose; keep one, or repeat one for a chain");
  if (parts_ && !name) throw UsageError("--parts needs a file: -c FILE");
  Opening opening{cameras_.empty() ? "FILE" : "--camera", std::nullopt, parts_, takesAll_, {}, ""};
  if (!worldFromCamera_.empty() || !cameraFromWorld_.empty()) {
    const bool isInverse = worldFromCamera_.empty();
    opening.poses = isInverse ? cameraFromWorld_ : worldFromCamera_;
    opening.direction = isInverse ? "cameraFromWorld" : "worldFromCamera";
    requirePoseCounts(isInverse ? "--camera-from-world" : "--world-from-camera");
  }
  for (const Patch& patch : patches_)
    if (patch.path == "cameraAxes" && patch.value->is_string()) opening.cameraAxes = patch.value->get<std::string>();
  CameraPatches all = patches(!name);  // whatever is wrong with the options is told before any file is opened
  const auto noted = [](std::unique_ptr<CameraSet> cameras, std::optional<std::string> pick) {
    for (const std::string& each : cameras->notes(pick)) note(each);
    return std::pair(std::move(cameras), std::move(pick));
  };
  if (!name && !opening.poses.empty()) return noted(openPoses(opening, std::move(all)), std::nullopt);
  if (!name) return {std::make_unique<CameraSet>(all), std::nullopt};
  const CameraSource source = splitPick(*name);
  opening.pick = source.pick;
  try {
    return noted(openCameras(source.file, opening, all), source.pick);
  } catch (const UnknownFormat& unknown) {
    if (parts_ || (showsMatrices_ && !changesCamera())) throw;
    const std::string shown = isInlineJson(source.file) ? opening.option : shownName(source.file);
    const auto matrices = cameraOfMatrices(unknown, shown, readAs());
    if (!matrices) throw;
    all.readAs.clear();
    return {openDocument(parseDocument(shown, *matrices), opening, std::move(all)), source.pick};
  }
}

CameraFile CameraOptions::readOne(const CameraSet& cameras, std::size_t which, bool needsPicture,
                                  BoxLack boxMayLack) const {
  CameraFile file = [&] {
    try {
      return readCamera(cameras.document(which), reading(needsPicture, boxMayLack));
    } catch (const InputError& e) {
      if (cameras.matricesText()) throw UnknownFormat(e.what(), *cameras.matricesText());
      throw;
    }
  }();
  if (hasGeoid() && !file.worldIsEcef)
    throw UsageError("--geoid is of heights on the Earth, and " + file.name + " is not there");
  if (onlyReads_ && file.pose) noteHandedness(file);
  for (const std::string& each : file.notes) note(each);
  if (const std::string unread = cameras.unreadOf(which); !unread.empty())
    note(cameras.fileOf(which) + ": not read: " + unread);
  return file;
}

CameraFile CameraOptions::read(bool needsPicture) const {
  const auto [cameras, pick] = readAll();
  return readOne(*cameras, cameras->choose(pick), needsPicture);
}

int CameraOptions::writeEach(
    bool needsPicture,
    const std::function<std::string(const std::string& pick, const CameraFile& camera)>& textOf) const {
  if (!file()) throw UsageError("--all needs a file of cameras");
  const auto [cameras, pick] = readAll();
  if (pick && pick->find('*') == std::string::npos)
    throw UsageError("--all is of every camera of the file, or of those that a * matches; leave out #" + *pick);
  int status = 0;
  for (const std::size_t i : cameras->chooseAll(pick)) {
    std::string text;
    try {
      text = textOf(cameras->pickOf(i), readOne(*cameras, i, needsPicture));
    } catch (const InputError& e) {
      complain(e.what());
      status = 1;
    }
    writeOutput(text);
  }
  return status;
}

std::optional<Convention> CameraOptions::readAs() const {
  if (!readAs_) return std::nullopt;
  return choose("--read-as", *readAs_, presetChoices()).convention;
}

Convention CameraOptions::writing(const Convention& read) const {
  Convention c = read;
  if (convention_) {
    c = convention_->convention;
    c.world = read.world;
  }
  if (reverseZ_) c.reverseZ = *reverseZ_;
  if (ndcZ_) c.ndcZ = *ndcZ_;
  return c;
}

std::string CameraOptions::written(const CameraFile& file, std::string_view between) const {
  return writeCamera(file, convention_ ? *convention_ : *file.preset, writing(file.convention), between);
}

std::string CameraOptions::written(const CameraFile& file) const { return written(file, ",\n  "); }

void CameraOptions::noteHandedness(const CameraFile& file) const {
  if (!convention_ || readAs_) return;
  const std::string name(convention_->name);
  const auto hand = [](Handedness world) { return std::string(nameOf(kWorldNames, world)) + "-handed"; };
  const Handedness world = convention_->convention.world;
  if (!file.isTyped) {
    if (!file.statesConvention && !file.worldIsEcef && world != file.convention.world)
      note(file.name + ": states no convention and is read as " + hand(file.convention.world) + "; " + name + " is " +
           hand(world) + ", and --read-as " + name + " reads the file so");
    return;
  }
  const ConventionPreset& usual = conventionPresets().front();
  const Vec3 up = convention_->up;
  if (world == file.convention.world && !(world == usual.convention.world && up == usual.up))
    note("the options are read in " + name + "'s world: " + hand(world) + ", up " + formatNumber(up.x) + "," +
         formatNumber(up.y) + "," + formatNumber(up.z) + "; --read-as opengl reads them in OpenGL's");
}

}  // namespace viewproj::cmd
