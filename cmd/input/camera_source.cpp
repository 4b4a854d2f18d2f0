#include "input/camera_source.hpp"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <unordered_map>

#include "input/camera_fields.hpp"
#include "input/importers/importer.hpp"
#include "input/kinds/interpreter.hpp"
#include "input/kinds/lookup.hpp"
#include "input/projection_types.hpp"
#include "input/replaced_sets.hpp"
#include "text/error.hpp"
#include "text/format_number.hpp"
#include "text/names.hpp"
#include "text/system.hpp"
#include "text/visible.hpp"

namespace viewproj::cmd {
namespace {

/// A form of file that is not our own: a row of kinds.json or of --format, or else an importer.
struct ForeignForm {
  ForeignForm() = default;
  explicit ForeignForm(const Importer* theImporter) : importer(theImporter) {}
  explicit ForeignForm(const Kind* theKind) : kind(theKind) {}

  const Importer* importer = nullptr;
  const Kind* kind = nullptr;

  explicit operator bool() const { return importer || kind; }
  std::string_view name() const { return importer ? importer->form : std::string_view(kind->form); }
  std::vector<HeldCamera> list(const Document& document, bool withNotes) {
    return importer ? importer->list(document) : cameras(document).list(withNotes);
  }
  CameraFile read(const Document& document, std::size_t which, const CameraReading& reading) {
    open(document);
    return importer ? reader_(which, reading) : cameras(document).read(which, reading);
  }
  /// What all of its cameras share. Throws InputError.
  void open(const Document& document) {
    if (importer && !reader_) reader_ = importer->open(document);
  }

 private:
  KindCameras& cameras(const Document& document) {
    if (!cameras_) cameras_.emplace(document, *kind);
    return *cameras_;
  }

  std::optional<KindCameras> cameras_ = {};
  CameraReader reader_ = {};
};

/// Before the rows, and after them.
constexpr const Importer* kFirst[] = {&kGltf, &kThreeJs};
constexpr const Importer* kLast[] = {&kMatrices};

/// A camera file of our own has an object for its lens, which --set gives to any file.
bool isPlainlyCanonical(const Document& document) {
  const auto projection = document.root().find("projection");
  return projection != document.root().end() && projection->is_object() && !document.isSet("projection");
}

/// What the file is; nothing: a camera file of our own.
ForeignForm formOf(const Document& document) {
  if (document.isTyped()) return {};
  if (const std::span<const Kind> own = document.ownKinds(); !own.empty()) {
    if (const Kind* const kind = kindOf(document, own)) return ForeignForm(kind);
    std::string lacks;
    for (const Kind& kind : own) lacks += (lacks.empty() ? "" : "; ") + kind.form + ": " + lackOf(document, kind);
    throw InputError(document.name() + ": is of no kind that --format describes: " + visible(lacks));
  }
  for (const Importer* importer : kFirst)
    if (importer->recognises(document.root())) return ForeignForm(importer);
  if (!isPlainlyCanonical(document))
    if (const Kind* const kind = kindOf(document, builtInKinds())) return ForeignForm(kind);
  for (const Importer* importer : kLast)
    if (importer->recognises(document.root())) return ForeignForm(importer);
  if (!isPlainlyCanonical(document)) {
    for (const Kind& kind : builtInKinds())
      if (const auto odd = oddShapeFor(document, kind))
        document.fail(odd->path,
                      "expected " + std::to_string(odd->count) + " numbers, which " + kind.form + " has here");
  }
  if (document.isArray())
    document.fail({}, "expected a JSON object, or an array that is a camera file of a known kind");
  return {};
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
  return {{root.isString("name") ? *root.text("name") : "", "", "0", "", kind, "a camera file"}};
}

/// Says of each camera of the list whether reading it fails, but for want of a viewport.
void noteUnreadable(Document& document, const Importer* importer, std::vector<HeldCamera>& cameras) {
  if (!document.root().contains("viewport")) setViewportSize(document, 1, 1);
  const auto meanwhile = document.withoutPlaces();
  const CameraReading reading{.readAs = {}, .allowStretch = true};
  const auto attempt = [&](HeldCamera& camera, const auto& read) {
    constexpr std::string_view kSaid = "cannot be read: ";
    try {
      read();
    } catch (const InputError& e) {
      if (camera.note.find(kSaid) == std::string::npos)
        camera.note += (camera.note.empty() ? "" : ", ") + std::string(kSaid) + e.what();
      return false;
    }
    return true;
  };
  if (!importer) {
    attempt(cameras.front(), [&] { (void)readCamera(document, reading); });
    return;
  }
  CameraReader reader;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const bool isOpen = reader || attempt(cameras[i], [&] { reader = importer->open(document); });
    if (isOpen) attempt(cameras[i], [&] { (void)reader(i, reading); });
  }
}

/// How many cameras have a name, and an id.
struct NameCounts {
  std::unordered_map<std::string_view, std::size_t> names, ids;
};

NameCounts countNames(const std::vector<HeldCamera>& all) {
  NameCounts counts;
  for (const HeldCamera& camera : all) {
    ++counts.names[camera.name];
    ++counts.ids[camera.id];
  }
  return counts;
}

/// The shortest text after # that picks the camera and no other, and that fits on a line.
std::string pickOf(const HeldCamera& camera, const NameCounts& counts) {
  const auto picks = [](std::string_view text, const auto& all) {
    return !text.empty() && visible(text) == text && all.at(text) == 1;
  };
  if (picks(camera.name, counts.names)) return std::string(camera.name);
  // Names go before ids, and both before numbers, which two # mean alone.
  if (picks(camera.id, counts.ids) && counts.names.count(camera.id) == 0) return camera.id;
  const bool isTaken = counts.names.count(camera.number) > 0 || counts.ids.count(camera.number) > 0;
  return (isTaken ? "#" : "") + camera.number;
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
  constexpr Field kFields[] = {
      [](const HeldCamera& c) { return c.name; }, [](const HeldCamera& c) { return std::string_view(c.id); },
      [](const HeldCamera& c) { return std::string_view(c.number); }, [](const HeldCamera& c) { return c.alias; }};
  for (const Field field : kFields) {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < cameras.size(); ++i)
      if (!pick->empty() && field(cameras[i]) == *pick) found.push_back(i);
    if (found.size() == 1) return found.front();
    if (found.empty()) continue;
    std::vector<HeldCamera> several;
    for (std::size_t i : found) several.push_back(cameras[i]);
    throw InputError(document.name() + ": has " + std::to_string(found.size()) + " cameras called " + inQuotes(*pick) +
                     "; their numbers tell them apart: " + someOf(cameras, several));
  }
  for (std::size_t i = 0; i < cameras.size(); ++i)
    if ("#" + cameras[i].number == *pick) return i;
  throw InputError(document.name() + ": has no camera " + inQuotes(*pick) + "; it has " + choices);
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
  std::error_code ignored;
  const bool isArray =
      first != std::string::npos && given[first] == '[' && !std::filesystem::exists(pathOf(given), ignored);
  if (first != std::string::npos && (given[first] == '{' || isArray)) {
    const std::size_t mark = given.find('#', given.rfind(isArray ? ']' : '}'));
    if (mark == std::string::npos) return {given, std::nullopt};
    return {given.substr(0, mark), given.substr(mark + 1)};
  }
  std::size_t mark = given.find('#');
  if (mark == std::string::npos || std::filesystem::exists(pathOf(given), ignored)) return {given, std::nullopt};
  constexpr std::size_t kLongestName = 4096;  // PATH_MAX: none that is longer can be opened
  for (std::size_t at = mark; at < kLongestName; at = given.find('#', at + 1))
    if (const std::string file = given.substr(0, at); file == "-" || std::filesystem::exists(pathOf(file), ignored)) {
      mark = at;
      break;
    }
  return {given.substr(0, mark), given.substr(mark + 1)};
}

namespace {

void requireNoReadAs(const Document& document, const ForeignForm& form, const CameraReading& reading) {
  if (reading.readAs.empty() || form.importer == &kMatrices) return;
  throw InputError(document.name() + ": is " + std::string(form.name()) +
                   ", which says itself how its numbers are meant; --read-as is for camera files and bare matrices");
}

/// A lens that is replaced need not fit the picture, nor a pose be read.
CameraReading readingUnder(const TypedCamera& typed, CameraReading reading) {
  if (typed.replacesLens()) reading.allowStretch = true;
  reading.replacesPose = typed.replacesPose();
  reading.aspect = typed.aspect();
  return reading;
}

/// Throws UsageError where an option replaces what --set gives. pick: one of the cameras, or nothing for all.
void requireSetsCount(Document& document, const ForeignForm& form, const std::optional<std::size_t>& pick,
                      const CameraReading& reading, const TypedCamera& typed) {
  if (document.sets().empty() || typed.empty()) return;
  CameraReading ofFile = reading;
  ofFile.allowStretch = true;
  ofFile.aspect = typed.aspect();
  const auto anew = [&] { return form.importer ? ForeignForm(form.importer) : ForeignForm(form.kind); };
  const auto read = [&](std::size_t first, std::size_t end) {
    ForeignForm again = anew();
    std::vector<CameraFile> cameras;
    for (std::size_t i = first; i < end; ++i) cameras.push_back(again.read(document, i, ofFile));
    return cameras;
  };
  const std::size_t count = anew().list(document, false).size();
  const auto readAll = [&] { return pick ? read(*pick, *pick + 1) : read(0, count); };
  requireSetsCount(document, typed, reading, [&] {
    ofFile.replacesPose = false;
    try {
      return readAll();
    } catch (const InputError&) {
      ofFile.replacesPose = typed.replacesPose();
      return readAll();
    }
  });
}

CameraFile readForm(ForeignForm& form, const Document& document, const std::optional<std::string>& pick,
                    const CameraReading& reading) {
  if (!form) {
    if (pick) choose(document, listCanonical(document), pick);
    CameraFile file = readCamera(document, reading);
    noteRadians(document);
    const auto stated = document.root().find("convention");
    file.statesConvention = stated != document.root().end() && !stated->is_null();
    return file;
  }
  requireNoReadAs(document, form, reading);
  const std::vector<HeldCamera> cameras = form.list(document, false);
  CameraFile file = form.read(document, choose(document, cameras, pick), reading);
  document.requireSetsRead(std::string(form.name()));
  file.statesConvention = true;
  return file;
}

}  // namespace

CameraFile readAnyCamera(const Document& document, const std::optional<std::string>& pick,
                         const CameraReading& reading) {
  ForeignForm form = formOf(document);
  return readForm(form, document, pick, reading);
}

CameraFile readAnyCamera(Document& document, const std::optional<std::string>& pick, const CameraReading& reading,
                         const TypedCamera& typed) {
  ForeignForm form = formOf(document);
  if (typed.empty()) return readForm(form, document, pick, reading);
  CameraReading ofFile = readingUnder(typed, reading), ofBoth = reading;
  if (form) {
    requireNoReadAs(document, form, reading);
    if (!document.sets().empty())
      requireSetsCount(document, form, choose(document, form.list(document, false), pick), reading, typed);
    return typed.over(readForm(form, document, pick, ofFile), document, reading);
  }
  typed.mergeInto(document, ofBoth, [&] { return readCamera(document, ofFile); });
  return readForm(form, document, pick, ofBoth);
}

void readEachCamera(Document& document, const CameraReading& reading, const TypedCamera& typed,
                    const std::function<void(const std::string& pick, const CameraFile& camera)>& take,
                    const std::function<void(const std::string& message)>& refuse) {
  ForeignForm form = formOf(document);
  if (!form) {
    const std::vector<HeldCamera> one = listCanonical(document);
    return take(pickOf(one.front(), countNames(one)), readAnyCamera(document, std::nullopt, reading, typed));
  }
  requireNoReadAs(document, form, reading);
  requireSetsCount(document, form, std::nullopt, reading, typed);
  const CameraReading ofFile = readingUnder(typed, reading);
  const std::vector<HeldCamera> cameras = form.list(document, false);
  const NameCounts counts = countNames(cameras);
  form.open(document);
  const auto read = [&](std::size_t which) {
    CameraFile file = form.read(document, which, ofFile);
    if (!typed.empty()) file = typed.over(file, document, reading);
    file.statesConvention = true;
    return file;
  };
  std::size_t bad = 0;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const bool isPlaced = bad < Document::kMostPlaced;
    std::optional<CameraFile> file;
    try {
      if (isPlaced) {
        file = read(i);
      } else {
        const auto meanwhile = document.withoutPlaces();
        file = read(i);
      }
    } catch (const InputError& e) {
      const std::string message = e.what();
      refuse((isPlaced || message.starts_with(document.name()) ? "" : document.name() + ": ") + message);
      ++bad;
    } catch (const UsageError& e) {
      const std::string message = e.what(), before = document.name() + ": ";
      refuse(document.name() + "#" + pickOf(cameras[i], counts) + ": " +
             message.substr(message.starts_with(before) ? before.size() : 0));
      ++bad;
    }
    if (file) take(pickOf(cameras[i], counts), *file);
  }
  if (bad == 0) document.requireSetsRead(std::string(form.name()));
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

bool isForeign(const Document& document) { return static_cast<bool>(formOf(document)); }

std::vector<ForeignFile> foreignFiles() {
  std::vector<ForeignFile> files;
  for (const Importer* importer : kFirst) files.push_back({importer->name, importer->form, {}});
  for (const Kind& kind : builtInKinds()) files.push_back({kind.name, kind.form, kind.help});
  for (const Importer* importer : kLast) files.push_back({importer->name, importer->form, {}});
  return files;
}

std::string listCameras(Document& document) {
  ForeignForm form = formOf(document);
  std::vector<HeldCamera> cameras = form ? form.list(document, true) : listCanonical(document);
  if (!form.kind) noteUnreadable(document, form.importer, cameras);
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
