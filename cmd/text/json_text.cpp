#include "text/json_text.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "text/json_scan.hpp"
#include "text/number.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

std::size_t endOfString(std::string_view text, std::size_t at) {
  for (++at; at < text.size() && text[at] != '"'; ++at)
    if (text[at] == '\\') ++at;
  return std::min(at + 1, text.size());
}

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

/// Takes nothing in but what is wrong.
struct Judge : nlohmann::json_sax<nlohmann::json> {
  std::optional<JsonFault> fault;

  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }  // text has none
  bool start_object(std::size_t) override { return true; }
  bool key(string_t&) override { return true; }
  bool end_object() override { return true; }
  bool start_array(std::size_t) override { return true; }
  bool end_array() override { return true; }

  /// read: how many bytes, up to the end of the token.
  bool parse_error(std::size_t read, const std::string& token, const nlohmann::json::exception& e) override {
    std::string message = e.what();
    if (dynamic_cast<const nlohmann::json::parse_error*>(&e)) {
      // "[json.exception.parse_error.101] parse error at line 1, column 5: what is wrong"
      if (const std::size_t colon = message.find(": "); colon != std::string::npos) message.erase(0, colon + 2);
      fault = JsonFault{read > 0 ? read - 1 : 0, "not valid JSON: " + shortened(message)};
    } else {
      // "[json.exception.out_of_range.406] number overflow parsing '1e999'"
      if (const std::size_t bracket = message.find("] "); bracket != std::string::npos) message.erase(0, bracket + 2);
      fault = JsonFault{read - std::min(read, token.size()), shortened(message)};
    }
    return false;
  }
};

/// Builds the value. (The library's own parser with a callback looks through the parent at each part that ends.)
struct Builder final : Judge {
  explicit Builder(nlohmann::json& root) : root_(root) {}

  struct Twice {
    std::string key;
    std::size_t number;  ///< among the text's keys
  };
  std::optional<Twice> twice;  ///< the first key that its object has already

  bool null() override { return put(nullptr); }
  bool boolean(bool value) override { return put(value); }
  bool number_integer(number_integer_t value) override { return put(value); }
  bool number_unsigned(number_unsigned_t value) override { return put(value); }
  bool number_float(number_float_t value, const string_t&) override { return put(value); }
  bool string(string_t& value) override { return put(std::move(value)); }
  bool start_object(std::size_t) override { return open(nlohmann::json::object()); }
  bool start_array(std::size_t) override { return open(nlohmann::json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& name) override {
    const auto [at, isNew] = open_.back()->get_ref<nlohmann::json::object_t&>().try_emplace(name);
    if (!isNew && !twice) twice = Twice{name, keys_};
    field_ = &at->second;
    ++keys_;
    return true;
  }

 private:
  nlohmann::json& place(nlohmann::json value) {
    const bool inArray = !open_.empty() && open_.back()->is_array();
    if (inArray) open_.back()->push_back(nullptr);
    nlohmann::json& at = open_.empty() ? root_ : inArray ? open_.back()->back() : *field_;
    return at = std::move(value);
  }
  bool put(nlohmann::json value) {
    place(std::move(value));
    return true;
  }
  bool open(nlohmann::json value) {
    open_.push_back(&place(std::move(value)));
    return true;
  }
  bool close() {
    open_.pop_back();
    return true;
  }

  nlohmann::json& root_;
  std::vector<nlohmann::json*> open_;  ///< the arrays and objects begun, outermost first
  nlohmann::json* field_ = nullptr;    ///< of the key just read
  std::size_t keys_ = 0;
};

std::optional<JsonFault> faultOf(std::string_view text, Judge& judge) {
  (void)nlohmann::json::sax_parse(text.begin(), text.end(), &judge);
  if (judge.fault) return judge.fault;
  if (const std::size_t nul = text.find('\0'); nul != std::string_view::npos)
    return JsonFault{nul, "not valid JSON: a NUL"};
  return std::nullopt;
}

/// Where a key of valid JSON stands, which are counted from 0.
std::size_t offsetOfKey(std::string_view text, std::size_t number) {
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] != '"') continue;
    const std::size_t end = endOfString(text, at), next = afterJsonSpace(text, end);
    if (next < text.size() && text[next] == ':' && number-- == 0) return at;
    at = end - 1;
  }
  return 0;  // there are as many
}

/// Where brackets are nested too deep; blind to what is wrong otherwise.
std::optional<std::size_t> tooDeepAt(std::string_view text) {
  std::size_t depth = 0;
  bool inString = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (inString && c == '\\')
      ++i;
    else if (c == '"')
      inString = !inString;
    else if (!inString && (c == '{' || c == '[') && ++depth > kDeepestJson)
      return i;
    else if (!inString && (c == '}' || c == ']') && depth > 0)
      --depth;
  }
  return std::nullopt;
}

}  // namespace

std::optional<JsonFault> jsonFault(std::string_view text) {
  Judge nothing;
  return faultOf(text, nothing);
}

std::optional<JsonFault> parseJson(std::string_view text, nlohmann::json& value) {
  if (const auto at = tooDeepAt(text)) return JsonFault{*at, "nested deeper than " + std::to_string(kDeepestJson)};
  Builder builder(value);
  if (auto fault = faultOf(text, builder)) return fault;
  if (!builder.twice) return std::nullopt;
  return JsonFault{offsetOfKey(text, builder.twice->number),
                   "the key " + inQuotes(builder.twice->key) + " is given twice"};
}

void blankComments(std::string& text) {
  if (text.find('/') == std::string::npos) return;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] == '"') {
      at = endOfString(text, at) - 1;
      continue;
    }
    if (text[at] != '/' || at + 1 == text.size()) continue;
    std::size_t end = at;
    if (text[at + 1] == '/')
      end = std::min(text.find('\n', at), text.size());
    else if (text[at + 1] == '*')
      end = text.find("*/", at + 2);
    if (end == std::string::npos) return;
    if (end == at) continue;
    if (text[at + 1] == '*') end += 2;
    for (; at < end; ++at)
      if (text[at] != '\n' && text[at] != '\r') text[at] = ' ';
    --at;
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
      if (depth == 0) return at;  // after a scalar
      --depth;
    } else if (depth == 0 && (c == ',' || isJsonSpace(c))) {
      return at;
    } else {
      continue;
    }
    if (depth == 0) return at + 1;
  }
  return at;
}

std::optional<JsonParts::Part> JsonParts::begin() {
  at_ = afterJsonSpace(text_, at_);
  if (at_ < text_.size() && text_[at_] == ',') ++at_;
  at_ = afterJsonSpace(text_, at_);
  if (at_ >= text_.size() || text_[at_] == '}' || text_[at_] == ']') return std::nullopt;
  Part part{{}, {}, at_};
  if (isObject_) {
    const std::size_t end = endOfString(text_, at_);
    part.key = text_.substr(at_ + 1, end - at_ - 2);
    at_ = afterJsonSpace(text_, end);
    at_ = afterJsonSpace(text_, at_ + 1);  // after the colon
  }
  part.value = text_.substr(at_);
  return part;
}

void JsonParts::pass(Part& part) {
  const std::size_t end = endOfValue(text_, at_);
  part.value = text_.substr(at_, end - at_);
  at_ = end;
}

std::optional<JsonParts::Part> JsonParts::next() {
  auto part = begin();
  if (part) pass(*part);
  return part;
}

std::string unescaped(std::string_view raw) {
  if (raw.find('\\') == std::string_view::npos) return std::string(raw);
  return nlohmann::json::parse("\"" + std::string(raw) + "\"").get<std::string>();
}

std::string jsonOf(std::string_view text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string jsonOf(double number) { return formatNumber(number); }

std::string jsonOf(bool flag) { return flag ? "true" : "false"; }

std::string jsonList(const std::vector<std::string>& items, std::string_view between) {
  std::string text = "[";
  for (const std::string& item : items) {
    text += text.size() > 1 ? between : between.substr(std::min(between.find('\n'), between.size()));
    text += item;
  }
  return text + "]";
}

JsonObject& JsonObject::addText(std::string_view name, std::string_view json, std::string_view between) {
  return addMembers(jsonOf(name) + ": " + std::string(json), between);
}

JsonObject& JsonObject::addMembers(std::string_view members, std::string_view between) {
  if (!members.empty() && !members_.empty()) members_ += between;
  members_ += members;
  return *this;
}

}  // namespace viewproj::cmd
