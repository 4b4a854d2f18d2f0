#include "text/json_text.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "text/number.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

std::size_t endOfString(std::string_view text, std::size_t at) {
  for (++at; at < text.size() && text[at] != '"'; ++at)
    if (text[at] == '\\') ++at;
  return std::min(at + 1, text.size());
}

/// Builds a value from the events of a scan. Throws JsonFault.
class Builder : public JsonEvents {
 public:
  Builder(std::string_view text, nlohmann::json& root) : text_(text), root_(root) {}

  void open(const char* bracket) {
    open_.push_back(&put(*bracket == '{' ? nlohmann::json::object() : nlohmann::json::array()));
  }
  void close(const char*) { open_.pop_back(); }
  void name(std::string_view quoted) {
    const std::string key = unescaped(quoted.substr(1, quoted.size() - 2));
    const auto [at, isNew] = open_.back()->get_ref<nlohmann::json::object_t&>().try_emplace(key);
    if (!isNew) fail(quoted.data(), "the key " + inQuotes(key) + " is given twice");
    member_ = &at->second;
  }
  void scalar(std::string_view written) {
    const char first = written[0];
    if (first == '"')
      put(unescaped(written.substr(1, written.size() - 2)));
    else if (beginsNumber(first))
      put(numberOfJson(written));
    else
      put(first == 'n' ? nlohmann::json() : nlohmann::json(first == 't'));
  }

 private:
  [[noreturn]] void fail(const char* at, const std::string& message) const {
    throw JsonFault{static_cast<std::size_t>(at - text_.data()), message};
  }
  nlohmann::json& put(nlohmann::json value) {
    nlohmann::json& place = open_.empty() ? root_ : open_.back()->is_object() ? *member_ : open_.back()->emplace_back();
    return place = std::move(value);
  }

  std::string_view text_;
  nlohmann::json& root_;
  std::vector<nlohmann::json*> open_;  ///< the open arrays and objects, outermost first
  nlohmann::json* member_ = nullptr;   ///< the member whose name was just read
};

}  // namespace

std::optional<JsonFault> parseJson(std::string_view text, nlohmann::json& value) {
  Builder builder(text, value);
  try {
    return scanWhole(text, builder);
  } catch (const JsonFault& fault) {
    return fault;
  }
}

nlohmann::json numberOfJson(std::string_view text) {
  const char *const begin = text.data(), *const end = begin + text.size();
  std::uint64_t natural = 0;
  std::int64_t integer = 0;
  double number = 0;
  const auto isRead = [&](auto& result) {
    const auto [stop, error] = std::from_chars(begin, end, result);
    return stop == end && error == std::errc();
  };
  if (isRead(natural)) return natural;
  if (isRead(integer)) return integer;
  (void)readNumber(begin, end, number);
  return number;
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
      end = std::min(text.find_first_of("\r\n", at), text.size());
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

std::optional<JsonParts::Part> JsonParts::next() {
  at_ = afterJsonSpace(text_, at_);
  if (at_ < text_.size() && text_[at_] == ',') at_ = afterJsonSpace(text_, at_ + 1);
  if (at_ >= text_.size() || text_[at_] == '}' || text_[at_] == ']') return std::nullopt;
  Part part{{}, {}, at_};
  if (isObject_) {
    const std::size_t end = endOfString(text_, at_), colon = afterJsonSpace(text_, end);
    part.key = text_.substr(at_ + 1, end - at_ - 2);
    at_ = afterJsonSpace(text_, colon + 1);
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

std::string jsonOf(std::string_view text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string jsonOf(double number) { return formatNumber(number); }

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
