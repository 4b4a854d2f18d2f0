#include "stream/json_splitter.hpp"

#include <algorithm>
#include <array>

#include "records/record.hpp"
#include "text/error.hpp"
#include "text/json_scan.hpp"

namespace viewproj::cmd {
namespace {

constexpr std::size_t npos = std::string_view::npos;
constexpr std::string_view kSpace = " \t\r\n";
constexpr std::string_view kPoints = kRecordsField;
constexpr const char* kNoSeparator = "expected , or ] after a record of an array";
constexpr const char* kNotClosed = "the array is not closed; expected ]";

using Place = JsonState::Place;
using Passing = JsonState::Passing;

bool closes(char c) { return c == '}' || c == ']'; }

/// What a scan for brackets passes over at once: all but white space, quotes and brackets.
constexpr std::array<bool, 256> kOrdinary = [] {
  std::array<bool, 256> ordinary{};
  for (std::size_t c = 0; c < 256; ++c) ordinary[c] = true;
  for (const char c : {' ', '\t', '\r', '\n', '"', '{', '[', '}', ']'}) ordinary[static_cast<unsigned char>(c)] = false;
  return ordinary;
}();

/// The first byte at `at` or after it that counts within a string: a quote, a backslash or a line break.
std::size_t endOfPlain(std::string_view text, std::size_t at) {
  while (at < text.size() && text[at] != '"' && text[at] != '\\' && !isLineBreak(text[at])) ++at;
  return at;
}

/// What is said of a record that ends unclosed.
JsonFault unclosedFault(std::string_view text) {
  auto fault = jsonFault(text);
  if (!fault) return {0, "not closed"};  // brackets that do not close are none of JSON
  constexpr std::string_view kTheirs = "end of input", kOurs = "end of the record";
  if (const std::size_t at = fault->message.find(kTheirs); at != npos)
    fault->message.replace(at, kTheirs.size(), kOurs);
  return *fault;
}

std::string_view withoutSpaceAfter(std::string_view text) { return text.substr(0, text.find_last_not_of(kSpace) + 1); }

}  // namespace

std::size_t findLineBreak(std::string_view text, std::size_t at) {
  while (at < text.size() && !isLineBreak(text[at])) ++at;
  return at < text.size() ? at : npos;
}

std::size_t findLastLineBreak(std::string_view text) {
  std::size_t at = text.size();
  while (at > 0 && !isLineBreak(text[at - 1])) --at;
  return at > 0 ? at - 1 : npos;
}

std::size_t lastBorder(std::string_view text, std::size_t from) {
  for (std::size_t at = text.find_last_of("{["); at != npos && at > 0 && at >= from;
       at = text.find_last_of("{[", at - 1)) {
    if (!isJsonSpace(text[at - 1])) continue;
    const std::size_t before = text.find_last_not_of(kSpace, at - 1);
    if (before != npos && closes(text[before]) && findLineBreak(text.substr(0, at), before) != npos) return at;
  }
  return npos;
}

bool mayOpenArray(std::string_view text) {
  const std::size_t first = text.find('[');
  if (first == npos) return false;
  for (std::size_t at = first; at != npos; at = text.find('[', at + 1)) {
    const std::size_t inner = afterJsonSpace(text, at + 1);
    if (inner == text.size() || opensJson(text[inner]) || text[inner] == ']') return true;
  }
  for (std::size_t at = text.find('{'); at != npos; at = text.find('{', at + 1)) {
    const std::size_t quote = afterJsonSpace(text, at + 1);
    if (quote == text.size()) return true;
    if (text[quote] != '"') continue;
    const std::string_view key = text.substr(quote + 1, kPoints.size());
    if (key.size() < kPoints.size() || key == kPoints || key.find('\\') != npos) return true;
  }
  return false;
}

void JsonSplitter::moveOn(std::string_view over, bool blank) {
  const std::size_t lineBreak = findLastLineBreak(over);
  const bool broken = lineBreak != npos;
  const std::string_view line = broken ? over.substr(lineBreak + 1) : over;
  state_.column = broken ? line.size() : state_.column + line.size();
  state_.lineIsBlank = (broken || state_.lineIsBlank) && (blank || line.find_first_not_of(kSpace) == npos);
  if (blank) {
    state_.newLine |= broken;
  } else {
    if (const std::size_t last = over.find_last_not_of(kSpace); last != npos) state_.before = over[last];
    if (broken || state_.newLine) state_.onArraysLine = false;
    state_.newLine = false;
  }
  scanned_ = looked_ = 0;
  step_ = 0;
  if (!state_.unclosed) return;
  state_.unclosedAt += over.size();
  if (state_.unclosedAt >= state_.unclosed->size()) state_.unclosed.reset();
}

JsonPiece JsonSplitter::piece(JsonEvent event, std::string_view rest, std::size_t begin, std::size_t end) {
  moveOn(rest.substr(0, end), false);
  return {.event = event, .text = rest.substr(begin, end - begin), .end = end};
}

std::size_t JsonSplitter::columnOf(std::string_view rest, std::size_t at) const {
  const std::size_t lineBreak = findLastLineBreak(rest.substr(0, at));
  return lineBreak == npos ? state_.column + at : at - lineBreak - 1;
}

/// An array that began in the line before is not continued so far to the left.
bool JsonSplitter::endsArraysLine(std::string_view rest, std::size_t at) const {
  const bool newLine = state_.newLine || findLineBreak(rest.substr(0, at), 0) != npos;
  return newLine && state_.onArraysLine && columnOf(rest, at) <= state_.arrayColumn;
}

JsonPiece JsonSplitter::next(std::string_view rest, End end) {
  const bool atEnd = end != End::open;
  if (state_.passing != Passing::nothing)
    if (const JsonPiece passed = pass(rest); passed.end > 0) return passed;
  if (scanned_ > 0) return rest[looked_] == ']' ? endOfDocument(rest, looked_, atEnd) : atBracket(rest, looked_, atEnd);
  const std::size_t at = afterJsonSpace(rest, 0);
  if (at >= rest.size()) {
    if (atEnd) return atEndOf(rest, end);
    if (rest.empty()) return {};
    moveOn(rest, true);
    return {.event = JsonEvent::passed, .end = rest.size()};
  }
  switch (state_.place) {
    case Place::top:
      return opensJson(rest[at]) ? atBracket(rest, at, atEnd) : junk(rest, at, kNoRecord);
    case Place::afterRecord:
    case Place::afterBad:
      return afterRecord(rest, at, atEnd);
    case Place::firstInArray:
      if (rest[at] == ']') return endOfArray(rest, at, atEnd);
      break;
    case Place::inArray:
      break;
  }
  if (rest[at] == ',' || rest[at] == ']') return missing(rest, at, kNoRecord, Place::afterBad);
  if (!opensJson(rest[at])) return junk(rest, at, kNoRecord);
  if (endsArraysLine(rest, at) && state_.place == Place::inArray) {
    const DocumentStart start = arrayStart(rest, at);
    if (start == DocumentStart::undecided && !atEnd) return {};
    if (start == DocumentStart::yes) return brokenEnd(rest, at, kNotClosed);
  }
  return atBracket(rest, at, atEnd);
}

JsonPiece JsonSplitter::afterRecord(std::string_view rest, std::size_t at, bool atEnd) {
  if (rest[at] == ',') {
    JsonPiece comma = piece(JsonEvent::passed, rest, at, at + 1);
    state_.place = Place::inArray;
    return comma;
  }
  if (rest[at] == ']') return endOfArray(rest, at, atEnd);
  if (!opensJson(rest[at])) return junk(rest, at, kNoSeparator);
  DocumentStart start = DocumentStart::yes;
  if (!endsArraysLine(rest, at)) start = arrayStart(rest, at);
  if (start == DocumentStart::undecided && !atEnd) return {};
  if (start == DocumentStart::yes) return brokenEnd(rest, at, kNotClosed);
  if (state_.place == Place::afterBad) return atBracket(rest, at, atEnd);
  return missing(rest, at, kNoSeparator, Place::inArray);
}

JsonPiece JsonSplitter::atEndOf(std::string_view rest, End end) {
  if (state_.place == Place::top) return piece(JsonEvent::end, rest, rest.size(), rest.size());
  const char* const message = end == End::ofBlock              ? kNotClosed
                              : state_.place == Place::inArray ? "the input ends after a comma; expected a record"
                                                               : "the input ends inside an array; expected ]";
  return brokenEnd(rest, rest.size(), message);
}

/// Something that is not there.
JsonPiece JsonSplitter::missing(std::string_view rest, std::size_t at, const char* message, Place next) {
  moveOn(rest.substr(0, at), true);
  state_.place = next;
  return {.event = JsonEvent::bad, .text = rest.substr(at, 0), .end = at, .message = message, .at = at};
}

/// What begins as no record does: to the next bracket, or the end of its line, or of its place in an array.
JsonPiece JsonSplitter::junk(std::string_view rest, std::size_t at, const char* message) {
  const bool quote = rest[at] == '"';
  JsonPiece bad = piece(JsonEvent::bad, rest, at, at + 1);
  bad.message = message;
  bad.at = at;
  if (insideArray()) state_.place = Place::afterBad;
  state_.passing = Passing::junk;
  state_.inString = quote;
  state_.escaped = false;
  return bad;
}

/// Over junk, or over lines until one begins as a record does. Nothing where that is here.
JsonPiece JsonSplitter::pass(std::string_view rest) {
  std::size_t at = 0;
  if (state_.passing == Passing::junk) {
    for (; at < rest.size() && !isLineBreak(rest[at]); ++at) {
      const char c = rest[at];
      if (state_.escaped)
        state_.escaped = false;
      else if (state_.inString && c == '\\')
        state_.escaped = true;
      else if (c == '"')
        state_.inString = !state_.inString;
      else if (!state_.inString && (opensJson(c) || (insideArray() && (c == ',' || c == ']'))))
        break;
    }
    if (at < rest.size()) state_.passing = Passing::nothing;
  } else {
    bool blank = state_.lineIsBlank;
    std::size_t column = state_.column;
    char before = state_.before;
    for (; at < rest.size(); ++at, ++column) {
      const char c = rest[at];
      if (isLineBreak(c)) {
        blank = true;
        column = npos;  // 0 at the next
      } else if (!isJsonSpace(c)) {
        const bool asRecord = opensJson(c) && (column <= state_.linesColumn || closes(before));
        if (blank && (asRecord || (c == ']' && insideArray() && column <= state_.linesColumn))) {
          state_.passing = Passing::nothing;
          break;
        }
        blank = false;
        before = c;
      }
    }
  }
  if (at == 0) return {};
  return piece(JsonEvent::passed, rest, at, at);
}

/// Whether an object that starts at `at` has "points" for its first key and an array after it. looked_ is after that
/// array's opening bracket then.
JsonSplitter::DocumentStart JsonSplitter::documentStart(std::string_view rest, std::size_t at) {
  constexpr std::size_t kLongest = kPoints.size() * std::string_view("\\u0070").size();
  if (step_ == 0) {
    looked_ = at + 1;
    step_ = 1;
  }
  for (;;) {
    looked_ = afterJsonSpace(rest, looked_);
    if (looked_ >= rest.size()) return DocumentStart::undecided;
    const char c = rest[looked_];
    if (step_ == 1) {
      if (c != '"') return DocumentStart::no;
      const std::string_view after = rest.substr(looked_ + 1, kLongest + 1);
      std::size_t end = 0;
      while (end < after.size() && after[end] != '"') end += after[end] == '\\' ? 2 : 1;
      if (end >= after.size()) return after.size() > kLongest ? DocumentStart::no : DocumentStart::undecided;
      const std::string_view key = after.substr(0, end);
      if (jsonFault("\"" + std::string(key) + "\"") || unescaped(key) != kPoints) return DocumentStart::no;
      looked_ += end + 2;
    } else if (step_ == 2) {
      if (c != ':') return DocumentStart::no;
      ++looked_;
    } else {
      if (c != '[') return DocumentStart::no;
      ++looked_;
      return DocumentStart::yes;
    }
    ++step_;
  }
}

/// Whether what starts at `at` is an array or a document of records, were it not in an array.
JsonSplitter::DocumentStart JsonSplitter::arrayStart(std::string_view rest, std::size_t at) {
  if (rest[at] == '{') return documentStart(rest, at);
  looked_ = afterJsonSpace(rest, std::max(looked_, at + 1));
  if (looked_ >= rest.size()) return DocumentStart::undecided;
  const char c = rest[looked_];
  return opensJson(c) || c == ']' ? DocumentStart::yes : DocumentStart::no;
}

JsonPiece JsonSplitter::atBracket(std::string_view rest, std::size_t at, bool atEnd) {
  if (scanned_ == 0) {
    if (state_.place == Place::top) {
      const DocumentStart start = arrayStart(rest, at);
      if (start == DocumentStart::undecided && !atEnd) return {};
      if (start == DocumentStart::yes) {
        const bool document = rest[at] == '{';
        const std::size_t column = columnOf(rest, at);
        JsonPiece begin = piece(JsonEvent::beginArray, rest, at, document ? looked_ : at + 1);
        state_.place = Place::firstInArray;
        state_.inDocument = document;
        state_.arrayColumn = column;
        state_.onArraysLine = true;
        return begin;
      }
    }
    if (isKnownUnclosed(at)) {
      // The text may end where another splitter found the record to end.
      const std::size_t end = std::min(state_.unclosed->size() - state_.unclosedAt, rest.size());
      const std::size_t line = nextLineOfRecord(rest, at + 1, end, columnOf(rest, at));
      return unclosedRecord(rest, at, std::min(line, end), line == npos && state_.unclosedCutsLines, false);
    }
  }
  // Of numbers, or in an array: no brackets belong into it. looked_: what comes after the bracket.
  const bool numbers = scanned_ == 0 && looked_ < rest.size() && beginsJsonNumber(rest[looked_]);
  const bool flat = rest[at] == '[' && (insideArray() || numbers);
  switch (scan(rest, at, rest[at], flat, atEnd)) {
    case Scan::needMore:
      return {};
    case Scan::failed:
      return failedRecord(rest, at);
    case Scan::closed:
      break;
  }
  JsonPiece record = piece(JsonEvent::record, rest, at, scanned_);
  if (insideArray()) state_.place = Place::afterRecord;
  return record;
}

/// On to where all that is open is closed. failed: scanned_ is then where it certainly ends.
JsonSplitter::Scan JsonSplitter::scan(std::string_view rest, std::size_t begin, char open, bool flat, bool atEnd) {
  if (scanned_ == 0) {
    looked_ = begin;
    flat_ = flat;
    scanned_ = begin + 1;
    open_.assign(1, open == '{');
    inString_ = lineBegins_ = cutLines_ = tooLong_ = false;
    before_ = rest[begin];
    column_ = columnOf(rest, begin);
    firstLine_ = lastEnd_ = npos;
  }
  const std::string_view text = rest.substr(0, std::min(rest.size(), begin + kLongestRecord));
  while (scanned_ < text.size() && !open_.empty()) {
    if (inString_) {
      scanned_ = endOfPlain(text, scanned_);
      if (scanned_ == text.size()) break;
      const char c = text[scanned_];
      if (isLineBreak(c)) {
        cutLines_ = true;
        return Scan::failed;
      }
      if (c == '\\') {
        if (scanned_ + 1 == text.size()) break;  // the escaped byte comes with the next block
        scanned_ += isLineBreak(text[scanned_ + 1]) ? 1 : 2;
        continue;
      }
      inString_ = false;
      before_ = c;
      ++scanned_;
      continue;
    }
    const char c = text[scanned_];
    if (kOrdinary[static_cast<unsigned char>(c)]) {
      do ++scanned_;
      while (scanned_ < text.size() && kOrdinary[static_cast<unsigned char>(text[scanned_])]);
      before_ = text[scanned_ - 1];
      lineBegins_ = false;
      continue;
    }
    if (isJsonSpace(c)) {
      if (isLineBreak(c)) {
        lineBegins_ = true;
        line_ = scanned_ + 1;
      }
      ++scanned_;
      continue;
    }
    const bool lineBegins = lineBegins_;
    lineBegins_ = false;
    if (c == '"') {
      inString_ = true;
    } else if (opensJson(c)) {
      if (lineBegins) {
        if (closes(before_)) return Scan::failed;
        if (scanned_ - line_ <= column_) {
          if (firstLine_ == npos) firstLine_ = scanned_;
          if (flat_ || (open_.back() && before_ != ':')) return Scan::failed;
        }
      }
      open_.push_back(c == '{');
    } else {
      if (lineBegins && c == ']' && insideArray() && scanned_ - line_ <= column_) {
        if (firstLine_ == npos) firstLine_ = scanned_;
        lastEnd_ = scanned_;
        if (open_.back()) return Scan::failed;
      }
      if (firstLine_ != npos && (c == '}') != open_.back()) return Scan::failed;
      open_.pop_back();
    }
    before_ = c;
    ++scanned_;
  }
  if (open_.empty()) {
    if (lastEnd_ == npos || rest[begin] == ']') return Scan::closed;
    // It may have been closed by what closes the array.
    const std::size_t after = afterJsonSpace(rest, scanned_);
    if (after == rest.size() && !atEnd) return Scan::needMore;
    if (after < rest.size() && (rest[after] == ',' || rest[after] == ']')) return Scan::closed;
    scanned_ = lastEnd_;
    return Scan::failed;
  }
  tooLong_ = rest.size() >= begin + kLongestRecord;
  if (!atEnd && !tooLong_) return Scan::needMore;
  scanned_ = text.size();
  cutLines_ = tooLong_;
  return Scan::failed;
}

/// Notes all brackets from begin on that are not closed before the scan's end.
void JsonSplitter::noteUnclosed(std::string_view rest, std::size_t begin) {
  const std::string_view text = rest.substr(0, scanned_);
  const auto unclosed = std::make_shared<std::vector<bool>>(text.size());
  for (std::size_t at = begin; at < text.size(); ++at) {
    const char c = text[at];
    if (c == '"') {
      for (++at; at < text.size() && text[at] != '"'; ++at) at += text[at] == '\\';
    } else if (opensJson(c) || closes(c)) {
      (*unclosed)[at] = true;
    }
  }
  std::size_t closing = 0;
  for (std::size_t at = text.size(); at > begin; --at) {
    if (!(*unclosed)[at - 1]) continue;
    const bool closed = closes(text[at - 1]) || closing > 0;
    if (!closed) continue;
    closing = closes(text[at - 1]) ? closing + 1 : closing - 1;
    (*unclosed)[at - 1] = false;
  }
  state_.unclosed = unclosed;
  state_.unclosedAt = 0;
  state_.unclosedCutsLines = cutLines_;
}

bool JsonSplitter::isKnownUnclosed(std::size_t at) const {
  if (!state_.unclosed) return false;
  const std::size_t bit = state_.unclosedAt + at;
  return bit < state_.unclosed->size() && (*state_.unclosed)[bit];
}

/// The first opening bracket between from and end that begins a line no farther right than column; npos: none.
std::size_t JsonSplitter::nextLineOfRecord(std::string_view rest, std::size_t from, std::size_t end,
                                           std::size_t column) const {
  const std::string_view text = rest.substr(0, end);
  for (std::size_t lineBreak = findLineBreak(text, from); lineBreak != npos;
       lineBreak = findLineBreak(text, lineBreak + 1)) {
    const std::size_t first = text.find_first_not_of(" \t", lineBreak + 1);
    if (first == npos) break;
    const bool asRecord = opensJson(text[first]) || (text[first] == ']' && insideArray());
    if (asRecord && first - lineBreak - 1 <= column) return first;
  }
  return npos;
}

/// Of what the scan found not to be closed, the part before the first line that begins as a record does.
JsonPiece JsonSplitter::failedRecord(std::string_view rest, std::size_t at) {
  if (firstLine_ == npos) return unclosedRecord(rest, at, scanned_, cutLines_, tooLong_);
  if (firstLine_ < scanned_) noteUnclosed(rest, at);
  open_ = {};
  return unclosedRecord(rest, at, firstLine_, false, false);
}

JsonPiece JsonSplitter::unclosedRecord(std::string_view rest, std::size_t at, std::size_t end, bool passLines,
                                       bool tooLong) {
  const std::size_t column = columnOf(rest, at);
  JsonPiece bad = piece(JsonEvent::bad, rest, at, end);
  const JsonFault fault = !explains_ ? JsonFault{0, kNotClosed}
                          : tooLong
                              ? JsonFault{0, "a record longer than " + std::to_string(kLongestRecord >> 20) + " MiB"}
                              : unclosedFault(withoutSpaceAfter(bad.text));
  bad.message = fault.message;
  bad.at = at + fault.offset;
  if (passLines) {
    state_.passing = Passing::lines;
    state_.linesColumn = column;
  }
  if (insideArray()) state_.place = Place::afterBad;
  return bad;
}

/// The array ends at `end` without what should end it.
JsonPiece JsonSplitter::brokenEnd(std::string_view rest, std::size_t end, const std::string& message) {
  const std::string_view over = rest.substr(0, end);
  moveOn(over, over.find_first_not_of(kSpace) == npos);
  state_.place = Place::top;
  state_.inDocument = false;
  return {.event = JsonEvent::endArray, .text = rest.substr(end, 0), .end = end, .message = message, .at = end};
}

JsonPiece JsonSplitter::endOfArray(std::string_view rest, std::size_t at, bool atEnd) {
  if (state_.inDocument) {
    // After its array and a comma a name stands.
    if (step_ == 0) {
      looked_ = afterJsonSpace(rest, std::max(looked_, at + 1));
      if (looked_ == rest.size() && !atEnd) return {};
      if (looked_ < rest.size() && rest[looked_] == ',') ++looked_;
      step_ = looked_ > at && looked_ <= rest.size() && rest[looked_ - 1] == ',' ? 1 : 2;
    }
    if (step_ == 1) {
      looked_ = afterJsonSpace(rest, looked_);
      if (looked_ == rest.size() && !atEnd) return {};
      if (looked_ < rest.size() && rest[looked_] != '"' && rest[looked_] != '}') return junk(rest, at, kNoSeparator);
      step_ = 2;
    }
    return endOfDocument(rest, at, atEnd);
  }
  if (state_.place != Place::firstInArray) {
    // An array does not end before a comma.
    looked_ = std::min(rest.find_first_not_of(" \t", std::max(looked_, at + 1)), rest.size());
    if (looked_ == rest.size() && !atEnd) return {};
    if (looked_ < rest.size() && (rest[looked_] == ',' || rest[looked_] == '}')) return junk(rest, at, kNoSeparator);
  }
  JsonPiece end = piece(JsonEvent::endArray, rest, at, at + 1);
  state_.place = Place::top;
  return end;
}

JsonPiece JsonSplitter::endOfDocument(std::string_view rest, std::size_t at, bool atEnd) {
  const std::size_t column = columnOf(rest, at);
  const Scan found = scan(rest, at, '{', false, atEnd);
  if (found == Scan::needMore) return {};
  if (found == Scan::failed) {
    const bool passLines = firstLine_ == npos && cutLines_;
    JsonPiece broken = brokenEnd(rest, std::min(firstLine_, scanned_), "the document is not closed; expected }");
    if (passLines) {
      state_.passing = Passing::lines;
      state_.linesColumn = column;
    }
    return broken;
  }
  const std::size_t end = scanned_;
  constexpr std::string_view kBefore = "{\"points\":[";
  const std::string document = std::string(kBefore) + std::string(rest.substr(at, end - at));
  const auto broken = [&](std::size_t offset, const std::string& message) {
    JsonPiece bad = brokenEnd(rest, end, message);
    bad.at = at + offset - std::min(offset, kBefore.size());
    bad.text = rest.substr(bad.at, 0);
    return bad;
  };
  if (const auto fault = jsonFault(document)) return broken(fault->offset, fault->message);
  JsonParts parts(document);
  parts.next();
  while (const auto part = parts.next())
    if (unescaped(part->key) == kPoints) return broken(part->offset, "has the field 'points' twice");
  JsonPiece closed = piece(JsonEvent::endArray, rest, at, end);
  state_.place = Place::top;
  state_.inDocument = false;
  return closed;
}

}  // namespace viewproj::cmd
