#include "text/yaml_text.hpp"

#include <yaml.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "text/number.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

using nlohmann::json;

/// The byte offset of a mark of libyaml, which counts characters.
std::size_t offsetOf(std::string_view text, std::size_t characters) {
  std::size_t at = 0;
  for (; at < text.size(); ++at)
    if (!continuesCharacter(text[at]) && characters-- == 0) return at;
  return at;
}

/// A text as OpenCV's FileStorage writes and accepts it, as YAML: its first line, which is not a valid directive,
/// becomes a comment, tabs become blanks, and a blank is added after the colon of a key. `added`: the offsets of these
/// blanks.
std::string asYaml(std::string_view text, std::vector<std::size_t>& added) {
  if (!text.starts_with("%YAML:")) return std::string(text);
  std::string copy = "#";
  for (std::size_t at = 1; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = text.substr(at, end - at);
    const std::size_t colon = line.find(':'), key = line.find_first_not_of(" \t");
    const bool isKey = at > 1 && colon != std::string_view::npos && colon + 1 < line.size() && key < colon &&
                       line.substr(0, colon).find_first_of("#\"'[]{}", key) == std::string_view::npos &&
                       std::string_view(" \t\r:/").find(line[colon + 1]) == std::string_view::npos;
    copy += line.substr(0, isKey ? colon + 1 : line.size());
    if (isKey) {
      added.push_back(copy.size());
      copy.append(" ").append(line.substr(colon + 1));
    }
    if (end < text.size()) copy += '\n';
    at = end + 1;
  }
  std::replace(copy.begin(), copy.end(), '\t', ' ');
  return copy;
}

/// The documents of a stream of messages are the same camera if they differ in their headers alone.
bool isSameMessage(json a, json b) {
  if (a.is_object() && b.is_object()) {
    a.erase("header");
    b.erase("header");
  }
  return a == b;
}

template <class... Words>
bool isOne(std::string_view text, Words... words) {
  return ((text == words) || ...);
}

std::string textOf(const yaml_node_t& scalar) {
  return {reinterpret_cast<const char*>(scalar.data.scalar.value), scalar.data.scalar.length};
}

bool isPlain(const yaml_node_t& scalar) { return scalar.data.scalar.style == YAML_PLAIN_SCALAR_STYLE; }

/// One document of a text, with its aliases resolved.
class Document {
 public:
  explicit Document(yaml_parser_t& parser) : isGood_(yaml_parser_load(&parser, &document_) != 0) {}
  ~Document() {
    if (isGood_) yaml_document_delete(&document_);
  }
  Document(const Document&) = delete;
  Document& operator=(const Document&) = delete;

  bool isGood() const { return isGood_; }
  yaml_node_t* root() { return yaml_document_get_root_node(&document_); }
  yaml_node_t& node(int index) { return *yaml_document_get_node(&document_, index); }

 private:
  yaml_document_t document_{};
  bool isGood_;
};

/// Where the text nests deeper than this, counted in characters. A document is loaded as a whole, and the time that
/// takes grows with its depth.
std::optional<std::size_t> tooDeepAt(std::string_view text, std::size_t deepest) {
  yaml_parser_t parser{};
  if (!yaml_parser_initialize(&parser)) throw std::bad_alloc();
  yaml_parser_set_encoding(&parser, YAML_UTF8_ENCODING);
  yaml_parser_set_input_string(&parser, reinterpret_cast<const unsigned char*>(text.data()), text.size());
  std::optional<std::size_t> found;
  std::size_t depth = 0;
  for (bool goesOn = true; goesOn;) {
    yaml_event_t event;
    if (!yaml_parser_parse(&parser, &event)) break;  // loading it will tell the fault
    const bool begins = event.type == YAML_SEQUENCE_START_EVENT || event.type == YAML_MAPPING_START_EVENT;
    const bool ends = event.type == YAML_SEQUENCE_END_EVENT || event.type == YAML_MAPPING_END_EVENT;
    if (begins && ++depth > deepest) found = event.start_mark.index;
    if (ends) --depth;
    goesOn = !found && event.type != YAML_STREAM_END_EVENT;
    yaml_event_delete(&event);
  }
  yaml_parser_delete(&parser);
  return found;
}

class Reader {
 public:
  Reader(std::string_view text, std::size_t deepest) : text_(asYaml(text, added_)), deepest_(deepest) {
    if (!yaml_parser_initialize(&parser_)) throw std::bad_alloc();
    yaml_parser_set_encoding(&parser_, YAML_UTF8_ENCODING);
    yaml_parser_set_input_string(&parser_, reinterpret_cast<const unsigned char*>(text_.data()), text_.size());
  }
  ~Reader() { yaml_parser_delete(&parser_); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  /// Throws JsonFault.
  json read() {
    if (const auto at = tooDeepAt(text_, deepest_))
      throw JsonFault{original(offsetOf(text_, *at)), "nested deeper than " + std::to_string(deepest_)};
    json value;
    bool isRead = false;
    while (true) {
      Document document(parser_);
      if (!document.isGood()) throw fault();
      yaml_node_t* const root = document.root();
      if (!root) return value;
      // In a stream of messages every message ends with ---, also the last one.
      const bool isEmpty = root->type == YAML_SCALAR_NODE && isPlain(*root) && root->data.scalar.length == 0;
      if (isEmpty && isRead) continue;
      json next = valueOf(document, *root, 0);
      if (isRead && !isSameMessage(value, next))
        fail(*root, "a second document begins here, and differs from the first; keep one");
      if (!isRead) value = std::move(next);
      isRead = true;
    }
  }

 private:
  [[noreturn]] void fail(const yaml_node_t& node, const std::string& message) const {
    throw JsonFault{original(offsetOf(text_, node.start_mark.index)), message};
  }

  JsonFault fault() const {
    const bool isCharacter = parser_.error == YAML_READER_ERROR;
    const std::string problem = parser_.problem ? parser_.problem : "out of memory";
    const std::size_t at = isCharacter ? parser_.problem_offset : offsetOf(text_, parser_.problem_mark.index);
    return {original(std::min(at, text_.size())), "not valid YAML: " + problem};
  }

  /// The offset in the text as it was given.
  std::size_t original(std::size_t offset) const {
    return offset - static_cast<std::size_t>(std::lower_bound(added_.begin(), added_.end(), offset) - added_.begin());
  }

  /// Counts the size of values. Without aliases it stays below twice the bytes of the text.
  void spend(const yaml_node_t& node, std::size_t weight) {
    weight_ += weight;
    if (weight_ > 2 * text_.size()) fail(node, "aliases make more of this text than it has bytes");
  }

  json valueOf(Document& document, const yaml_node_t& node, std::size_t depth) {
    if (node.type == YAML_SCALAR_NODE) {
      spend(node, 1 + node.data.scalar.length);
      return scalarOf(node);
    }
    if (depth == deepest_) fail(node, "nested deeper than " + std::to_string(deepest_));  // by its aliases
    spend(node, 1);
    if (node.type == YAML_SEQUENCE_NODE) {
      json array = json::array();
      for (const int* item = node.data.sequence.items.start; item != node.data.sequence.items.top; ++item)
        array.push_back(valueOf(document, document.node(*item), depth + 1));
      return array;
    }
    json object = json::object();
    for (const yaml_node_pair_t* pair = node.data.mapping.pairs.start; pair != node.data.mapping.pairs.top; ++pair) {
      const yaml_node_t& key = document.node(pair->key);
      if (key.type != YAML_SCALAR_NODE) fail(key, "a key that is not a text");
      const std::string name = textOf(key);
      spend(key, 1 + name.size());
      if (name == "<<" && isPlain(key))
        fail(key, "the key << merges what is elsewhere, which is not read; write it out");
      if (object.contains(name)) fail(key, "the key " + inQuotes(name) + " is given twice");
      object[name] = valueOf(document, document.node(pair->value), depth + 1);
    }
    return object;
  }

  json scalarOf(const yaml_node_t& node) const {
    const std::string text = textOf(node);
    if (!isPlain(node)) return text;
    if (isOne(text, "", "~", "null", "Null", "NULL")) return nullptr;
    if (isOne(text, "true", "True", "TRUE")) return true;
    if (isOne(text, "false", "False", "FALSE")) return false;
    // Decimal numbers of the core schema: -1, +1., .5e3.
    if (isLargerThanDoubles(text)) fail(node, inQuotes(text) + " is larger than any double");
    return parseNumber(text) ? numberOfJson(std::string_view(text).substr(text.starts_with('+') ? 1 : 0)) : json(text);
  }

  std::vector<std::size_t> added_;  ///< offsets of blanks that the text as it was given does not have
  std::string text_;
  std::size_t deepest_, weight_ = 0;
  yaml_parser_t parser_{};
};

}  // namespace

bool looksLikeYaml(std::string_view text) {
  if (text.starts_with("%YAML")) return true;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string_view line = text.substr(at, end - at);
    at = end + 1;
    line.remove_prefix(std::min(line.find_first_not_of(" \t\r"), line.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.empty() || line[0] == '#') continue;
    if (line == "---" || line.starts_with("--- ") || line.starts_with("- ")) return true;
    // A key: before its colon are only characters of names and quotes.
    constexpr std::size_t kLongest = 200;
    const std::size_t colon = line.substr(0, kLongest).find(':');
    if (colon == std::string_view::npos || colon == 0) return false;
    if (colon + 1 < line.size() && line[colon + 1] != ' ' && line[colon + 1] != '\t') return false;
    if (line.substr(0, colon).find_first_of("{}[],<>=;()|") != std::string_view::npos) return false;
    // A plain value has no second key, "fx: 1, fy: 2", and is no vector, "(1, 2, 3)".
    const std::size_t value = line.find_first_not_of(" \t", colon + 1);
    if (value != std::string_view::npos && line[value] == '(') return false;
    return value == std::string_view::npos ||
           std::string_view("\"'[{&!|>#").find(line[value]) != std::string_view::npos ||
           line.substr(value, line.find(" #", value) - value).find(": ") == std::string_view::npos;
  }
  return false;
}

std::optional<JsonFault> parseYaml(std::string_view text, std::size_t deepest, json& value) {
  if (const std::size_t nul = text.find('\0'); nul != std::string_view::npos)
    return JsonFault{nul, "not valid YAML: a NUL"};
  try {
    value = Reader(text, deepest).read();
  } catch (const JsonFault& fault) {
    return fault;
  }
  return std::nullopt;
}

}  // namespace viewproj::cmd
