#include "input/camera_source.hpp"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <unordered_map>

#include "input/importers/importer.hpp"
#include "text/error.hpp"
#include "text/format_number.hpp"
#include "text/names.hpp"
#include "text/visible.hpp"

namespace viewproj::cmd {
namespace {

/// The first that recognises a file reads it; what none does is a camera file of our own.
constexpr const Importer* kImporters[] = {&kGltf, &kThreeJs, &kNerfTransforms, &kOpenCv, &kMatrices};

const Importer* importerOf(const Document& document) {
  for (const Importer* importer : kImporters)
    if (importer->recognises(document.root())) return importer;
  return nullptr;
}

/// The canonical file holds one camera.
std::vector<HeldCamera> listCanonical(const Document& document) {
  const ObjectReader root(document, document.root(), {});
  if (!root.has("projection")) {
    const CameraFile file = readCamera(document, {});
    if (!file.pose) root.fail("holds no camera: neither a projection nor a pose");
  }
  std::string_view kind = "no projection";
  if (const auto projection = root.object("projection")) kind = projection->text("type").value_or(kind);
  return {{root.isString("name") ? *root.text("name") : "", "0", "", kind, "a camera file"}};
}

std::vector<HeldCamera> heldBy(const Document& document) {
  const Importer* importer = importerOf(document);
  return importer ? importer->list(document) : listCanonical(document);
}

/// How many cameras have a name.
using NameCounts = std::unordered_map<std::string_view, std::size_t>;

NameCounts countNames(const std::vector<HeldCamera>& all) {
  NameCounts counts;
  for (const HeldCamera& camera : all) ++counts[camera.name];
  return counts;
}

/// The shortest text after # that picks the camera and no other, and that fits on a line.
std::string pickOf(const HeldCamera& camera, const NameCounts& counts) {
  const bool named = !camera.name.empty() && visible(camera.name) == camera.name && counts.at(camera.name) == 1;
  return named ? std::string(camera.name) : camera.number;
}

std::string someOf(const std::vector<HeldCamera>& all, const std::vector<HeldCamera>& shown) {
  constexpr std::size_t kMost = 8;
  const NameCounts counts = countNames(all);
  std::string text;
  for (std::size_t i = 0; i < std::min(shown.size(), kMost); ++i)
    text += (i == 0 ? "#" : ", #") + pickOf(shown[i], counts);
  return shown.size() <= kMost ? text : text + " and " + std::to_string(shown.size() - kMost) + " more";
}

std::size_t choose(const Document& document, const std::vector<HeldCamera>& cameras,
                   const std::optional<std::string>& pick) {
  const std::string choices = someOf(cameras, cameras) + " (--list tells what they are)";
  if (!pick) {
    if (cameras.size() == 1) return 0;
    throw InputError(document.name() + ": holds " + std::to_string(cameras.size()) +
                     " cameras; pick one after the file's name: " + choices);
  }
  using Field = std::string_view (*)(const HeldCamera&);
  constexpr Field kFields[] = {[](const HeldCamera& c) { return c.name; },
                               [](const HeldCamera& c) { return std::string_view(c.number); },
                               [](const HeldCamera& c) { return c.alias; }};
  for (const Field field : kFields) {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < cameras.size(); ++i)
      if (!pick->empty() && field(cameras[i]) == *pick) found.push_back(i);
    if (found.size() == 1) return found.front();
    if (found.empty()) continue;
    std::vector<HeldCamera> several;
    for (std::size_t i : found) several.push_back(cameras[i]);
    throw InputError(document.name() + ": has " + std::to_string(found.size()) + " cameras called " +
                     cmd::quoted(*pick) + "; their numbers tell them apart: " + someOf(cameras, several));
  }
  throw InputError(document.name() + ": has no camera " + cmd::quoted(*pick) + "; it has " + choices);
}

/// Angles in degrees that look like radians: half a turn is 3.14 of them, and few lenses see less than 3 degrees.
constexpr double kLeastLikeRadians = 0.05, kMostLikeRadians = 3.2;

void noteRadians(const Document& document) {
  const auto projection = document.root().find("projection");
  if (projection == document.root().end() || !projection->is_object()) return;
  for (const char* field : {"fovY", "fovX", "fovDiagonal"}) {
    const auto angle = projection->find(field);
    if (angle == projection->end() || !angle->is_number()) continue;
    const double degrees = angle->get<double>();
    if (!(degrees >= kLeastLikeRadians && degrees < kMostLikeRadians)) continue;
    const std::string typed = formatNumber(degrees), meant = formatDigits(degrees * 180 / std::numbers::pi, 6);
    document.note({"projection", field}, "is " + typed + " degrees; as radians it would be " + meant + " degrees");
  }
}

}  // namespace

CameraSource splitPick(const std::string& given) {
  const std::size_t first = given.find_first_not_of(" \t\r\n");
  if (first != std::string::npos && given[first] == '{') {
    const std::size_t mark = given.find('#', given.rfind('}'));
    if (mark == std::string::npos) return {given, std::nullopt};
    return {given.substr(0, mark), given.substr(mark + 1)};
  }
  std::error_code ignored;
  std::size_t mark = given.find('#');
  if (mark == std::string::npos || std::filesystem::exists(given, ignored)) return {given, std::nullopt};
  constexpr std::size_t kLongestName = 4096;  // PATH_MAX: none that is longer can be opened
  for (std::size_t at = mark; at < kLongestName; at = given.find('#', at + 1))
    if (const std::string file = given.substr(0, at); file == "-" || std::filesystem::exists(file, ignored)) {
      mark = at;
      break;
    }
  return {given.substr(0, mark), given.substr(mark + 1)};
}

CameraFile readAnyCamera(const Document& document, const std::optional<std::string>& pick,
                         const CameraReading& reading) {
  const Importer* importer = importerOf(document);
  if (!importer) {
    if (pick) choose(document, listCanonical(document), pick);
    CameraFile file = readCamera(document, reading);
    noteRadians(document);
    return file;
  }
  if (!reading.readAs.empty() && importer != &kMatrices)
    throw InputError(document.name() + ": is " + std::string(importer->form) +
                     ", which says itself how its numbers are meant; --read-as is for camera files and bare matrices");
  const std::vector<HeldCamera> cameras = importer->list(document);
  const CameraFile file = importer->read(document, choose(document, cameras, pick), reading);
  document.requireSetsRead(std::string(importer->form));
  return file;
}

CameraFile readAnyCamera(Document& document, const std::optional<std::string>& pick, const CameraReading& reading,
                         const TypedCamera& typed) {
  if (typed.empty()) return readAnyCamera(document, pick, reading);
  // A lens that is replaced need not fit the picture.
  CameraReading ofFile = reading, ofBoth = reading;
  if (typed.replacesLens()) ofFile.allowStretch = true;
  if (importerOf(document)) return typed.over(readAnyCamera(document, pick, ofFile), document, reading);
  typed.mergeInto(document, ofBoth, [&] { return readCamera(document, ofFile); });
  return readAnyCamera(document, pick, ofBoth);
}

void setViewportSize(Document& document, double width, double height) {
  const auto viewport = document.root().find("viewport");
  if (viewport != document.root().end() && viewport->is_array() && viewport->size() == 4 &&
      viewport->front().is_number()) {  // x, y, width, height
    document.set(readAssignment("viewport.2=" + formatNumber(width)));
    document.set(readAssignment("viewport.3=" + formatNumber(height)));
    return;
  }
  if (viewport != document.root().end() && !viewport->is_object()) document.set(readAssignment("viewport=null"));
  document.set(readAssignment("viewport.width=" + formatNumber(width)));
  document.set(readAssignment("viewport.height=" + formatNumber(height)));
}

bool statesConvention(const Document& document) {
  const Importer* importer = importerOf(document);
  const auto stated = document.root().find("convention");
  return importer || (stated != document.root().end() && !stated->is_null());
}

std::vector<std::string_view> foreignForms() {
  std::vector<std::string_view> forms;
  for (const Importer* importer : kImporters) forms.push_back(importer->form);
  return forms;
}

std::vector<std::string> picksOf(const Document& document) {
  const std::vector<HeldCamera> cameras = heldBy(document);
  const NameCounts counts = countNames(cameras);
  std::vector<std::string> picks;
  for (const HeldCamera& camera : cameras) picks.push_back(pickOf(camera, counts));
  return picks;
}

std::string listCameras(const Document& document) {
  const std::vector<HeldCamera> cameras = heldBy(document);
  const NameCounts counts = countNames(cameras);
  // A longer name than this stands out, and does not make every line as long.
  static constexpr std::size_t kWidest = 60;
  std::size_t pickWidth = 0, kindWidth = 0;
  const auto widen = [](std::size_t& width, std::size_t size) {
    width = std::max(width, std::min<std::size_t>(size, kWidest));
  };
  for (const HeldCamera& camera : cameras) {
    widen(pickWidth, pickOf(camera, counts).size());
    widen(kindWidth, camera.kind.size());
  }
  const auto padded = [](std::string text, std::size_t width) {
    text.resize(std::max(text.size(), width), ' ');
    return text;
  };
  std::string text;
  for (const HeldCamera& camera : cameras)
    text += "#" + padded(pickOf(camera, counts), pickWidth) + "  " +
            padded(visible(camera.kind.substr(0, kWidest)), kindWidth) + "  " + visible(camera.note) + "\n";
  return text;
}

}  // namespace viewproj::cmd
