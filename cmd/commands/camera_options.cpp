#include "commands/camera_options.hpp"

#include <algorithm>
#include <memory>

#include "input/camera_fields.hpp"
#include "input/convention_names.hpp"
#include "input/typed_value.hpp"
#include "output/camera_text.hpp"
#include "output/output_file.hpp"
#include "text/error.hpp"
#include "text/names.hpp"

namespace viewproj::cmd {
namespace {

Names<ConventionPreset> presets() {
  Names<ConventionPreset> names;
  for (const ConventionPreset& preset : conventionPresets()) names.emplace_back(preset.name, preset);
  return names;
}

}  // namespace

Names<Convention> presetConventions() {
  Names<Convention> names;
  for (const ConventionPreset& preset : conventionPresets()) names.emplace_back(preset.name, preset.convention);
  return names;
}

void CameraOptions::add(CommandLine& line) {
  notes_.add(line);
  const Heading heading(line, kCameraHeading);
  addValue(line, "-c,--camera", "FILE[#NAME]", camera_, readFileName,
           "Camera file, or the JSON itself; also glTF, transforms.json, three.js, calibrations of OpenCV, ROS and "
           "others (help formats), or matrices. #NAME picks one of several cameras");
  addValue(line, "--format", "FILE", format_, readFileName,
           "Read the camera file as the kind that FILE describes (help kinds)");
  line.addFlag(kListOption, list_, "Name the cameras that the camera file holds, and do nothing else");
  addValue(line, "--viewport", "WxH", viewport_, readSize,
           "Viewport size in pixels, as in 1920x1080 (default: the file's)");
  addValues(
      line, "--set", "FIELD=VALUE", set_,
      [](const std::string&, const std::string& text) { return readAssignment(text); },
      "Set a field of the camera file, as in projection.fovY=75; of two of the same the later counts");
  addChoice(line, "--read-as", "NAME", readAs_, namesAlone(presetNames()), "Read the camera in this convention",
            "the file's, or opengl");
  addFields(line);
  line.addFlag("--allow-stretch", allowStretch_, "Let the camera's shape differ from the viewport's");
  line.addFlag("--ignore-distortion", ignoreDistortion_, "Take a lens that distorts as one that does not");
}

void CameraOptions::addWriting(CommandLine& line) {
  const Heading heading(line, "Convention written");
  addChoice(line, "--convention", "NAME", convention_, presets(),
            "Write in this convention; without a camera file also read the options in it", "the one that was read");
  const auto takeReverseZ = [this](std::int64_t sum) {
    if (sum == 0) throw UsageError("--reverse-z and --no-reverse-z contradict each other");
    reverseZ_ = sum > 0;
  };
  line.addFlag("--reverse-z,!--no-reverse-z", takeReverseZ,
               "Write depth with near and far exchanged, or not (default: as the convention has it)");
  addChoice(line, "--ndc-z", "RANGE", ndcZ_, rowsOf(kNdcZNames), "Write this range of NDC z", "the convention's");
}

void CameraOptions::addFile(CommandLine& line) {
  takesFile_ = true;
  addValue(line, "FILE", "", file_, readFileName,
           "Camera file, where -c was not given; absent or - for standard input");
}

void CameraOptions::addFields(CommandLine& line) {
  const Heading heading(line, kCameraFields);
  for (const CameraOption& option : cameraOptions())
    if (!line.wants(option.name))
      continue;
    else if (option.field)
      line.add({std::string(option.name), std::string(valueWord(option.field->form)), std::string(option.field->help)},
               [this, option](const std::string&, const std::vector<std::string>& given) {
                 typed_.add(option, given.front());
               });
    else
      line.addFlag(
          option.name, [this, option](std::int64_t) { typed_.add(option, ""); },
          "The projection is " + std::string(option.type->name) + ", where its fields could be another's too");
}

CameraSource CameraOptions::source() const {
  if (camera_ && file_) throw UsageError("-c gives the camera already; leave out one of it and " + *file_);
  if (!camera_ && !takesFile_)
    throw UsageError("-c FILE is needed: the camera; or options that say it, such as --position, --target and --fov-y");
  return splitPick(camera_ ? *camera_ : file_.value_or("-"));
}

std::unique_ptr<Document> CameraOptions::open(const CameraSource& picked) const {
  for (const Assignment& assignment : set_)
    if (const std::string field = dotted(assignment.path);
        viewport_ && (field == "viewport" || field == "viewport.width" || field == "viewport.height"))
      throw UsageError("--viewport and --set " + assignment.text + " both give the size of the picture");
  if (format_ && isTyped()) throw UsageError("--format tells how a camera file is read, and there is none");
  auto document = isTyped() ? std::make_unique<Document>(Document::Typed{}, "the command line")
                            : std::make_unique<Document>(picked.file, camera_ ? "--camera" : "FILE", "");
  if (format_) {
    if (*format_ == "-") throw UsageError("--format -: a file is expected; standard input is for cameras and records");
    kinds_ = readKinds(Document(*format_, "--format", ""), builtInKinds());
    document->setKinds(kinds_);
  }
  if (viewport_) setViewportSize(*document, viewport_->width, viewport_->height);
  for (const Assignment& assignment : set_) document->set(assignment);
  return document;
}

int CameraOptions::list() const {
  typed_.requireConsistent();
  if (isTyped()) throw UsageError("--list names the cameras of a file, and there is none");
  writeOutput(listCameras(*open(source())));
  return 0;
}

std::string CameraOptions::readAs() const {
  if (readAs_ || !isTyped() || !convention_) return readAs_.value_or("");
  // A place makes the world right-handed.
  if (typed_.hasPlace() && convention_->convention.world == Handedness::left) return "";
  return std::string(convention_->name);
}

CameraReading CameraOptions::reading(bool needsPicture) const {
  return {.readAs = readAs(),
          .allowStretch = allowStretch_,
          .ignoreDistortion = ignoreDistortion_,
          .needsPicture = needsPicture && !anyOpening_};
}

CameraFile CameraOptions::read(bool needsPicture) const {
  typed_.requireConsistent();
  const CameraSource picked = isTyped() ? CameraSource{} : source();
  std::unique_ptr<Document> opened = open(picked);
  Document& document = *opened;
  TypedCamera typed = typed_;
  if (anyOpening_ && isTyped()) typed.assumeOpening(viewport_.has_value());
  CameraFile file = readAnyCamera(document, picked.pick, reading(needsPicture), typed);
  statesConvention_ = readAs_ || isTyped() || file.statesConvention || file.worldIsEcef;
  for (const std::string& note : document.notes()) notes_.say(note);
  file.isTyped = isTyped();
  if (isTyped()) fields_ = std::move(opened);
  return file;
}

int CameraOptions::writeEach(
    bool needsPicture,
    const std::function<std::string(const std::string& pick, const CameraFile& camera)>& textOf) const {
  typed_.requireConsistent();
  if (isTyped()) throw UsageError("--all is of the cameras of a file, and there is none");
  const CameraSource picked = source();
  if (picked.pick) throw UsageError("--all is of every camera of the file; leave out #" + *picked.pick);
  const std::unique_ptr<Document> document = open(picked);
  int status = 0;
  const auto refuse = [&](const std::string& message) {
    complain(message);
    status = 1;
  };
  const auto write = [&](const std::string& pick, const CameraFile& camera) {
    for (const std::string& note : document->takeNotes()) notes_.say(note);
    statesConvention_ = readAs_ || camera.statesConvention;
    std::string text;
    try {
      text = textOf(pick, camera);
    } catch (const InputError& e) {
      const std::string message = e.what();
      const bool isNamed = message.starts_with(camera.name + ":");
      return refuse(isNamed ? camera.name + "#" + pick + message.substr(camera.name.size()) : message);
    }
    writeOutput(text);
  };
  readEachCamera(*document, reading(needsPicture), typed_, write, refuse);
  for (const std::string& note : document->takeNotes()) notes_.say(note);
  return status;
}

std::optional<std::string> CameraOptions::asTyped(const CameraFile& file) const {
  if (!fields_ || fields_->isSet(std::string(field::convention))) return std::nullopt;
  const ConventionPreset* preset = readAs().empty() ? &conventionPresets().front() : findPreset(readAs());
  if (convention_ && convention_->name != preset->name) {
    // On the Earth a preset says nothing but which way a rotation's axes point.
    const ObjectReader fields(*fields_, fields_->root(), {});
    if (readAs_ || !typed_.hasPlace() || fields.has(field::rotation)) return std::nullopt;
    preset = findPreset(convention_->name);
  }
  return writeFields(*fields_, writing(file), *preset);
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
  const bool right = file.convention.world == Handedness::right;
  const bool fits = convention_ && convention_->convention.world == file.convention.world;
  if (fits) return convention_->cameraAxes;
  return file.cameraAxes.value_or(right ? CameraAxes::RUB : CameraAxes::RUF);
}

void CameraOptions::noteHandedness(const CameraFile& file) const {
  if (!convention_ || statesConvention_ || convention_->convention.world == file.convention.world) return;
  const std::string name(convention_->name);
  const auto hand = [](Handedness world) { return std::string(nameOf(kWorldNames, world)) + "-handed"; };
  notes_.say(file.name + ": names no convention, so its world stays " + hand(file.convention.world) + "; " + name +
             "'s is " + hand(convention_->convention.world) + ": --read-as " + name +
             " reads the file so, and matrix " + (convention_->up.z > 0 ? "--map -z,x,y --scale 100" : "--map x,y,-z") +
             " writes the camera for such a world");
}

}  // namespace viewproj::cmd
