#include "camera/camera_set.hpp"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numeric>

#include "camera/read_convention.hpp"
#include "text/error.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "text/pattern.hpp"
#include "text/system.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

constexpr const char* kCameras = "cameras";
constexpr std::size_t kMostNames = 8;  // in messages

/// Members that say nothing of a camera, or that many kinds of files have; --read-as states a convention.
bool isBeside(std::string_view name) {
  return name == "name" || name == "$schema" || name == "convention" || name == "distortion";
}

/// Whether the object has a member of ours at its top, but those that many kinds of files have.
bool hasOurMember(const Json& object) {
  if (!object.is_object()) return false;
  return std::any_of(std::begin(kFields), std::end(kFields), [&](const Field& field) {
    if (isBeside(topName(field))) return false;
    return object.contains(topName(field)) || (!field.alias.empty() && object.contains(field.alias));
  });
}

bool isSet(const Json& root) {
  const auto cameras = root.is_object() ? root.find(kCameras) : root.end();
  if (!root.is_object() || cameras == root.end() || !cameras->is_array()) return false;
  return cameras->empty()
             ? hasOurMember(root)
             : std::all_of(cameras->begin(), cameras->end(), [](const Json& entry) { return entry.is_object(); }) &&
                   (hasOurMember(root) || std::any_of(cameras->begin(), cameras->end(), hasOurMember));
}

std::string nameIn(const Json& camera) {
  const auto name = camera.find("name");
  return name != camera.end() && name->is_string() ? name->get<std::string>() : "";
}

/// An entry laid over the shared members.
Json entryOver(const Document& file, const Json& shared, std::size_t which) {
  Document entry{file.name, std::make_shared<Json>((*file.root)[kCameras][which])};
  Document whole{file.name, std::make_shared<Json>(shared)};
  entry.name += ": cameras." + std::to_string(which);
  normalize(entry);
  normalize(whole);
  if (entry.root->contains(kCameras)) Node(entry, (*entry.root)[kCameras], kCameras).fail("is inside a camera");
  layOver(whole, *entry.root);
  return std::move(*whole.root);
}

/// A camera of options only.
Import optionsAlone(const CameraPatches& patches) {
  return Import::one([preset = patches.readAs] {
    return preset.empty() ? Json::object() : Json{{"convention", preset}};
  });
}

/// "a.yml and b.yml".
std::string namesOf(const std::vector<CameraSet::Picked>& files) {
  std::vector<std::string_view> names;
  for (const CameraSet::Picked& file : files) names.push_back(file.cameras->name());
  return together(names);
}

Import joinedOf(const std::vector<CameraSet::Picked>& files) {
  Import all;
  std::unordered_map<std::string, std::vector<Json>> known;  // by name
  std::vector<bool> areOnly;
  for (const auto& [cameras, which] : files)
    for (const std::size_t i : which) {
      const bool isOnly = which.size() == 1;
      std::string name = cameras->nameOf(i);
      Json document;
      try {
        const Document read = cameras->document(i);
        name = cameras->nameOf(i, read);
        document = *read.root;
      } catch (const InputError&) {  // is told when the camera is asked for
      }
      // Files that belong together, as those of a stereo calibration, have the same cameras.
      std::vector<Json>& others = known[name];
      if (!isOnly && !name.empty() && std::find(others.begin(), others.end(), document) != others.end()) continue;
      others.push_back(std::move(document));
      areOnly.push_back(isOnly);
      all.add(std::move(name), "", nullptr);
      all.cameras.back().isOfAnother = cameras->isOfAnother(i);
      all.cameras.back().set = cameras;
      all.cameras.back().which = i;
    }
  for (std::size_t i = 0; i < areOnly.size(); ++i)
    if (CameraEntry& camera = all.cameras[i]; areOnly[i] && (camera.name.empty() || known[camera.name].size() > 1))
      camera.name = pathOf(camera.set->name()).stem().string();
  all.unread = [cameras = all.cameras](std::size_t i) { return cameras[i].set->unreadOf(cameras[i].which); };
  return all;
}

bool isWhole(std::string_view text) { return !text.empty() && text.find_first_not_of("0123456789") == text.npos; }

}  // namespace

CameraSource splitPick(const std::string& source) {
  const std::size_t first = source.find_first_not_of(" \t\r\n");
  if (first != std::string::npos && source[first] == '{') {
    const std::size_t mark = source.find('#', source.rfind('}'));
    if (mark == std::string::npos) return {source, std::nullopt};
    return {source.substr(0, mark), source.substr(mark + 1)};
  }
  std::error_code ignored;
  std::size_t mark = source.find('#');
  if (mark == std::string::npos || std::filesystem::exists(pathOf(source), ignored)) return {source, std::nullopt};
  constexpr std::size_t kLongestName = 4096;  // PATH_MAX: a longer name cannot be opened
  for (std::size_t at = mark; at < kLongestName; at = source.find('#', at + 1))
    if (const std::string file = source.substr(0, at); file == "-" || std::filesystem::exists(pathOf(file), ignored)) {
      mark = at;
      break;
    }
  return {source.substr(0, mark), source.substr(mark + 1)};
}

bool isCameraDocument(const Json& root) {
  if (!root.is_object() || hasOurMember(root) || isSet(root)) return root.is_object();
  const auto members = root.items();
  return std::all_of(members.begin(), members.end(), [](const auto& member) { return isBeside(member.key()); });
}

Import openCameraDocument(const Document& file) {
  const Json& root = *file.root;
  Import result;
  if (!isSet(root)) {
    result.add(nameIn(root), "", [file] { return *file.root; });
    return result;
  }
  const auto shared = std::make_shared<Json>(root);
  shared->erase(kCameras);
  for (std::size_t i = 0; i < root[kCameras].size(); ++i)
    result.add(nameIn(root[kCameras][i]), "", [file, shared, i] { return entryOver(file, *shared, i); });
  return result;
}

// cppcheck-suppress constParameter  // what it points to changes
void readAs(Document& file, std::string_view preset) {
  Json& convention = (*file.root)["convention"];
  const std::string name(preset);
  if (!convention.is_null() && readConvention(file).convention != findPreset(name)->convention)
    throw InputError(file.name + ": has another convention than --read-as " + name);
  convention = name;
}

bool CameraSet::mayBePlace(std::string_view text) const {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return isWhole(text) && error == std::errc() && number < size();
}

CameraSet::CameraSet(std::string name, Import import, CameraPatches patches, std::shared_ptr<const Document> file)
    : name_(std::move(name)), patches_(std::move(patches)), file_(std::move(file)), import_(std::move(import)) {
  if (import_.cameras.empty()) throw InputError(name_ + ": holds no " + import_.noun);
  for (std::size_t i = 0; i < size(); ++i) {
    names_[import_.cameras[i].name].push_back(i);
    ids_[import_.cameras[i].id].push_back(i);
    areNumbered_ = areNumbered_ || mayBePlace(import_.cameras[i].name) || mayBePlace(import_.cameras[i].id);
  }
}

CameraSet::CameraSet(const CameraPatches& patches) : CameraSet("the command line", optionsAlone(patches), patches) {
  isTyped_ = true;
}

CameraSet::CameraSet(const std::vector<Picked>& files) : CameraSet(namesOf(files), joinedOf(files), {}) {}

const std::string& CameraSet::fileOf(std::size_t which) const {
  const CameraEntry& camera = import_.cameras[which];
  return camera.set ? camera.set->fileOf(camera.which) : name_;
}

bool CameraSet::mayLackPose(std::size_t which) const {
  const CameraEntry& camera = import_.cameras[which];
  return camera.set ? camera.set->mayLackPose(camera.which) : import_.mayLackPose;
}

std::string CameraSet::nameOf(std::size_t which, const Document& read) const {
  if (import_.cameras[which].set) return nameOf(which);
  const Json* const stated = valueAt(*read.root, "name");
  return stated && stated->is_string() ? stated->get<std::string>() : nameOf(which);
}

std::string CameraSet::pickOf(std::size_t which) const {
  const CameraEntry& camera = import_.cameras[which];
  const std::string number = std::to_string(which);
  const auto isOnly = [](const std::string& text, const auto& named) {
    const auto found = named.find(text);
    return !text.empty() && visible(text) == text && found != named.end() && found->second.size() == 1;
  };
  if (isOnly(camera.name, names_)) return camera.name;
  // Names are preferred to ids, and both to numbers. A number after ## is always a number.
  if (isOnly(camera.id, ids_) && !names_.contains(camera.id)) return camera.id;
  return (areNumbered_ ? "#" : "") + number;
}

std::string CameraSet::othersOf(std::size_t which) const {
  const auto same = ids_.find(import_.cameras[which].id);
  if (same == ids_.end() || same->first.empty()) return "";
  std::vector<std::size_t> others = same->second;
  std::erase(others, which);
  return picksOf(others);
}

std::string CameraSet::picksOf(const std::vector<std::size_t>& cameras) const {
  std::vector<std::string> picks;
  for (const std::size_t camera : cameras) picks.push_back("#" + (picks.size() < kMostNames ? pickOf(camera) : ""));
  return someOf(picks, kMostNames);
}

std::vector<std::size_t> CameraSet::called(std::string_view text) const {
  const std::string name(text);
  for (const auto* const named : {&names_, &ids_})
    if (const auto found = named->find(name); !name.empty() && found != named->end()) return found->second;
  if (areNumbered_ && !text.starts_with('#')) return {};
  const std::string_view digits = text.starts_with('#') ? text.substr(1) : text;
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  const bool isNumber = error == std::errc() && number < size() && std::to_string(number) == digits;
  return isNumber ? std::vector{number} : std::vector<std::size_t>{};
}

std::optional<std::size_t> CameraSet::find(std::string_view name) const {
  const auto found = called(name);
  return found.size() == 1 ? std::optional(found.front()) : std::nullopt;
}

std::vector<std::size_t> CameraSet::all() const {
  std::vector<std::size_t> all(size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

std::size_t CameraSet::choose(const std::optional<std::string>& pick, const std::string& otherwise) const {
  if (!pick) {
    if (size() == 1) return 0;
    const std::string count = std::to_string(size()) + " " + import_.noun + "s; ";
    if (import_.cameras.front().set) throw InputError(name_ + ": hold " + count + "give one of them" + otherwise);
    throw InputError(name_ + ": holds " + count + "pick one after the file's name: " + picksOf(all()) + otherwise);
  }
  const std::vector<std::size_t> found = called(*pick);
  if (found.size() == 1) return found.front();
  if (!found.empty())
    throw InputError(name_ + ": has " + std::to_string(found.size()) + " " + import_.noun + "s called " +
                     inQuotes(*pick) + "; pick one: " + picksOf(found));
  const std::vector<std::size_t> under = chooseAll(pick);
  if (under.size() == 1) return under.front();
  throw InputError(name_ + ": holds " + std::to_string(under.size()) + " " + import_.noun + "s under " +
                   inQuotes(*pick) + "; pick one: " + picksOf(under) + otherwise);
}

std::vector<std::size_t> CameraSet::chooseAll(const std::optional<std::string>& pick) const {
  if (!pick) return all();
  if (!called(*pick).empty()) return {choose(pick)};
  const bool isPattern = pick->find('*') != std::string::npos;
  const std::string pattern = isPattern ? *pick : *pick + (pick->ends_with('/') ? "*" : "/*");
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < size(); ++i)
    if (fitsPattern(import_.cameras[i].name, pattern)) found.push_back(i);
  if (found.empty()) failPick(*pick);
  return found;
}

void CameraSet::failPick(const std::string& pick) const {
  const std::string others = otherWorlds(), longer = "*" + pick;
  const auto fitting = std::count_if(import_.cameras.begin(), import_.cameras.end(), [&](const CameraEntry& camera) {
    return pick.find('*') != std::string::npos && fitsPattern(camera.name, longer);
  });
  throw InputError(name_ + ": has no " + import_.noun + " " + inQuotes(pick) + "; it has " + picksOf(all()) +
                   (areNumbered_ && isWhole(pick) ? "; its names are numbers: ##0 is the first in the file" : "") +
                   (fitting > 0 ? "; " + inQuotes("#" + longer) + " fits " + std::to_string(fitting) : "") +
                   (others.empty() ? "" : "; " + others));
}

std::vector<std::string> CameraSet::notes(const std::optional<std::string>& pick) const {
  std::vector<std::string> notes;
  const auto sets = [&](std::string_view path) {
    return std::any_of(patches_.patches.begin(), patches_.patches.end(),
                       [&](const Patch& patch) { return patch.path.starts_with(path); });
  };
  const bool statesAxes =
      !patches_.readAs.empty() || sets("cameraAxes") || sets("convention.preset") || sets("convention.view") ||
      std::any_of(patches_.patches.begin(), patches_.patches.end(), [](const Patch& patch) {
        return patch.path == "convention" && (patch.value->contains("preset") || patch.value->contains("view"));
      });
  const bool isOfPixels = import_.hasFocalPixels || sets("projection.fx");
  if (import_.lacksAxes && import_.hasRotation && isOfPixels && !statesAxes) notes.push_back(name_ + ": " + kAxesNote);
  if (import_.isTurnedByRpy && !statesAxes)
    notes.push_back(name_ +
                    ": rpy turns the camera's axes right, down, forward; --set cameraAxes=FLU if x is forward, as of a "
                    "robot's camera_link");
  if (import_.hasTranslation) notes.push_back(name_ + ": " + kTranslationNote);
  for (const std::string& each : import_.notes)
    if (!(each == kEnuNote && sets("world")) && !(each == kOpenCvNote && (statesAxes || isOfPixels)))
      notes.push_back(name_ + ": " + each);
  for (const auto& [path, each] : import_.notesUnlessSet)
    if (!sets(path)) notes.push_back(name_ + ": " + each);
  if (const std::vector<std::string>& lost = import_.withoutPose; !lost.empty() && !pick) {
    const std::string what = lost.size() == 1 ? " has no pose, and is left out" : " have no pose, and are left out";
    notes.push_back(name_ + ": " + visible(someOf(lost, kMostNames)) + what);
  }
  if (const std::string others = otherWorlds(); !others.empty())
    notes.push_back(name_ + ": points are in the cameras' own frame; " + others);
  return notes;
}

std::string frameOf(std::string_view world) {
  return world == "imu/" ? "the IMU" : world == "body/" ? "the body" : world == "earth/" ? "the Earth" : "the lidar";
}

std::string CameraSet::otherWorlds() const {
  std::string text;
  for (const std::string& world : import_.worlds)
    text += (text.empty() ? "" : ", ") + ("for points in the frame of " + frameOf(world)) + " pick #" + world + "*";
  return text;
}

/// Where cx, cy are the file's, and where they count from is not.
void CameraSet::noteCounting(Document& document) const {
  const auto patched = [&](std::string_view path) {
    const auto patch = std::find_if(patches_.patches.begin(), patches_.patches.end(),
                                    [&](const Patch& each) { return each.path == path; });
    return patch == patches_.patches.end() ? nullptr : &*patch;
  };
  constexpr const char* kCounting[] = {"viewport.pixelCenter", "viewport.origin", "viewport.x", "viewport.y"};
  if (std::none_of(std::begin(kCounting), std::end(kCounting), patched)) return;
  const auto number = [&](std::string_view path) -> std::optional<double> {
    const Patch* const patch = patched(path);
    const Json* const value = patch ? patch->value.get() : valueAt(*document.root, path);
    return value && value->is_number() ? std::optional(value->get<double>()) : std::nullopt;
  };
  const auto stated = [&](std::string_view path, double otherwise) {
    const Json* const value = valueAt(*document.root, path);
    return value && value->is_number() ? value->get<double>() : otherwise;
  };
  const Json* const statedOrigin = valueAt(*document.root, "viewport.origin");
  const Json* const pixels = valueAt(*document.root, "projection.pixels");
  const bool hasPixels =
      pixels && pixels->is_array() && pixels->size() == 2 && (*pixels)[0].is_number() && (*pixels)[1].is_number();
  const double first = stated("viewport.pixelCenter", readConvention(document).preset->pixelCenter);
  const Patch* const origin = patched("viewport.origin");
  const bool isTurned = origin && *origin->value != (statedOrigin ? *statedOrigin : Json("top-left"));
  const double centred = number("viewport.pixelCenter").value_or(first) - first;
  // In the pixels that cx and cy count.
  const auto keep = [&](const std::string& axis, const std::string& corner, const char* side, std::size_t i) {
    const auto place = number("projection." + axis), shown = number(side);
    if (!place || patched("projection." + axis)) return std::string();
    const auto counted = hasPixels ? std::optional((*pixels)[i].get<double>()) : shown;
    const bool turns = isTurned && i == 1;
    const double from = stated(corner, 0), to = number(corner).value_or(0);
    if (centred == 0 && to == from && !turns) return std::string();
    if (!counted && (turns || to != from))
      return " --" + axis + " " + (turns ? "from the other edge" : "in its pixels");
    const double scale = counted ? *counted / shown.value_or(*counted) : 1, within = *place - from * scale;
    return " --" + axis + " " +
           formatNumber((turns ? *counted - 1 + 2 * first - within : within) + to * scale + centred);
  };
  const std::string kept =
      keep("cx", "viewport.x", "viewport.width", 0) + keep("cy", "viewport.y", "viewport.height", 1);
  if (kept.empty()) return;
  std::string labels;
  for (const char* path : kCounting)
    if (const Patch* const patch = patched(path)) labels += (labels.empty() ? "" : ", ") + patch->label;
  document.notes.push_back(name_ + ": " + labels +
                           (size() > 1 ? ": cx and cy of its cameras stay, and so their pictures move"
                                       : ": its cx and cy stay, and so its picture moves;" + kept +
                                             " beside it counts pixels so and moves nothing"));
}

Document CameraSet::document(std::size_t which) const {
  if (const CameraEntry& camera = import_.cameras[which]; camera.set) return camera.set->document(camera.which);
  Document document{name_ + (size() > 1 ? "#" + pickOf(which) : ""), std::make_shared<Json>(), isTyped_};
  {
    const std::lock_guard lock(importing_);
    *document.root = import_.cameras[which].document();
  }
  for (const auto& [path, name] : import_.ownNames) document.labels.emplace(path, document.name + ": " + name);
  normalize(document);
  if (patches_.resize) resizePicture(document, *patches_.resize);
  noteCounting(document);
  applyPatches(document, patches_.patches);
  if (patches_.otherwise && !valueAt(*document.root, "viewport.width") && !valueAt(*document.root, "projection.pixels"))
    (*document.root)["viewport"].update(
        {{"width", patches_.otherwise->front()}, {"height", patches_.otherwise->back()}});
  return document;
}

}  // namespace viewproj::cmd
