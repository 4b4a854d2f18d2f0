#include "input/document.hpp"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "input/camera_fields.hpp"
#include "input/importers/colmap.hpp"
#include "input/importers/glb.hpp"
#include "input/value_form.hpp"
#include "text/encoding.hpp"
#include "text/error.hpp"
#include "text/file.hpp"
#include "text/json_text.hpp"
#include "text/names.hpp"
#include "text/system.hpp"
#include "text/visible.hpp"
#include "text/yaml_text.hpp"

namespace viewproj::cmd {
namespace {

constexpr std::size_t kMostBytes = 64 << 20;

std::string shown(const nlohmann::json& value) {
  // A list has as many such messages as cameras, which may share a text.
  constexpr std::size_t kLongest = 200;
  if (value.is_string() && value.get_ref<const std::string&>().size() > kLongest)
    return " (is " + inQuotes(value.get_ref<const std::string&>(), kLongest) + ")";
  if (value.is_string() || value.is_number() || value.is_boolean()) return " (is " + value.dump() + ")";
  return "";
}

/// An array or object of the text nested deeper than this is refused before it is parsed.
constexpr std::size_t kDeepest = 200;

std::optional<std::size_t> tooDeepAt(std::string_view text) {
  std::size_t depth = 0;
  bool inString = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (inString) {
      if (c == '\\') ++i;
      if (c == '"') inString = false;
    } else if (c == '"') {
      inString = true;
    } else if (c == '{' || c == '[') {
      if (++depth > kDeepest) return i;
    } else if ((c == '}' || c == ']') && depth > 0) {
      --depth;
    }
  }
  return std::nullopt;
}

/// What else to do about JSON that is wrong there: of records, and of a far that is too large.
std::string_view hintOn(std::string_view text, std::size_t number) {
  if (number < text.size() && text[number] == '{' && text.substr(0, number).find_last_not_of(" \t\r\n") != text.npos &&
      text[text.substr(0, number).find_last_not_of(" \t\r\n")] == '}')
    return "; lines of JSON are records, which are read by commands that take them as FILE";
  const std::size_t end = text.find_last_not_of(" \t\r\n", number == 0 ? 0 : number - 1);
  return end != std::string_view::npos && text.substr(0, end + 1).ends_with("\"far\":") ? field::zFar.hint : "";
}

}  // namespace

std::string dotted(const Path& path) {
  std::string text;
  for (const std::string& step : path) text += (text.empty() ? "" : ".") + step;
  return text;
}

Path undotted(std::string_view path) {
  Path steps;
  for (std::size_t at = 0; at <= path.size();) {
    const std::size_t dot = std::min(path.find('.', at), path.size());
    steps.emplace_back(path.substr(at, dot - at));
    at = dot + 1;
  }
  return steps;
}

Document::Document(const std::string& source, const std::string& option, const char* arrayKey) {
  const std::size_t first = source.find_first_not_of(" \t\r\n");
  if (first != std::string::npos && (source[first] == '{' || (arrayKey && source[first] == '['))) {
    name_ = option;
    text_ = source;
  } else {
    std::error_code ignored;
    if (first != std::string::npos && source[first] == '[' && !std::filesystem::exists(pathOf(source), ignored))
      throw InputError(option + ": JSON on the command line must begin with '{', and there is no file of this name");
    name_ = source == "-" ? kStandardInputName : visible(source);
    const bool isCamera = arrayKey && !*arrayKey;
    // An images.txt may be longer than what is read of other files.
    if (isCamera && isColmapFile(source)) {
      ColmapText colmap = readColmap(source);
      root_ = std::move(colmap.root);
      places_ = std::move(colmap.places);
      return;
    }
    text_ = readJsonFile(source, kMostBytes);
    requireNarrow(name_, text_);
  }
  if (text_.starts_with("\xEF\xBB\xBF")) text_.erase(0, 3);
  readText();
  isArray_ = arrayKey && root_->is_array();
  if (isArray_) *root_ = nlohmann::json::object({{arrayKey, std::move(*root_)}});
  if (!root_->is_object()) throw InputError(place(name_, {}) + ": expected a JSON object");
}

void Document::readText() {
  root_ = std::make_unique<nlohmann::json>();
  const std::size_t first = text_.find_first_not_of(" \t\r\n");
  const char begin = first == std::string::npos ? '\0' : text_[first];
  const bool isJson = begin == '{' || begin == '[';
  isYaml_ = !isJson && begin != '/' && looksLikeYaml(text_);
  if (isYaml_) {
    if (const auto fault = parseYaml(text_, kDeepest, *root_))
      throw InputError(place(name_, positionAt(text_, fault->offset)) + ": " + visible(fault->message));
    return;
  }
  blankComments(text_);
  if (const auto at = tooDeepAt(text_))
    throw InputError(place(name_, positionAt(text_, *at)) + ": nested deeper than " + std::to_string(kDeepest));
  const std::size_t start = text_.find_first_not_of(" \t\r\n");
  if (start == std::string::npos) throw InputError(name_ + ": is empty; expected JSON");
  if (auto fault = parseJson(text_, *root_)) {
    if (text_[start] != '{' && text_[start] != '[')
      throw InputError(name_ +
                       ": is neither JSON nor YAML; viewproj help formats lists the files that are read; records, as "
                       "of points, are read by commands that take them as FILE");
    // As other programs write and read it.
    const std::size_t before = text_.find_last_not_of(" \t\r\n", fault->offset == 0 ? 0 : fault->offset - 1);
    if (fault->offset < text_.size() && (text_[fault->offset] == ']' || text_[fault->offset] == '}') &&
        before != std::string::npos && text_[before] == ',')
      fault =
          JsonFault{before, std::string("a comma before ") + text_[fault->offset] + " is not valid JSON; leave it out"};
    throw InputError(place(name_, positionAt(text_, fault->offset)) + ": " + visible(fault->message) +
                     std::string(hintOn(text_, fault->offset)));
  }
}

Document::Document(Typed, const std::string& name)
    : name_(name), text_("{}"), root_(std::make_unique<nlohmann::json>(nlohmann::json::object())), isTyped_(true) {}

Document::~Document() = default;

Assignment readAssignment(const std::string& typed) {
  const std::size_t equals = typed.find('=');
  if (equals == std::string::npos || equals == 0)
    throw UsageError("--set " + typed + ": expected FIELD=VALUE, as in projection.fovY=75");
  const Path path = undotted(typed.substr(0, equals));
  const std::string text = typed.substr(equals + 1);
  nlohmann::json value;
  if (jsonFault(text)) {
    value = text;
  } else {
    if (tooDeepAt(text))
      throw UsageError("--set " + dotted(path) + ": the value is nested deeper than " + std::to_string(kDeepest));
    if (const auto fault = parseJson(text, value))
      throw UsageError("--set " + dotted(path) + ": " + visible(fault->message));
  }
  if (value.is_string() && !isUtf8(text)) throw UsageError("--set " + dotted(path) + ": the value is not UTF-8");
  return {path, typed, std::make_shared<const nlohmann::json>(std::move(value))};
}

void Document::set(const Assignment& assignment) {
  Path path = assignment.path;
  const bool isEntry = std::all_of(path[0].begin(), path[0].end(), [](char c) { return c >= '0' && c <= '9'; });
  if (isArray_ && isEntry && root_->contains("")) path.insert(path.begin(), "");
  setPaths_.push_back(path);
  const std::string& typed = assignment.text;
  const nlohmann::json& value = *assignment.value;
  nlohmann::json* at = root_.get();
  const auto element = [&](const std::string& step) {
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(step.data(), step.data() + step.size(), index);
    if (error != std::errc() || end != step.data() + step.size() || index >= at->size())
      throw UsageError("--set " + typed + ": there is no element " + step + " of " + std::to_string(at->size()));
    return index;
  };
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    if (at->is_array()) {
      at = &(*at)[element(path[i])];
      continue;
    }
    if (value.is_null() && !at->contains(path[i])) {
      unread_.insert(dotted(path));
      return;
    }
    nlohmann::json& next = (*at)[path[i]];
    if (path[i] == "convention" && next.is_string()) next = {{"preset", next}};
    if (next.is_null()) next = nlohmann::json::object();
    if (!next.is_structured()) throw UsageError("--set " + typed + ": " + path[i] + " is not an object");
    at = &next;
  }
  if (at->is_array())
    (*at)[element(path.back())] = value;
  else if (!at->is_object())
    throw UsageError("--set " + typed + ": " + path[path.size() - 2] + " is not an object");
  else if (value.is_null() && at->erase(path.back()) > 0)
    return (void)set_.insert(dotted(path));  // which is all that it asks for
  else if (!value.is_null())
    (*at)[path.back()] = value;
  set_.insert(dotted(path));
  unread_.insert(dotted(path));
}

void Document::give(const Path& path, nlohmann::json value, const std::string& option) {
  nlohmann::json* at = root_.get();
  for (const std::string& step : path) at = &(*at)[step];
  *at = std::move(value);
  if (!option.empty()) label(path, option);
}

void Document::drop(const Path& path) {
  nlohmann::json* at = root_.get();
  for (std::size_t i = 0; i + 1 < path.size(); ++i) at = &(*at)[path[i]];
  at->erase(path.back());
}

void Document::label(const Path& path, const std::string& option) { options_[dotted(path)] = option; }

void Document::noteRead(const Path& path, bool andBelow) const {
  if (countsNoReads_) return;
  const std::string name = dotted(path);
  unread_.erase(name);
  if (andBelow) unread_.erase(unread_.lower_bound(name + '.'), unread_.lower_bound(name + char('.' + 1)));
}

bool Document::isSet(const std::string& field) const {
  const auto within = set_.lower_bound(field + ".");
  return set_.count(field) > 0 || (within != set_.end() && within->starts_with(field + "."));
}

namespace {

/// What a step's number says, as it is written without zeros in front.
std::optional<std::size_t> indexIn(const std::string& step) {
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(step.data(), step.data() + step.size(), index);
  if (error != std::errc() || std::to_string(index) != step) return std::nullopt;
  return index;
}

}  // namespace

const nlohmann::json* Document::at(const Path& path) const {
  const nlohmann::json* value = root_.get();
  for (const std::string& step : path) {
    const nlohmann::json* next = nullptr;
    if (value->is_object() && value->contains(step)) next = &value->at(step);
    if (value->is_array())
      if (const auto index = indexIn(step); index && *index < value->size()) next = &value->at(*index);
    if (!next) return nullptr;
    value = next;
  }
  return value;
}

void Document::tryOut(const Path& path, nlohmann::json value, const std::function<void()>& look) {
  auto* const place = const_cast<nlohmann::json*>(at(path));  // NOLINT(cppcoreguidelines-pro-type-const-cast)
  const std::size_t kept = notes_.size(), noted = noted_;
  std::swap(*place, value);
  look();
  std::swap(*place, value);
  notes_.resize(kept);
  noted_ = noted;
}

void Document::requireSetsRead(const std::string& form) const {
  if (!unread_.empty()) throw InputError("--set " + *unread_.begin() + ": is no field that is read of " + form);
}

void Document::fail(const Path& path, const std::string& message, bool showValue) const {
  const nlohmann::json* const value = at(path);
  const std::string text = placed(path, message + (value && showValue ? shown(*value) : ""));
  if (isTyped_) throw UsageError(text);
  throw InputError(text);
}

std::string Document::placed(const Path& path, const std::string& message) const {
  const std::string what = visible((path.empty() ? "" : dotted(path) + ": ") + message);
  if (set_.count(dotted(path))) return "--set " + what;
  for (Path given = path, rest; !given.empty(); given.pop_back()) {
    if (const auto option = options_.find(dotted(given)); option != options_.end())
      return option->second + ": " + visible((rest.empty() ? "" : dotted(rest) + ": ") + message);
    rest.insert(rest.begin(), given.back());
  }
  if (isTyped_) {
    const bool isPart = path.empty() || path.back() == "projection";  // whose fields are told by their options
    return name_ + ": " + visible((isPart ? "" : path.back() + ": ") + message);
  }
  if (leavesPlacesOut_) return what;
  if (path.size() >= 2)
    if (const auto at = places_.find(path[0] + "\n" + path[1]); at != places_.end()) return at->second + ": " + what;
  if (isYaml_) return name_ + ": " + what;
  const std::span<const std::string> inText = std::span(path).subspan(isArray_ && !path.empty() ? 1 : 0);
  return place(name_, positionAt(text_, locate(text_, inText))) + ": " + what;
}

void Document::note(const Path& path, const std::string& message) const {
  std::optional<Meanwhile> without;
  if (noted_++ >= kMostPlaced) without.emplace(leavesPlacesOut_);
  notes_.push_back((leavesPlacesOut_ ? name_ + ": " : "") + placed(path, message));
}

}  // namespace viewproj::cmd
