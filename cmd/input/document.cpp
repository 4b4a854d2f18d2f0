#include "input/document.hpp"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "input/importers/glb.hpp"
#include "text/encoding.hpp"
#include "text/error.hpp"
#include "text/file.hpp"
#include "text/json_text.hpp"
#include "text/names.hpp"
#include "text/visible.hpp"

namespace viewproj::cmd {
namespace {

constexpr std::size_t kMostBytes = 64 << 20;

std::string shown(const nlohmann::json& value) {
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
    if (first != std::string::npos && source[first] == '[' && !std::filesystem::exists(source, ignored))
      throw InputError(option + ": JSON on the command line must begin with '{', and there is no file of this name");
    name_ = source == "-" ? kStandardInputName : visible(source);
    text_ = readJsonFile(source, kMostBytes);
    requireNarrow(name_, text_);
  }
  if (text_.starts_with("\xEF\xBB\xBF")) text_.erase(0, 3);
  if (const auto at = tooDeepAt(text_))
    throw InputError(place(name_, positionAt(text_, *at)) + ": nested deeper than " + std::to_string(kDeepest));
  root_ = std::make_unique<nlohmann::json>();
  if (const auto fault = parseJson(text_, *root_))
    throw InputError(place(name_, positionAt(text_, fault->offset)) + ": " + visible(fault->message));
  if (arrayKey && root_->is_array()) *root_ = {{arrayKey, std::move(*root_)}};
  if (!root_->is_object()) throw InputError(place(name_, {}) + ": expected a JSON object");
}

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
  const Path& path = assignment.path;
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
  else if (value.is_null())
    at->erase(path.back());
  else
    (*at)[path.back()] = value;
  set_.insert(dotted(path));
  unread_.insert(dotted(path));
}

void Document::noteRead(const Path& path, bool andBelow) const {
  const std::string name = dotted(path);
  unread_.erase(name);
  if (andBelow) unread_.erase(unread_.lower_bound(name + '.'), unread_.lower_bound(name + char('.' + 1)));
}

bool Document::isSet(const std::string& field) const {
  const auto within = set_.lower_bound(field + ".");
  return set_.count(field) > 0 || (within != set_.end() && within->starts_with(field + "."));
}

void Document::requireSetsRead(const std::string& form) const {
  if (!unread_.empty()) throw InputError("--set " + *unread_.begin() + ": is no field that is read of " + form);
}

void Document::fail(const Path& path, const std::string& message, bool showValue) const {
  const nlohmann::json* value = root_.get();
  for (const std::string& step : path) {
    const nlohmann::json* next = nullptr;
    if (value->is_object() && value->contains(step)) next = &value->at(step);
    if (value->is_array())
      for (std::size_t i = 0; i < value->size() && !next; ++i)
        if (std::to_string(i) == step) next = &value->at(i);
    value = next;
    if (!value) break;
  }
  throw InputError(placed(path, message + (value && showValue ? shown(*value) : "")));
}

std::string Document::placed(const Path& path, const std::string& message) const {
  const std::string what = visible((path.empty() ? "" : dotted(path) + ": ") + message);
  if (set_.count(dotted(path))) return "--set " + what;
  return place(name_, positionAt(text_, locate(text_, path))) + ": " + what;
}

void Document::note(const Path& path, const std::string& message) const { notes_.push_back(placed(path, message)); }

ObjectReader::ObjectReader(const Document& document, const nlohmann::json& object, Path path)
    : document_(&document), object_(&object), path_(std::move(path)) {
  if (!object.is_object()) document.fail(path_, "expected an object");
}

Path ObjectReader::pathOf(std::string_view key) const {
  Path path = path_;
  path.emplace_back(key);
  return path;
}

void ObjectReader::fail(std::string_view key, const std::string& message) const {
  document_->fail(pathOf(key), message);
}

void ObjectReader::fail(const std::string& message) const { document_->fail(path_, message); }

const nlohmann::json* ObjectReader::find(std::string_view key) const {
  const auto found = object_->find(key);
  if (found == object_->end() || found->is_null()) {
    if (!document_->isAllRead()) document_->noteRead(pathOf(key), true);
    return nullptr;
  }
  if (document_->isAllRead()) return &*found;
  // The objects within are read on their own.
  const bool hasObjects = found->is_object() || (found->is_array() && !found->empty() && found->front().is_object());
  document_->noteRead(pathOf(key), !hasObjects);
  return &*found;
}

bool ObjectReader::has(std::string_view key) const { return find(key) != nullptr; }

bool ObjectReader::isString(std::string_view key) const {
  const nlohmann::json* value = find(key);
  return value && value->is_string();
}

bool ObjectReader::isObject(std::string_view key) const {
  const nlohmann::json* value = find(key);
  return value && value->is_object();
}

std::optional<double> ObjectReader::number(std::string_view key) const {
  const nlohmann::json* value = find(key);
  if (!value) return std::nullopt;
  if (!value->is_number()) fail(key, "expected a number");
  return value->get<double>();
}

double ObjectReader::requireNumber(std::string_view key) const {
  const auto value = number(key);
  if (!value) fail("needs " + std::string(key));
  return *value;
}

std::optional<bool> ObjectReader::flag(std::string_view key) const {
  const nlohmann::json* value = find(key);
  if (!value) return std::nullopt;
  if (!value->is_boolean()) fail(key, "expected true or false");
  return value->get<bool>();
}

std::optional<std::string> ObjectReader::string(std::string_view key) const {
  if (const auto found = text(key)) return std::string(*found);
  return std::nullopt;
}

std::optional<std::string_view> ObjectReader::text(std::string_view key) const {
  const nlohmann::json* value = find(key);
  if (!value) return std::nullopt;
  if (!value->is_string()) fail(key, "expected a string");
  return value->get_ref<const std::string&>();
}

std::optional<std::vector<double>> ObjectReader::numbers(std::string_view key, std::size_t fewest,
                                                         std::size_t most) const {
  const nlohmann::json* value = find(key);
  if (!value) return std::nullopt;
  const bool good = value->is_array() && value->size() >= fewest && value->size() <= most &&
                    std::all_of(value->begin(), value->end(), [](const auto& v) { return v.is_number(); });
  if (!good)
    fail(key, "expected " +
                  (fewest == most ? std::to_string(fewest) : std::to_string(fewest) + " to " + std::to_string(most)) +
                  " numbers in an array");
  return value->get<std::vector<double>>();
}

std::optional<Vec3> ObjectReader::vec3(std::string_view key) const {
  const auto v = numbers(key, 3, 3);
  if (!v) return std::nullopt;
  return Vec3{(*v)[0], (*v)[1], (*v)[2]};
}

std::optional<Mat4> ObjectReader::mat4(std::string_view key) const {
  const nlohmann::json* value = find(key);
  if (!value) return std::nullopt;
  Mat4 matrix;
  bool good = value->is_array() && value->size() == 4;
  for (std::size_t i = 0; good && i < 4; ++i) {
    good = (*value)[i].is_array() && (*value)[i].size() == 4;
    for (std::size_t j = 0; good && j < 4; ++j) {
      good = (*value)[i][j].is_number();
      if (good) matrix[i][j] = (*value)[i][j].get<double>();
    }
  }
  if (!good) fail(key, "expected 4 rows of 4 numbers");
  return matrix;
}

std::optional<std::string> ObjectReader::label(std::string_view key) const {
  const nlohmann::json* value = find(key);
  if (!value) return std::nullopt;
  if (!value->is_string() && !value->is_number()) fail(key, "expected a string or a number");
  return value->dump();
}

std::optional<std::vector<Vec3>> ObjectReader::vec3s(std::string_view key, std::size_t count) const {
  const nlohmann::json* value = find(key);
  if (!value) return std::nullopt;
  std::vector<Vec3> vectors;
  for (const auto& item : *value) {
    const bool good = item.is_array() && item.size() == 3 &&
                      std::all_of(item.begin(), item.end(), [](const auto& v) { return v.is_number(); });
    if (!good) break;
    vectors.push_back({item[0].get<double>(), item[1].get<double>(), item[2].get<double>()});
  }
  if (!value->is_array() || vectors.size() != count || value->size() != count)
    fail(key, "expected " + std::to_string(count) + " points [x, y, z]");
  return vectors;
}

std::optional<ObjectReader> ObjectReader::object(std::string_view key) const {
  const nlohmann::json* value = find(key);
  if (!value) return std::nullopt;
  return ObjectReader(*document_, *value, pathOf(key));
}

ObjectList ObjectReader::objects(std::string_view key) const {
  const nlohmann::json* value = find(key);
  if (!value) return {};
  if (!value->is_array()) fail(key, "expected an array of objects");
  return {*document_, *value, pathOf(key)};
}

ObjectList::ObjectList(const Document& document, const nlohmann::json& array, Path path)
    : document_(&document), array_(&array), path_(std::move(path)) {
  for (std::size_t i = 0; i < array.size(); ++i) {
    if (!document.isAllRead()) document.noteRead(pathOf(i), false);
    if (!array[i].is_object()) (void)(*this)[i];  // throws
  }
}

std::size_t ObjectList::size() const { return array_ ? array_->size() : 0; }

ObjectReader ObjectList::operator[](std::size_t index) const { return {*document_, (*array_)[index], pathOf(index)}; }

Path ObjectList::pathOf(std::size_t index) const {
  Path path = path_;
  path.push_back(std::to_string(index));
  return path;
}

namespace {

std::optional<std::size_t> indexBelow(const nlohmann::json& value, std::size_t count) {
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() >= count) return std::nullopt;
  return value.get<std::size_t>();
}

std::string expectedIndex(std::size_t count, const char* what) {
  return "expected a whole number below " + std::to_string(count) + ", the number of " + what;
}

}  // namespace

std::optional<std::size_t> ObjectReader::index(std::string_view key, std::size_t count, const char* what) const {
  const nlohmann::json* value = find(key);
  if (!value) return std::nullopt;
  const auto number = indexBelow(*value, count);
  if (!number) fail(key, expectedIndex(count, what));
  return number;
}

std::vector<std::size_t> ObjectReader::indices(std::string_view key, std::size_t count, const char* what) const {
  const nlohmann::json* value = find(key);
  if (!value) return {};
  if (!value->is_array()) fail(key, "expected an array of numbers");
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < value->size(); ++i) {
    const auto number = indexBelow((*value)[i], count);
    if (!number) {
      Path path = pathOf(key);
      path.push_back(std::to_string(i));
      document_->fail(path, expectedIndex(count, what));
    }
    result.push_back(*number);
  }
  return result;
}

void ObjectReader::allow(const ObjectForm& form) const {
  for (const auto& item : object_->items())
    if (!form.has(item.key()))
      document_->fail(pathOf(item.key()), "is not a known field here" + suggestion(item.key(), namesOf(form.fields)),
                      false);
}

const Way* ObjectReader::way(const ObjectForm& form) const {
  const ChosenWay chosen = chooseWay(form, [&](const Field& field) { return has(field); });
  if (chosen.fault.empty()) return chosen.way;
  if (chosen.at) fail(*chosen.at, chosen.fault);
  fail(chosen.fault);
}

void ObjectReader::failChoice(std::string_view key, const std::string& name,
                              const std::vector<std::string_view>& known) const {
  fail(key, "is none of the known names" + suggestion(name, known));
}

}  // namespace viewproj::cmd
