#include "camera/document.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "camera/fields.hpp"
#include "text/error.hpp"
#include "text/file.hpp"
#include "text/json_text.hpp"
#include "text/number.hpp"
#include "text/system.hpp"
#include "text/utf8.hpp"
#include "text/yaml_text.hpp"

namespace viewproj::cmd {
namespace {

Json parsed(const std::string& name, std::string text) {
  const auto fail = [&](std::size_t offset, const std::string& message) {
    throw InputError(place(name, positionAt(text, offset)) + ": " + visible(message));
  };
  Json root;
  text.erase(0, text.size() - withoutByteOrderMark(text).size());
  const std::size_t start = text.find_first_not_of(" \t\r\n");
  if (start == std::string::npos) throw InputError(name + ": is empty; expected JSON");
  if (text[start] != '{' && text[start] != '[' && looksLikeYaml(text)) {
    if (const auto fault = parseYaml(text, kDeepestJson, root)) fail(fault->offset, fault->message);
    return root;
  }
  blankComments(text);
  if (const auto fault = parseJson(text, root)) {
    if (text[start] != '{' && text[start] != '[')
      throw InputError(name + ": is neither JSON nor YAML, as camera files are; viewproj help formats lists them");
    fail(fault->offset, fault->message);
  }
  return root;
}

/// Appends a number, or the numbers of rows of equal length. False if there is anything else.
bool flatten(const Json& value, std::vector<double>& numbers) {
  if (value.is_number()) {
    numbers.push_back(value.get<double>());
    return true;
  }
  if (value.is_array()) {
    const auto isAlike = [&](const Json& part) {
      return part.is_array() == value.front().is_array() && part.size() == value.front().size();
    };
    return std::all_of(value.begin(), value.end(),
                       [&](const Json& part) { return isAlike(part) && flatten(part, numbers); });
  }
  if (!value.is_object()) return false;
  if (const auto data = value.find("data"); data != value.end()) {
    const auto rows = value.find("rows"), cols = value.find("cols");
    if (!data->is_array() || !flatten(*data, numbers)) return false;
    if (rows == value.end() || !rows->is_number() || cols == value.end() || !cols->is_number()) return true;
    // An entry may have several channels.
    const double entries = rows->get<double>() * cols->get<double>(), count = static_cast<double>(numbers.size());
    return entries == 0 ? count == 0 : count > 0 && std::fmod(count, entries) == 0;
  }
  constexpr std::string_view kNames = "xyzw";
  if (value.size() < 2 || value.size() > kNames.size()) return false;
  for (std::size_t i = 0; i < value.size(); ++i) {
    const auto part = value.find(kNames.substr(i, 1));
    if (part == value.end() || !part->is_number()) return false;
    numbers.push_back(part->get<double>());
  }
  return true;
}

std::string shown(const Json& value) {
  if (value.is_string()) return inQuotes(value.get_ref<const std::string&>(), 200);
  if (value.is_number_float()) return formatNumber(value.get<double>());
  return value.is_number() || value.is_boolean() ? value.dump() : "";
}

}  // namespace

bool isInlineJson(const std::string& source) {
  const std::size_t first = source.find_first_not_of(" \t\r\n");
  std::error_code ignored;
  return first != std::string::npos &&
         (source[first] == '{' || (source[first] == '[' && !std::filesystem::exists(pathOf(source), ignored)));
}

Document parseDocument(const std::string& name, std::string text) {
  requireNarrow(name, text);
  return {name, std::make_shared<Json>(parsed(name, std::move(text)))};
}

Document load(const std::string& source, const std::string& option) {
  if (isInlineJson(source)) return parseDocument(option, source);
  return parseDocument(shownName(source), readWholeFile(source, kMostDocumentBytes));
}

const Json* valueAt(const Json& root, std::string_view path) {
  const Json* at = &root;
  while (at && !path.empty()) {
    const std::size_t dot = std::min(path.find('.'), path.size());
    if (!at->is_object()) return nullptr;
    const auto member = at->find(path.substr(0, dot));
    at = member == at->end() || member->is_null() ? nullptr : &*member;
    path.remove_prefix(std::min(dot + 1, path.size()));
  }
  return at;
}

Json& placeAt(Json& root, std::string_view path) {
  Json* at = &root;
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('.', begin), path.size());
    at = &(*at)[std::string(path.substr(begin, end - begin))];
    begin = end + 1;
  }
  return *at;
}

void normalize(Document& document) {
  Json& root = *document.root;
  if (!root.is_object()) throw InputError(document.name + ": expected a JSON object");
  for (const Field& field : kFields) {
    const auto member = field.alias.empty() ? root.end() : root.find(field.alias);
    if (member == root.end()) continue;
    const std::string name(field.path), alias(field.alias);
    if (valueAt(root, name) && !member->is_null())
      Node(document, *member, alias).fail("is another name of " + name + ", which is there too; keep one");
    Json value = std::move(*member);
    root.erase(member);
    if (value.is_null()) continue;
    root[name] = std::move(value);
    document.labels.emplace(name, document.name + ": " + name + " (as " + alias + ")");
  }
  if (const auto convention = root.find("convention"); convention != root.end() && convention->is_string())
    *convention = Json{{"preset", *convention}};
}

std::string joinedPath(std::string_view path, std::string_view key) {
  return std::string(path) + (path.empty() ? "" : ".") + std::string(key);
}

Node::Node(const Document& document) : Node(document, *document.root, "") {}
Node::Node(const Document& document, const Json& value, std::string path)
    : document_(&document), value_(&value), path_(std::move(path)) {}

void Node::mark() const {
  if (document_->marks) document_->marks->insert(value_);
}

bool Node::isMarked() const { return document_->marks && document_->marks->contains(value_); }

std::optional<Node> Node::find(std::string_view key) const {
  if (!value_->is_object()) fail("expected an object");
  const auto member = value_->find(key);
  if (member == value_->end() || member->is_null()) return std::nullopt;
  return Node(*document_, *member, joinedPath(path_, key));
}

std::optional<Node> Node::findAny(std::initializer_list<std::string_view> keys) const {
  for (const std::string_view key : keys)
    if (auto member = find(key)) return member;
  return std::nullopt;
}

Node Node::require(std::string_view key) const {
  if (auto member = find(key)) return *member;
  fail("needs " + std::string(key));
}

std::size_t Node::size() const {
  if (!value_->is_array()) fail("expected an array");
  return value_->size();
}

Node Node::operator[](std::size_t index) const {
  if (index >= size()) fail("has no element " + std::to_string(index));
  return {*document_, (*value_)[index], joinedPath(path_, std::to_string(index))};
}

double Node::number() const {
  if (!value_->is_number()) fail("expected a number");
  mark();
  return value_->get<double>();
}

const std::string& Node::text() const {
  if (!value_->is_string()) fail("expected a text");
  mark();
  return value_->get_ref<const std::string&>();
}

bool Node::flag() const {
  if (!value_->is_boolean()) fail("expected true or false");
  mark();
  return value_->get<bool>();
}

bool Node::holdsNumbers(std::size_t count) const {
  std::vector<double> numbers;
  return value_->is_structured() && flatten(*value_, numbers) && numbers.size() == count;
}

std::vector<double> Node::numbers(std::size_t count) const {
  std::vector<double> numbers;
  if (!value_->is_structured() || !flatten(*value_, numbers) || (count != 0 && numbers.size() != count))
    fail("expected " + (count == 0 ? "numbers" : std::to_string(count) + " numbers"));
  mark();
  return numbers;
}

Vec3 Node::vec3() const {
  const std::vector<double> v = numbers(3);
  return {v[0], v[1], v[2]};
}

Mat4 Node::mat4() const {
  std::vector<double> flat;
  const bool isFlat = !value_->is_array() || value_->empty() || !value_->front().is_array();
  const auto isRow = [](const Json& row) { return row.is_array() && row.size() == 4; };
  const bool good = value_->is_structured() && flatten(*value_, flat) && (flat.size() == 12 || flat.size() == 16) &&
                    (isFlat || std::all_of(value_->begin(), value_->end(), isRow));
  if (!good) fail("expected 4 rows of 4 numbers, or 3 rows of 4");
  mark();
  Mat4 m;
  m[3] = {0, 0, 0, 1};
  for (std::size_t i = 0; i < flat.size(); ++i) m[i / 4][i % 4] = flat[i];
  return m;
}

std::pair<std::string, bool> Node::place() const {
  // The option that set the field, or the object or array around it.
  std::string_view part = path_;
  auto label = document_->labels.find(part);
  while (label == document_->labels.end() && !part.empty()) {
    const std::size_t dot = part.rfind('.');
    part = part.substr(0, dot == std::string_view::npos ? 0 : dot);
    label = document_->labels.find(part);
  }
  const bool isLabelled = label != document_->labels.end();
  const std::string field = path_.substr(part.empty() ? 0 : std::min(part.size() + 1, path_.size()));
  return {(isLabelled ? visible(label->second) : document_->name) + (field.empty() ? "" : ": ") + visible(field),
          isLabelled && label->second.starts_with("--")};
}

void Node::fail(const std::string& message) const {
  const auto [name, isOption] = place();
  const std::string value = shown(*value_);
  const bool isExpectation = message.starts_with("expected "), isAboutOthers = message.starts_with("needs ");
  const std::string got = value.empty() || isAboutOthers ? ""
                          : isExpectation                ? ", got " + value
                                                         : " (is " + value + ")";
  const std::string text = name + ": " + visible(message) + got;
  if (document_->isTyped || isOption) throw UsageError(text);
  throw InputError(text);
}

}  // namespace viewproj::cmd
