#include "stream/json_splitter.hpp"

#include <algorithm>
#include <array>

#include "records/record.hpp"
#include "text/error.hpp"
#include "text/json_scan.hpp"
#include "text/json_text.hpp"

namespace viewproj::cmd {
namespace {

constexpr std::size_t npos = std::string_view::npos;
constexpr std::string_view kSpace = " \t\r\n";
constexpr const char* kNoSeparator = "expected , or ] after a record of an array";
constexpr const char* kNotClosed = "the array is not closed; expected ]";

using Place = JsonState::Place;

bool closesJson(char c) { return c == '}' || c == ']'; }

/// A line of JSON text ends with LF, CRLF or CR.
bool isLineBreak(char c) { return c == '\n' || c == '\r'; }

/// The last line break in [from, end), or npos.
std::size_t lastLineBreak(std::string_view text, std::size_t end, std::size_t from = 0) {
  while (end > from && !isLineBreak(text[end - 1])) --end;
  return end > from ? end - 1 : npos;
}

/// The characters that a scan for brackets skips at once: all but white space, quotes and brackets.
constexpr std::array<bool, 256> kOrdinary = [] {
  std::array<bool, 256> ordinary{};
  for (std::size_t c = 0; c < 256; ++c) ordinary[c] = true;
  for (const char c : {' ', '\t', '\r', '\n', '"', '{', '[', '}', ']'}) ordinary[static_cast<unsigned char>(c)] = false;
  return ordinary;
}();

/// The end of a string's content from `at` on: its quote, a line break, or the text's size; before a backslash that the
/// text's end cuts off.
std::size_t endOfString(std::string_view text, std::size_t at) {
  while (at < text.size() && text[at] != '"' && !isLineBreak(text[at])) {
    const bool isEscape = text[at] == '\\';
    if (isEscape && at + 1 == text.size()) return at;
    at += isEscape && !isLineBreak(text[at + 1]) ? 2 : 1;
  }
  return at;
}

enum class Answer { no, yes, undecided };

/// Whether an array or a document of records begins here, and not a record: if so, size is that of its beginning.
Answer beginsArray(std::string_view rest, std::size_t& size) {
  constexpr std::size_t kLongestKey = kRecordsField.size() * std::string_view("\\u0070").size();
  size = 1;
  std::size_t at = afterJsonSpace(rest, 1);
  if (at == rest.size()) return Answer::undecided;
  if (rest[0] == '[') return opensJson(rest[at]) || rest[at] == ']' ? Answer::yes : Answer::no;
  if (rest[at] != '"') return Answer::no;
  const std::size_t end = endOfString(rest.substr(0, at + 2 + kLongestKey), at + 1);
  if (end + 1 >= rest.size()) return Answer::undecided;
  if (end > at + 1 + kLongestKey || rest[end] != '"') return Answer::no;
  const std::string_view key = rest.substr(at + 1, end - at - 1);
  if (jsonFault("\"" + std::string(key) + "\"") || unescaped(key) != kRecordsField) return Answer::no;
  at = end;
  for (const char expected : {':', '['}) {
    at = afterJsonSpace(rest, at + 1);
    if (at == rest.size()) return Answer::undecided;
    if (rest[at] != expected) return Answer::no;
  }
  size = at + 1;
  return Answer::yes;
}

/// Makes pieces of the text, and the state after them.
class Splitter {
 public:
  Splitter(std::string_view rest, JsonState& state, JsonEnd end)
      : rest_(rest), state_(state), end_(end), atEnd_(end != JsonEnd::open) {}

  JsonPiece next() {
    if (rest_.empty()) return atTextEnd();
    const char c = rest_[0];
    if (isJsonSpace(c)) return piece(JsonEvent::space, afterJsonSpace(rest_, 0), state_.place);
    const bool afterOne = state_.place == Place::record || state_.place == Place::bad;
    if (state_.insideArray()) {
      if (c == ',' && afterOne) return piece(JsonEvent::comma, 1, Place::comma);
      if (c == ',' || (c == ']' && state_.place == Place::comma)) return missing(kNoRecord, Place::bad);
      if (c == ']') return endOfArray();
    }
    if (!opensJson(c)) return junk(afterOne ? kNoSeparator : kNoRecord);
    if (afterOne || !state_.insideArray()) {
      std::size_t size = 0;
      Answer array = beginsArray(rest_, size);
      // No record is a bracket alone, where a block ends.
      if (array == Answer::undecided && end_ == JsonEnd::block && c == '[') array = Answer::yes;
      if (array == Answer::undecided && !atEnd_) return {};
      if (array == Answer::yes && afterOne) return brokenEnd(0, 0, kNotClosed);
      if (array == Answer::yes) {
        JsonPiece begin = piece(JsonEvent::beginArray, size, Place::first);
        state_.inDocument = c == '{';
        return begin;
      }
      if (state_.place == Place::record) return missing(kNoSeparator, Place::comma);
    }
    return record();
  }

 private:
  JsonPiece piece(JsonEvent event, std::size_t size, Place next) {
    const std::string_view text = rest_.substr(0, size);
    state_.moveOver(text);
    state_.place = next;
    state_.scan = {};
    return {.event = event, .text = text, .end = size};
  }

  JsonPiece bad(std::size_t size, std::string message) {
    JsonPiece bad = piece(JsonEvent::bad, size, state_.insideArray() ? Place::bad : Place::top);
    bad.message = std::move(message);
    return bad;
  }

  /// An error between two bytes: something is missing there.
  JsonPiece missing(const char* message, Place next) {
    JsonPiece missing = bad(0, message);
    state_.place = next;
    return missing;
  }

  /// The array ends with so many bytes, which are not its proper end.
  JsonPiece brokenEnd(std::size_t size, std::size_t at, std::string message) {
    JsonPiece end = piece(JsonEvent::endArray, size, Place::top);
    state_.inDocument = false;
    end.at = at;
    end.message = std::move(message);
    return end;
  }

  JsonPiece atTextEnd() {
    if (end_ != JsonEnd::input || !state_.insideArray())
      return {.event = atEnd_ ? JsonEvent::end : JsonEvent::needMore};
    return brokenEnd(0, 0,
                     state_.place == Place::comma ? "the input ends after a comma; expected a record"
                                                  : "the input ends inside an array; expected ]");
  }

  std::size_t endOf(const BracketScan& scan) const {
    return scan.closing.empty() ? scan.at : scan.firstLine > 0 ? scan.firstLine : rest_.size();
  }

  JsonPiece record() {
    BracketScan scan = std::move(state_.scan);
    if (!scanBrackets(rest_, state_, atEnd_, scan)) {
      state_.scan = std::move(scan);
      return {};
    }
    const bool isClosed = scan.closing.empty();
    JsonPiece record = piece(JsonEvent::record, endOf(scan),
                             !state_.insideArray() ? Place::top
                             : isClosed            ? Place::record
                                                   : Place::bad);
    // One that does not close its brackets is not valid JSON, and whoever reads it says so.
    if (!isClosed) record.text = record.text.substr(0, record.text.find_last_not_of(kSpace) + 1);
    return record;
  }

  JsonPiece endOfArray() {
    // A bracket with a comma after it ends nothing, except in a document, where a name may follow.
    const auto isAtEnd = [&](std::size_t at) { return at == rest_.size() && !atEnd_; };
    std::size_t at =
        state_.inDocument ? afterJsonSpace(rest_, 1) : std::min(rest_.find_first_not_of(" \t", 1), rest_.size());
    if (isAtEnd(at)) return {};
    if (at < rest_.size() && rest_[at] == ',') {
      const std::size_t comma = at + 1;
      at = state_.inDocument ? afterJsonSpace(rest_, comma) : rest_.size();
      if (state_.inDocument && isAtEnd(at)) return {};
      if (at == rest_.size() || (rest_[at] != '"' && rest_[at] != '}')) {
        JsonPiece extra = bad(comma, kNoSeparator);
        state_.place = Place::comma;
        return extra;
      }
    }
    if (!state_.inDocument) return piece(JsonEvent::endArray, 1, Place::top);
    return endOfDocument();
  }

  /// From the `]` of the records on, as if the object began there.
  JsonPiece endOfDocument() {
    BracketScan scan = std::move(state_.scan);
    if (scan.at == 0) scan = {.at = 1, .closing = "}", .before = ']'};
    if (!scanBrackets(rest_, state_, atEnd_, scan)) {
      state_.scan = std::move(scan);
      return {};
    }
    const std::size_t size = endOf(scan);
    if (!scan.closing.empty()) return brokenEnd(size, size, "the document is not closed; expected }");
    constexpr std::string_view kBefore = "{\"points\":[";
    const std::string whole = std::string(kBefore) + std::string(rest_.substr(0, size));
    try {
      JsonFields fields;
      fields.splitWhole(whole);
      (void)fields.schema(whole);
    } catch (const RecordError& e) {
      return brokenEnd(size, e.offset - std::min(e.offset, kBefore.size()), e.what());
    }
    JsonPiece end = piece(JsonEvent::endArray, size, Place::top);
    state_.inDocument = false;
    return end;
  }

  /// Text that does not begin like a record: up to the next bracket or the end of its line, in an array also to a
  /// comma.
  JsonPiece junk(const char* message) {
    const auto ends = [&](char c) {
      return isLineBreak(c) || opensJson(c) || (state_.insideArray() && (c == ',' || c == ']'));
    };
    std::size_t at = 0;
    while (at < rest_.size() && (at == 0 || !ends(rest_[at]))) {
      if (rest_[at++] != '"') continue;
      at = endOfString(rest_, at);
      if (at < rest_.size() && rest_[at] == '"') ++at;
    }
    if (at == rest_.size() && !atEnd_) return {};
    return bad(at, message);
  }

  std::string_view rest_;
  JsonState& state_;
  JsonEnd end_;
  bool atEnd_;
};

}  // namespace

std::size_t lastBorder(std::string_view text, std::size_t from) {
  const std::size_t first = std::max<std::size_t>(from, 1) - 1;
  for (std::size_t end = std::max<std::size_t>(text.size(), 1) - 1;;) {
    end = lastLineBreak(text, end, first);
    if (end == npos) return npos;
    if (!opensJson(text[end + 1])) continue;
    const std::size_t before = text.find_last_not_of(kSpace, end);
    if (before != npos && closesJson(text[before])) return end + 1;
  }
}

bool mayOpenArray(std::string_view text) {
  for (std::size_t at = text.find('['); at != npos; at = text.find('[', at + 1)) {
    const std::size_t inner = afterJsonSpace(text, at + 1);
    if (inner == text.size() || opensJson(text[inner]) || text[inner] == ']') return true;
  }
  for (std::size_t at = text.find('{'); at != npos; at = text.find('{', at + 1)) {
    const std::size_t quote = afterJsonSpace(text, at + 1);
    if (quote == text.size()) return true;
    const std::string_view key = text.substr(quote + 1, kRecordsField.size());
    if (text[quote] == '"' && (key.size() < kRecordsField.size() || key == kRecordsField || key.find('\\') != npos))
      return true;
  }
  return false;
}

void JsonState::moveOver(std::string_view passed) {
  const std::size_t break_ = lastLineBreak(passed, passed.size());
  column = break_ == npos ? column + passed.size() : passed.size() - break_ - 1;
}

bool scanBrackets(std::string_view rest, const JsonState& state, bool atEnd, BracketScan& scan) {
  if (scan.at == 0) scan = {.at = 1, .closing = std::string(1, rest[0] == '{' ? '}' : ']'), .before = rest[0]};
  const bool isObject = rest[0] != '[';  // an array is of numbers
  while (scan.at < rest.size()) {
    if (scan.inString) {
      scan.at = endOfString(rest, scan.at);
      if (scan.at == rest.size() || rest[scan.at] == '\\') break;
      scan.inString = false;
      scan.at += rest[scan.at] == '"' ? 1 : 0;  // a line break ends it as well
      continue;
    }
    const char c = rest[scan.at];
    if (kOrdinary[static_cast<unsigned char>(c)]) {
      do ++scan.at;
      while (scan.at < rest.size() && kOrdinary[static_cast<unsigned char>(rest[scan.at])]);
      scan.before = rest[scan.at - 1];
      scan.isAtLineBegin = false;
      continue;
    }
    if (isJsonSpace(c)) {
      ++scan.at;
      if (isLineBreak(c)) {
        scan.isAtLineBegin = true;
        scan.line = scan.at;
      }
      continue;
    }
    if (scan.isAtLineBegin && scan.at - scan.line <= state.column) {
      if (opensJson(c)) {
        if (scan.firstLine == 0) scan.firstLine = scan.at;
        const bool isItem = scan.closing.back() == ']' && isObject && (scan.before == '[' || scan.before == ',');
        if (scan.isBroken || (!isItem && scan.before != ':')) return true;
      } else if (c == ']' && state.insideArray() && (scan.isBroken || scan.closing.back() != ']')) {
        if (scan.firstLine == 0) scan.firstLine = scan.at;
        return true;
      }
    }
    scan.isAtLineBegin = false;
    ++scan.at;
    if (scan.isBroken) continue;
    scan.before = c;
    if (c == '"')
      scan.inString = true;
    else if (opensJson(c) && scan.closing.size() < kDeepestJson)
      scan.closing += c == '{' ? '}' : ']';
    else if (c == scan.closing.back())
      scan.closing.pop_back();
    else if (scan.isBroken = true; scan.firstLine > 0)
      return true;
    if (scan.closing.empty()) return true;
  }
  return atEnd;
}

JsonPiece nextPiece(std::string_view rest, JsonState& state, JsonEnd end) { return Splitter(rest, state, end).next(); }

}  // namespace viewproj::cmd
