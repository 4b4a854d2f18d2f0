#include "text/yaml_text.hpp"

#include <yaml.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <unordered_map>
#include <vector>

#include "text/parse_number.hpp"
#include "text/visible.hpp"

namespace viewproj::cmd {
namespace {

using nlohmann::json;

/// Marks count characters.
std::size_t offsetOf(std::string_view text, std::size_t characters) {
  std::size_t at = 0;
  for (; at < text.size(); ++at)
    if ((text[at] & 0xC0) != 0x80 && characters-- == 0) return at;
  return at;
}

/// OpenCV's first line is no directive of YAML: a comment in its place.
std::string withoutDirective(std::string_view text) {
  std::string copy(text);
  if (copy.starts_with("%YAML:")) copy[0] = '#';
  return copy;
}

bool isDigit(char c) { return c >= '0' && c <= '9'; }

/// As YAML's core schema has them, decimal: -1, +1., .5e3.
bool looksLikeNumber(std::string_view text) {
  if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
  const auto digits = [&] {
    std::size_t count = 0;
    while (count < text.size() && isDigit(text[count])) ++count;
    text.remove_prefix(count);
    return count;
  };
  std::size_t count = digits();
  if (text.starts_with('.')) {
    text.remove_prefix(1);
    count += digits();
  }
  if (count == 0) return false;
  if (text.empty()) return true;
  if (text[0] != 'e' && text[0] != 'E') return false;
  text.remove_prefix(1);
  if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
  return digits() > 0 && text.empty();
}

template <class... Words>
bool isOne(std::string_view text, Words... words) {
  return ((text == words) || ...);
}

class Parser {
 public:
  explicit Parser(std::string_view text) : text_(withoutDirective(text)) {
    if (!yaml_parser_initialize(&parser_)) throw std::bad_alloc();
    yaml_parser_set_encoding(&parser_, YAML_UTF8_ENCODING);
    yaml_parser_set_input_string(&parser_, reinterpret_cast<const unsigned char*>(text_.data()), text_.size());
  }
  ~Parser() {
    yaml_event_delete(&event_);
    yaml_parser_delete(&parser_);
  }
  Parser(const Parser&) = delete;
  Parser& operator=(const Parser&) = delete;

  /// False where the text is no YAML.
  bool next() {
    yaml_event_delete(&event_);
    event_ = {};
    return yaml_parser_parse(&parser_, &event_) != 0;
  }
  const yaml_event_t& event() const { return event_; }
  std::size_t offset() const { return offsetOf(text_, event_.start_mark.index); }

  JsonFault fault() const {
    const bool isCharacter = parser_.error == YAML_READER_ERROR;
    const std::string problem = parser_.problem ? parser_.problem : "out of memory";
    const std::size_t at = isCharacter ? parser_.problem_offset : offsetOf(text_, parser_.problem_mark.index);
    return {std::min(at, text_.size()), "not valid YAML: " + problem};
  }

 private:
  std::string text_;
  yaml_parser_t parser_{};
  yaml_event_t event_{};
};

/// Takes the parser's events as a value.
class Builder {
 public:
  Builder(Parser& parser, std::size_t deepest, std::size_t mostCopied)
      : parser_(parser), deepest_(deepest), budget_(mostCopied) {}

  std::optional<JsonFault> build(json& root) {
    root_ = &root;
    std::size_t documents = 0;
    while (parser_.next()) {
      const yaml_event_t& event = parser_.event();
      switch (event.type) {
        case YAML_STREAM_END_EVENT:
          return std::nullopt;
        case YAML_DOCUMENT_START_EVENT:
          if (++documents > 1) return afterTheEnd(parser_.offset());
          break;
        case YAML_SCALAR_EVENT:
          if (auto fault = scalar(event)) return fault;
          break;
        case YAML_ALIAS_EVENT:
          if (auto fault = alias(event)) return fault;
          break;
        case YAML_MAPPING_START_EVENT:
          if (auto fault = open(json::object(), event.data.mapping_start.anchor)) return fault;
          break;
        case YAML_SEQUENCE_START_EVENT:
          if (auto fault = open(json::array(), event.data.sequence_start.anchor)) return fault;
          break;
        case YAML_MAPPING_END_EVENT:
        case YAML_SEQUENCE_END_EVENT:
          if (auto fault = close()) return fault;
          break;
        default:
          break;
      }
    }
    return parser_.fault();
  }

 private:
  struct Open {
    json* value;
    std::string key, anchor;
    bool hasKey = false;
    std::size_t weight = 0;  ///< of what is in it
  };

  /// A stream of messages ends each with ---, the last too. at: where the second document begins.
  std::optional<JsonFault> afterTheEnd(std::size_t at) {
    while (parser_.next()) {
      const yaml_event_t& event = parser_.event();
      if (event.type == YAML_STREAM_END_EVENT) return std::nullopt;
      const bool isEmpty = event.type == YAML_SCALAR_EVENT && event.data.scalar.length == 0 &&
                           event.data.scalar.style == YAML_PLAIN_SCALAR_STYLE && !event.data.scalar.anchor;
      if (event.type == YAML_DOCUMENT_START_EVENT)
        at = parser_.offset();
      else if (event.type != YAML_DOCUMENT_END_EVENT && !isEmpty)
        return JsonFault{at, "a second document begins here; one is expected"};
    }
    return parser_.fault();
  }

  static std::string textOf(const yaml_char_t* text) { return text ? reinterpret_cast<const char*>(text) : ""; }

  std::optional<JsonFault> scalar(const yaml_event_t& event) {
    const auto& said = event.data.scalar;
    const std::string text(reinterpret_cast<const char*>(said.value), said.length);
    const bool isKey = expectsKey();
    if (isKey && text == "<<" && said.style == YAML_PLAIN_SCALAR_STYLE)
      return JsonFault{parser_.offset(), "the key << merges what is elsewhere, which is not read; write it out"};
    if (isKey)
      if (auto fault = key(text)) return fault;
    if (isKey && !said.anchor) return std::nullopt;
    json value = text;
    const std::string tag = textOf(said.tag);
    if (said.style == YAML_PLAIN_SCALAR_STYLE && tag != YAML_STR_TAG && tag != "!")
      if (auto fault = plain(text, value)) return fault;
    if (isKey) return anchored(value, 1 + text.size(), textOf(said.anchor));
    return put(std::move(value), 1 + text.size(), textOf(said.anchor));
  }

  bool expectsKey() const { return !stack_.empty() && stack_.back().value->is_object() && !stack_.back().hasKey; }

  std::optional<JsonFault> key(const std::string& text) {
    Open& parent = stack_.back();
    if (parent.value->contains(text))
      return JsonFault{parser_.offset(), "the key " + inQuotes(text) + " is given twice"};
    parent.key = text;
    parent.hasKey = true;
    return std::nullopt;
  }

  std::optional<JsonFault> plain(const std::string& text, json& value) const {
    if (isOne(text, "", "~", "null", "Null", "NULL")) value = nullptr;
    if (isOne(text, "true", "True", "TRUE")) value = true;
    if (isOne(text, "false", "False", "FALSE")) value = false;
    if (!looksLikeNumber(text)) return std::nullopt;
    const char* const begin = text.data() + (text.starts_with('+') ? 1 : 0);
    const char* const end = text.data() + text.size();
    std::uint64_t natural = 0;
    std::int64_t whole = 0;
    if (const auto read = std::from_chars(begin, end, natural); read.ec == std::errc() && read.ptr == end) {
      value = natural;
    } else if (const auto other = std::from_chars(begin, end, whole); other.ec == std::errc() && other.ptr == end) {
      value = whole;
    } else if (const auto number = parseNumber(text)) {
      value = *number;
    } else {
      return JsonFault{parser_.offset(), "number overflow parsing " + inQuotes(text)};
    }
    return std::nullopt;
  }

  /// Where the next value goes. Throws nothing: the place is there once it is known to be one.
  std::optional<JsonFault> place(json*& at) {
    at = root_;
    if (stack_.empty()) return std::nullopt;
    Open& parent = stack_.back();
    if (parent.value->is_array()) {
      parent.value->push_back(nullptr);
      at = &parent.value->back();
    } else {
      if (!parent.hasKey) return JsonFault{parser_.offset(), "a key that is no text"};
      at = &(*parent.value)[parent.key];
      parent.weight += parent.key.size();
      parent.hasKey = false;
    }
    return std::nullopt;
  }

  std::optional<JsonFault> put(json value, std::size_t weight, const std::string& anchor) {
    json* at = nullptr;
    if (auto fault = place(at)) return fault;
    *at = std::move(value);
    if (!stack_.empty()) stack_.back().weight += weight;
    return anchored(*at, weight, anchor);
  }

  std::optional<JsonFault> open(json value, const yaml_char_t* anchor) {
    if (stack_.size() == deepest_) return JsonFault{parser_.offset(), "nested deeper than " + std::to_string(deepest_)};
    Open opened{nullptr, {}, textOf(anchor)};
    if (auto fault = place(opened.value)) return fault;
    *opened.value = std::move(value);
    stack_.push_back(std::move(opened));
    return std::nullopt;
  }

  std::optional<JsonFault> close() {
    const Open closed = std::move(stack_.back());
    stack_.pop_back();
    if (!stack_.empty()) stack_.back().weight += closed.weight + 1;
    return anchored(*closed.value, closed.weight + 1, closed.anchor);
  }

  std::optional<JsonFault> spend(std::size_t weight) {
    if (weight > budget_) return JsonFault{parser_.offset(), "aliases make more of this text than it has bytes"};
    budget_ -= weight;
    return std::nullopt;
  }

  std::optional<JsonFault> anchored(const json& value, std::size_t weight, const std::string& anchor) {
    if (anchor.empty()) return std::nullopt;
    if (auto fault = spend(weight)) return fault;
    anchors_[anchor] = value;
    weights_[anchor] = weight;
    return std::nullopt;
  }

  std::optional<JsonFault> alias(const yaml_event_t& event) {
    const std::string name = textOf(event.data.alias.anchor);
    const auto known = anchors_.find(name);
    if (known == anchors_.end())
      return JsonFault{parser_.offset(), "the alias " + inQuotes(name) + " is of nothing before it"};
    const std::size_t weight = weights_.at(name);
    if (auto fault = spend(weight)) return fault;
    if (expectsKey() && known->second.is_string()) return key(known->second.get<std::string>());
    return put(known->second, weight, "");
  }

  Parser& parser_;
  std::size_t deepest_, budget_;
  json* root_ = nullptr;
  std::vector<Open> stack_;
  std::unordered_map<std::string, json> anchors_;
  std::unordered_map<std::string, std::size_t> weights_;  ///< of the anchors
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
    // A key, and nothing else before its colon than what names and quotes have.
    constexpr std::size_t kLongest = 200;
    const std::size_t colon = line.substr(0, kLongest).find(':');
    if (colon == std::string_view::npos || colon == 0) return false;
    if (colon + 1 < line.size() && line[colon + 1] != ' ' && line[colon + 1] != '\t') return false;
    return line.substr(0, colon).find_first_of("{}[],<>=;()|") == std::string_view::npos;
  }
  return false;
}

std::optional<JsonFault> parseYaml(std::string_view text, std::size_t deepest, json& value) {
  if (const std::size_t nul = text.find('\0'); nul != std::string_view::npos)
    return JsonFault{nul, "not valid YAML: a NUL"};
  Parser parser(text);
  return Builder(parser, deepest, text.size()).build(value);
}

}  // namespace viewproj::cmd
