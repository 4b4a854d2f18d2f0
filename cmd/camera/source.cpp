#include "camera/source.hpp"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numeric>

#include "camera/check.hpp"
#include "text/error.hpp"
#include "text/names.hpp"
#include "text/system.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {

bool isCameraDocument(const Json& root) {
  const auto has = [&](const Field& field) {
    if (field.path == "name" || field.path == "$schema") return false;
    const std::vector<std::string_view> names = namesOf(field);
    return std::any_of(names.begin(), names.end(), [&](std::string_view name) { return root.contains(name); });
  };
  return root.is_object() &&
         (root.empty() || root.contains("projection") || std::any_of(std::begin(kFields), std::end(kFields), has));
}

Import openCameraDocument(const Document& file) {
  const Json& root = *file.root;
  const auto name = root.find("name");
  return {{{name != root.end() && name->is_string() ? name->get<std::string>() : "", ""}},
          [root = file.root](std::size_t) { return *root; }};
}

// cppcheck-suppress constParameter  // the document is changed
void readAs(Document& file, const std::string& preset) {
  Json& convention = (*file.root)["convention"];
  if (!convention.is_null() && convention != preset && convention != Json{{"preset", preset}})
    throw InputError(file.name + ": has another convention than --read-as " + preset);
  convention = preset;
}

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

CameraDocuments::CameraDocuments(std::string name, Import cameras, CameraPatches patches)
    : name_(std::move(name)), patches_(std::move(patches)), import_(std::move(cameras)) {
  if (import_.cameras.empty()) throw InputError(name_ + ": holds no camera");
  countNames();
}

CameraDocuments::CameraDocuments(CameraPatches patches)
    : name_("the command line"), isTyped_(true), patches_(std::move(patches)) {
  Document typed{name_, std::make_shared<Json>(Json::object()), true};
  if (!patches_.readAs.empty()) (*typed.root)["convention"] = patches_.readAs;
  import_ = openCameraDocument(typed);
}

void CameraDocuments::countNames() {
  for (const CameraEntry& camera : import_.cameras) {
    ++names_[camera.name];
    ++ids_[camera.id];
  }
}

std::string CameraDocuments::pickOf(std::size_t which) const {
  const CameraEntry& camera = import_.cameras[which];
  const std::string number = std::to_string(which);
  const auto isOnly = [](const std::string& text, const auto& counts) {
    const auto found = counts.find(text);
    return !text.empty() && visible(text) == text && found != counts.end() && found->second == 1;
  };
  if (isOnly(camera.name, names_)) return camera.name;
  // Names are preferred to ids, and both to numbers. A number after ## is always a number.
  if (isOnly(camera.id, ids_) && !names_.contains(camera.id)) return camera.id;
  return (names_.contains(number) || ids_.contains(number) ? "#" : "") + number;
}

std::string CameraDocuments::someOf(const std::vector<std::size_t>& cameras) const {
  constexpr std::size_t kMost = 8;
  std::string text;
  for (std::size_t i = 0; i < std::min(cameras.size(), kMost); ++i) text += (i == 0 ? "#" : ", #") + pickOf(cameras[i]);
  return cameras.size() <= kMost ? text : text + " and " + std::to_string(cameras.size() - kMost) + " more";
}

std::size_t CameraDocuments::choose(const std::optional<std::string>& pick) const {
  const auto& cameras = import_.cameras;
  std::vector<std::size_t> all(cameras.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  if (!pick) {
    if (cameras.size() == 1) return 0;
    throw InputError(name_ + ": holds " + std::to_string(cameras.size()) +
                     " cameras; pick one after the file's name: " + someOf(all));
  }
  const auto number = [](std::size_t i) { return std::to_string(i); };
  for (const auto& nameOf : {std::function<std::string(std::size_t)>([&](std::size_t i) { return cameras[i].name; }),
                             {[&](std::size_t i) { return cameras[i].id; }},
                             {number}}) {
    std::vector<std::size_t> found;
    std::copy_if(all.begin(), all.end(), std::back_inserter(found),
                 [&](std::size_t i) { return !pick->empty() && nameOf(i) == *pick; });
    if (found.size() == 1) return found.front();
    if (!found.empty())
      throw InputError(name_ + ": has " + std::to_string(found.size()) + " cameras called " + inQuotes(*pick) +
                       "; pick one by its number: " + someOf(found));
  }
  for (const std::size_t i : all)
    if ("#" + number(i) == *pick) return i;
  throw InputError(name_ + ": has no camera " + inQuotes(*pick) + "; it has " + someOf(all));
}

Document CameraDocuments::document(std::size_t which) const {
  Document document{name_ + (size() > 1 ? "#" + pickOf(which) : ""), std::make_shared<Json>(import_.document(which)),
                    isTyped_};
  normalize(document);
  lay(document, patches_.patches);
  return document;
}

}  // namespace viewproj::cmd
