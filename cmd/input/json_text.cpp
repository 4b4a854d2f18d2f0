#include "input/json_text.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace viewproj::cmd {
namespace {

bool isSpace(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

std::size_t endOfString(std::string_view text, std::size_t at) {
  for (++at; at < text.size() && text[at] != '"'; ++at)
    if (text[at] == '\\') ++at;
  return std::min(at + 1, text.size());
}

/// Takes nothing in but what is wrong.
struct Thrower final : nlohmann::json_sax<nlohmann::json> {
  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }  // uncounted: text has none
  bool start_object(std::size_t) override { return true; }
  bool key(string_t&) override { return true; }
  bool end_object() override { return true; }
  bool start_array(std::size_t) override { return true; }
  bool end_array() override { return true; }
  bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception& e) override {
    if (const auto* wrong = dynamic_cast<const nlohmann::json::parse_error*>(&e)) throw *wrong;
    throw dynamic_cast<const nlohmann::json::out_of_range&>(e);
  }
};

/// Without the middle of a number or a string that is long.
std::string shortened(const std::string& message) {
  constexpr std::size_t kFront = 160, kBack = 60;
  if (message.size() <= kFront + kBack) return message;
  const auto splitsCharacter = [&](std::size_t at) { return (message[at] & 0xC0) == 0x80; };
  std::size_t front = kFront, back = message.size() - kBack;
  while (front > 0 && splitsCharacter(front)) --front;
  while (back < message.size() && splitsCharacter(back)) ++back;
  return message.substr(0, front) + "..." + message.substr(back);
}

/// Where a number first stands that is written so, not as a part of another, nor in a string.
std::size_t numberWritten(std::string_view text, std::string_view number) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find_first_not_of("+-.0123456789eE", at), text.size());
    if (text.substr(at, end - at) == number) return at;
    at = end > at ? end : text[at] == '"' ? endOfString(text, at) : at + 1;
  }
  return 0;  // uncounted: it stands somewhere
}

}  // namespace

TextPosition positionAt(std::string_view text, std::size_t offset, TextPosition start) {
  for (char c : text.substr(0, offset))
    if (c == '\n') {
      ++start.line;
      start.column = 1;
    } else {
      ++start.column;
    }
  return start;
}

std::string place(std::string_view file, TextPosition position) {
  return std::string(file) + ":" + std::to_string(position.line) + ":" + std::to_string(position.column);
}

std::optional<JsonFault> jsonFault(std::string_view text) {
  try {
    Thrower thrower;
    (void)nlohmann::json::sax_parse(text.begin(), text.end(), &thrower);
    if (const std::size_t nul = text.find('\0'); nul != std::string_view::npos)
      return JsonFault{nul, "not valid JSON: a NUL"};
    return std::nullopt;
  } catch (const nlohmann::json::parse_error& e) {
    // "[json.exception.parse_error.101] parse error at line 1, column 5: what is wrong"
    std::string message = e.what();
    if (const std::size_t colon = message.find(": "); colon != std::string::npos) message.erase(0, colon + 2);
    return JsonFault{e.byte > 0 ? e.byte - 1 : 0, "not valid JSON: " + shortened(message)};
  } catch (const nlohmann::json::exception& e) {
    // "[json.exception.out_of_range.406] number overflow parsing '1e999'"
    std::string message = e.what();
    std::size_t offset = 0;
    if (const std::size_t quote = message.find('\''); quote != std::string::npos) {
      const std::string token = message.substr(quote + 1, message.rfind('\'') - quote - 1);
      offset = numberWritten(text, token);
    }
    if (const std::size_t bracket = message.find("] "); bracket != std::string::npos) message.erase(0, bracket + 2);
    return JsonFault{offset, shortened(message)};
  }
}

bool isJson(std::string_view text) {
  return text.find('\0') == std::string_view::npos && nlohmann::json::accept(text.begin(), text.end());
}

std::size_t endOfValue(std::string_view text, std::size_t at) {
  std::size_t depth = 0;
  for (; at < text.size(); ++at) {
    const char c = text[at];
    if (c == '"') {
      at = endOfString(text, at) - 1;
    } else if (c == '{' || c == '[') {
      ++depth;
    } else if (c == '}' || c == ']') {
      if (depth == 0) return at;  // behind a scalar
      --depth;
    } else if (depth == 0 && (c == ',' || isSpace(c))) {
      return at;
    } else {
      continue;
    }
    if (depth == 0) return at + 1;
  }
  return at;
}

void JsonParts::skipSpace() {
  while (at_ < text_.size() && isSpace(text_[at_])) ++at_;
}

std::optional<JsonParts::Part> JsonParts::next() {
  skipSpace();
  if (at_ < text_.size() && text_[at_] == ',') ++at_;
  skipSpace();
  if (at_ >= text_.size() || text_[at_] == '}' || text_[at_] == ']') return std::nullopt;
  Part part{{}, {}, at_};
  if (isObject_) {
    const std::size_t end = endOfString(text_, at_);
    part.key = text_.substr(at_ + 1, end - at_ - 2);
    at_ = end;
    skipSpace();
    ++at_;  // the colon
    skipSpace();
  }
  const std::size_t end = endOfValue(text_, at_);
  part.value = text_.substr(at_, end - at_);
  at_ = end;
  return part;
}

std::string unescaped(std::string_view raw) {
  if (raw.find('\\') == std::string_view::npos) return std::string(raw);
  return nlohmann::json::parse("\"" + std::string(raw) + "\"").get<std::string>();
}

std::size_t locate(std::string_view text, std::span<const std::string> path) {
  std::size_t base = text.find_first_not_of(" \t\r\n");
  if (base == std::string_view::npos) return 0;
  std::string_view value = text.substr(base);
  for (const std::string& step : path) {
    if (value.empty() || (value[0] != '{' && value[0] != '[')) break;
    JsonParts parts(value);
    std::size_t index = 0;
    bool found = false;
    while (const auto part = parts.next()) {
      if (value[0] == '{' ? unescaped(part->key) == step : std::to_string(index) == step) {
        base += static_cast<std::size_t>(part->value.data() - value.data());
        value = part->value;
        found = true;
        break;
      }
      ++index;
    }
    if (!found) break;
  }
  return base;
}

}  // namespace viewproj::cmd
