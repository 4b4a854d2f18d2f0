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
namespace {

/// The importer for a document. Null for our own format (an object with a projection object) and for unknown formats.
const Importer* importerOf(const Json& root) {
  const auto projection = root.find("projection");
  if (root.is_object() && projection != root.end() && projection->is_object()) return nullptr;
  for (const Importer* importer : importers())
    if (importer->recognises(root)) return importer;
  return nullptr;
}

Import nativeCamera(const Document& file) {
  const Json& root = *file.root;
  // What says nothing of a camera; --read-as states a convention.
  const auto isBeside = [](std::string_view name) {
    return name == "name" || name == "$schema" || name == "convention";
  };
  const auto has = [&](const Field& field) {
    if (isBeside(field.path.substr(0, field.path.find('.')))) return false;
    const std::vector<std::string_view> names = namesOf(field);
    return std::any_of(names.begin(), names.end(), [&](std::string_view name) { return root.contains(name); });
  };
  const auto isStranger = [&](const auto& member) { return !isBeside(member.key()); };
  const auto members = root.items();
  if (!root.is_object() || (std::any_of(members.begin(), members.end(), isStranger) && !root.contains("projection") &&
                            std::none_of(std::begin(kFields), std::end(kFields), has)))
    throw UnknownFormat(file.name + ": is not a camera file of a known kind; viewproj help formats lists them",
                        file.text ? *file.text : "");
  const auto name = root.find("name");
  return {{{name != root.end() && name->is_string() ? name->get<std::string>() : "", ""}},
          [&file](std::size_t) { return *file.root; }};
}

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

CameraDocuments::CameraDocuments(Document file, CameraPatches patches)
    : file_(std::move(file)), patches_(std::move(patches)) {
  const Importer* const importer = importerOf(*file_.root);
  if (const std::string& readAs = patches_.readAs; !readAs.empty() && importer && importer != &kMatrices) {
    throw InputError(file_.name + ": is " + std::string(importer->form) +
                     ", which has a convention of its own; leave out --read-as");
  } else if (!readAs.empty() && file_.root->is_object()) {
    Json& convention = (*file_.root)["convention"];
    if (!convention.is_null() && convention != readAs && convention != Json{{"preset", readAs}})
      throw InputError(file_.name + ": has another convention than --read-as " + readAs);
    convention = readAs;
  }
  import_ = importer ? importer->open(Node(file_)) : nativeCamera(file_);
  if (import_.cameras.empty()) throw InputError(file_.name + ": holds no camera");
  countNames();
}

CameraDocuments::CameraDocuments(CameraPatches patches)
    : file_{"the command line", std::make_shared<Json>(Json::object()), true}, patches_(std::move(patches)) {
  if (!patches_.readAs.empty()) (*file_.root)["convention"] = patches_.readAs;
  import_ = nativeCamera(file_);
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
    throw InputError(file_.name + ": holds " + std::to_string(cameras.size()) +
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
      throw InputError(file_.name + ": has " + std::to_string(found.size()) + " cameras called " + inQuotes(*pick) +
                       "; pick one by its number: " + someOf(found));
  }
  for (const std::size_t i : all)
    if ("#" + number(i) == *pick) return i;
  throw InputError(file_.name + ": has no camera " + inQuotes(*pick) + "; it has " + someOf(all));
}

bool CameraDocuments::areMatrices() const { return importerOf(*file_.root) == &kMatrices; }

Document CameraDocuments::document(std::size_t which) const {
  Document document{file_.name + (size() > 1 ? "#" + pickOf(which) : ""),
                    std::make_shared<Json>(import_.document(which)), file_.isTyped};
  normalize(document);
  lay(document, patches_.patches);
  return document;
}

}  // namespace viewproj::cmd
