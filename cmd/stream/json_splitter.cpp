#include "stream/json_splitter.hpp"

#include <algorithm>
#include <array>
#include <utility>

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

/// The end of a string: its quote, a line break or the text's end. One more if the text's end cuts an escape.
std::size_t endOfString(std::string_view text, std::size_t at) {
  while (at < text.size() && text[at] != '"' && !isLineBreak(text[at]))
    at += text[at] == '\\' && (at + 1 == text.size() || !isLineBreak(text[at + 1])) ? 2 : 1;
  return at;
}

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
  const std::size_t line = lastLineBreak(passed, passed.size());
  column = line == npos ? column + passed.size() : passed.size() - line - 1;
}

JsonPiece JsonSplitter::next(std::string_view rest, End end) {
  const bool atEnd = end != End::open;
  if (rest.empty()) {
    if (end != End::input || !state_.insideArray()) return {.event = atEnd ? JsonEvent::end : JsonEvent::needMore};
    return brokenEnd(rest, 0,
                     state_.place == Place::comma ? "the input ends after a comma; expected a record"
                                                  : "the input ends inside an array; expected ]");
  }
  const char c = rest[0];
  if (isJsonSpace(c)) return piece(JsonEvent::space, rest.substr(0, afterJsonSpace(rest, 0)), state_.place);
  const bool afterOne = state_.place == Place::record || state_.place == Place::bad;
  if (state_.insideArray()) {
    if (c == ',' && afterOne) return piece(JsonEvent::comma, rest.substr(0, 1), Place::comma);
    if (c == ',' || (c == ']' && state_.place == Place::comma)) return missing(rest, kNoRecord, Place::bad);
    if (c == ']') return endOfArray(rest, atEnd);
  }
  if (!opensJson(c)) return junk(rest, atEnd, afterOne ? kNoSeparator : kNoRecord);
  if ((looked_ == 0 || step_ > 0) && (afterOne || !state_.insideArray())) {
    const Answer array = beginsArray(rest);
    if (array == Answer::undecided && !atEnd) return {};
    if (array == Answer::yes && afterOne) return brokenEnd(rest.substr(0, 0), 0, kNotClosed);
    if (array == Answer::yes) {
      JsonPiece begin = piece(JsonEvent::beginArray, rest.substr(0, std::exchange(looked_, 0)), Place::first);
      state_.inDocument = c == '{';
      return begin;
    }
    looked_ = step_ = 0;
    if (state_.place == Place::record) return missing(rest, kNoSeparator, Place::comma);
  }
  return atBracket(rest, atEnd);
}

JsonPiece JsonSplitter::piece(JsonEvent event, std::string_view text, Place next) {
  state_.moveOver(text);
  state_.place = next;
  looked_ = step_ = 0;
  inString_ = false;
  return {.event = event, .text = text, .end = text.size()};
}

JsonPiece JsonSplitter::bad(std::string_view text, std::size_t at, std::string message) {
  JsonPiece bad = piece(JsonEvent::bad, text, state_.insideArray() ? Place::bad : Place::top);
  bad.at = at;
  bad.message = std::move(message);
  return bad;
}

/// An error between two bytes: something is missing there.
JsonPiece JsonSplitter::missing(std::string_view rest, const char* message, Place next) {
  JsonPiece missing = bad(rest.substr(0, 0), 0, message);
  state_.place = next;
  return missing;
}

/// The array ends with text, which is not its proper end.
JsonPiece JsonSplitter::brokenEnd(std::string_view text, std::size_t at, std::string message) {
  JsonPiece end = piece(JsonEvent::endArray, text, Place::top);
  end.at = at;
  end.message = std::move(message);
  return end;
}

JsonPiece JsonSplitter::atBracket(std::string_view rest, bool atEnd) {
  switch (isClosed(rest, rest[0], atEnd)) {
    case Answer::undecided:
      return {};
    case Answer::yes:
      return piece(JsonEvent::record, rest.substr(0, looked_), state_.insideArray() ? Place::record : Place::top);
    case Answer::no:
      break;
  }
  // A record whose brackets do not close is not valid JSON. The reader reports that when it splits the record.
  const std::string_view text = rest.substr(0, looked_);
  JsonPiece unclosed = piece(JsonEvent::record, text, state_.insideArray() ? Place::bad : Place::top);
  unclosed.text = text.substr(0, text.find_last_not_of(kSpace) + 1);
  return unclosed;
}

/// Whether an array or a document of records begins here, and not a record. If so, looked_ is after its bracket.
JsonSplitter::Answer JsonSplitter::beginsArray(std::string_view rest) {
  constexpr std::size_t kLongest = kRecordsField.size() * std::string_view("\\u0070").size();
  if (step_ == 0) {
    looked_ = 1;
    step_ = 1;
  }
  for (;;) {
    looked_ = afterJsonSpace(rest, looked_);
    if (looked_ >= rest.size()) return Answer::undecided;
    const char c = rest[looked_];
    if (rest[0] == '[') {
      looked_ = 1;
      return opensJson(c) || c == ']' ? Answer::yes : Answer::no;
    }
    if (step_ == 1) {
      if (c != '"') return Answer::no;
      const std::size_t end = endOfString(rest.substr(0, looked_ + 2 + kLongest), looked_ + 1);
      if (end >= rest.size()) return Answer::undecided;
      if (end > looked_ + 1 + kLongest || rest[end] != '"') return Answer::no;
      const std::string_view key = rest.substr(looked_ + 1, end - looked_ - 1);
      if (jsonFault("\"" + std::string(key) + "\"") || unescaped(key) != kRecordsField) return Answer::no;
      looked_ = end + 1;
    } else {
      if (c != (step_ == 2 ? ':' : '[')) return Answer::no;
      ++looked_;
      if (step_ == 3) return Answer::yes;
    }
    ++step_;
  }
}

/// Whether a bracket that begins a line, no farther to the right than the record's first one, cannot be in a record.
bool JsonSplitter::endsRecord(char c) const {
  if (c == ']') return state_.insideArray() && (isCut_ || open_.back());
  if (!opensJson(c)) return false;
  const bool isItem = !open_.back() && !isFlat_ && (before_ == '[' || before_ == ',');
  return isCut_ || !(isItem || before_ == ':');
}

/// Moves to the string's end. False if the string continues after the text.
bool JsonSplitter::passString(std::string_view rest) {
  const std::size_t end = endOfString(rest, looked_);
  looked_ = std::min(end, rest.size() - (end > rest.size() ? 1 : 0));  // on a backslash at the text's end
  if (end >= rest.size()) return false;
  inString_ = false;
  if (rest[end] == '"')
    ++looked_;
  else
    isCut_ = true;
  return true;
}

/// Moves looked_ to where all open brackets are closed, or to where they certainly do not close.
JsonSplitter::Answer JsonSplitter::isClosed(std::string_view rest, char open, bool atEnd) {
  if (looked_ == 0) {
    looked_ = 1;
    open_.assign(1, open == '{');
    isFlat_ = open == '[';  // an array of numbers
    isCut_ = lineBegins_ = false;
    before_ = open;
  }
  while (looked_ < rest.size()) {
    if (inString_) {
      if (!passString(rest)) break;
      continue;
    }
    const char c = rest[looked_];
    if (kOrdinary[static_cast<unsigned char>(c)]) {
      do ++looked_;
      while (looked_ < rest.size() && kOrdinary[static_cast<unsigned char>(rest[looked_])]);
      before_ = rest[looked_ - 1];
      lineBegins_ = false;
      continue;
    }
    if (isJsonSpace(c)) {
      ++looked_;
      if (isLineBreak(c)) {
        lineBegins_ = true;
        line_ = looked_;
      }
      continue;
    }
    if (lineBegins_ && looked_ - line_ <= state_.column && endsRecord(c)) return Answer::no;
    lineBegins_ = false;
    before_ = c;
    ++looked_;
    if (c == '"')
      inString_ = true;
    else if (opensJson(c))
      open_.push_back(c == '{');
    else if (!isCut_)
      open_.pop_back();
    if (open_.empty()) return Answer::yes;
  }
  if (!atEnd) return Answer::undecided;
  looked_ = rest.size();
  return Answer::no;
}

JsonPiece JsonSplitter::endOfArray(std::string_view rest, bool atEnd) {
  // A bracket with a comma after it ends nothing, except in a document, where a name may follow.
  if (step_ == 0) looked_ = step_ = 1;
  if (step_ == 1) {
    looked_ = state_.inDocument ? afterJsonSpace(rest, looked_)
                                : std::min(rest.find_first_not_of(" \t", looked_), rest.size());
    if (looked_ == rest.size() && !atEnd) return {};
    const bool hasComma = looked_ < rest.size() && rest[looked_] == ',';
    if (!hasComma && !state_.inDocument) return piece(JsonEvent::endArray, rest.substr(0, 1), Place::top);
    line_ = ++looked_;
    step_ = hasComma ? 2 : 3;
  }
  if (step_ == 2) {  // line_ is after the comma
    looked_ = state_.inDocument ? afterJsonSpace(rest, looked_) : rest.size();
    if (state_.inDocument && looked_ == rest.size() && !atEnd) return {};
    if (looked_ == rest.size() || (rest[looked_] != '"' && rest[looked_] != '}')) {
      JsonPiece extra = bad(rest.substr(0, line_), 0, kNoSeparator);
      state_.place = Place::comma;
      return extra;
    }
  }
  if (step_ < 4) looked_ = 0;  // isClosed begins
  step_ = 4;
  return endOfDocument(rest, atEnd);
}

JsonPiece JsonSplitter::endOfDocument(std::string_view rest, bool atEnd) {
  const Answer closed = isClosed(rest, '{', atEnd);
  if (closed == Answer::undecided) return {};
  const std::string_view text = rest.substr(0, looked_);
  state_.inDocument = false;
  if (closed == Answer::no) return brokenEnd(text, text.size(), "the document is not closed; expected }");
  constexpr std::string_view kBefore = "{\"points\":[";
  try {
    (void)jsonParts(std::string(kBefore) + std::string(text));
  } catch (const RecordError& e) {
    return brokenEnd(text, e.offset - std::min(e.offset, kBefore.size()), e.what());
  }
  return piece(JsonEvent::endArray, text, Place::top);
}

/// Text that does not begin like a record: up to the next bracket or the end of its line, in an array also to a comma.
JsonPiece JsonSplitter::junk(std::string_view rest, bool atEnd, const char* message) {
  const auto ends = [&](char c) {
    return isLineBreak(c) || opensJson(c) || (state_.insideArray() && (c == ',' || c == ']'));
  };
  while (looked_ < rest.size() && (looked_ == 0 || inString_ || !ends(rest[looked_]))) {
    if (!inString_)
      inString_ = rest[looked_++] == '"';
    else if (!passString(rest))
      break;
  }
  if (inString_ || looked_ == rest.size()) {
    if (!atEnd) return {};
    looked_ = rest.size();
  }
  return bad(rest.substr(0, looked_), 0, message);
}

}  // namespace viewproj::cmd
