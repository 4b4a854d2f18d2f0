#include "stream/json_splitter.hpp"

#include <algorithm>
#include <string>

#include "input/error.hpp"
#include "input/record.hpp"

namespace viewproj::cmd {
namespace {

constexpr std::size_t npos = std::string_view::npos;
constexpr std::string_view kSpace = " \t\r\n";
constexpr std::string_view kPoints = "points";
constexpr const char* kNoSeparator = "expected , or ] behind a record of an array";

std::size_t skipSpace(std::string_view text, std::size_t at) {
  return std::min(text.find_first_not_of(kSpace, at), text.size());
}

bool beginsNumber(char c) { return c == '-' || (c >= '0' && c <= '9'); }
bool opens(char c) { return c == '{' || c == '['; }
bool closes(char c) { return c == '}' || c == ']'; }

struct BorderAt {
  enum { no, yes, undecided } is = no;
  std::size_t next = 0;  ///< behind the white space: the opening bracket
};

/// Whether the line break at `at` is a border, and with it all of the white space it stands in.
BorderAt borderAt(std::string_view text, std::size_t at) {
  const std::size_t before = text.find_last_not_of(kSpace, at);
  const std::size_t behind = text.find_first_not_of(kSpace, at);
  if (before == npos || !closes(text[before])) return {BorderAt::no, std::min(behind, text.size())};
  if (behind == npos) return {BorderAt::undecided, text.size()};
  return {opens(text[behind]) ? BorderAt::yes : BorderAt::no, behind};
}

/// Whether an object that starts at `at` has "points" for its first key and an array behind it.
struct DocumentStart {
  enum { no, yes, undecided } is;
  std::size_t end = 0;  ///< behind the array's opening bracket
};

DocumentStart documentStart(std::string_view text, std::size_t at) {
  constexpr std::size_t kLongest = kPoints.size() * std::string_view("\\u0070").size();
  at = skipSpace(text, at + 1);
  if (at >= text.size()) return {DocumentStart::undecided};
  if (text[at] != '"') return {DocumentStart::no};
  const std::string_view rest = text.substr(at + 1, kLongest + 1);
  std::size_t end = 0;
  while (end < rest.size() && rest[end] != '"') end += rest[end] == '\\' ? 2 : 1;
  if (end >= rest.size()) return {rest.size() > kLongest ? DocumentStart::no : DocumentStart::undecided};
  const std::string_view key = rest.substr(0, end);
  if (jsonFault("\"" + std::string(key) + "\"") || unescaped(key) != kPoints) return {DocumentStart::no};
  at = skipSpace(text, at + end + 2);
  if (at >= text.size()) return {DocumentStart::undecided};
  if (text[at] != ':') return {DocumentStart::no};
  at = skipSpace(text, at + 1);
  if (at >= text.size()) return {DocumentStart::undecided};
  if (text[at] != '[') return {DocumentStart::no};
  return {DocumentStart::yes, at + 1};
}

}  // namespace

std::size_t lastBorder(std::string_view text, std::size_t from) {
  // No farther back than `from`: what stands before was looked at.
  const auto lineBreakBefore = [&](std::size_t end) {
    const std::size_t at = end > from ? text.substr(from, end - from).rfind('\n') : npos;
    return at == npos ? npos : from + at;
  };
  for (std::size_t at = lineBreakBefore(text.size()); at != npos; at = lineBreakBefore(at)) {
    if (const BorderAt border = borderAt(text, at); border.is == BorderAt::yes) return border.next;
    at = text.find_last_not_of(kSpace, at);
    if (at == npos) return npos;
  }
  return npos;
}

JsonPiece JsonSplitter::piece(JsonEvent event, std::string_view rest, std::size_t begin, std::size_t end) {
  scanned_ = depth_ = 0;
  inString_ = false;
  border_ = npos;
  return {event, rest.substr(begin, end - begin), end};
}

std::size_t JsonSplitter::closing(std::string_view rest, std::size_t begin, std::size_t openBefore, bool atEnd) {
  if (scanned_ == 0) {
    scanned_ = begin;
    depth_ = openBefore;
  }
  for (; scanned_ < rest.size(); ++scanned_) {
    const char c = rest[scanned_];
    if (c == '\n') {
      const BorderAt border = borderAt(rest, scanned_);
      if (border.is == BorderAt::undecided && !atEnd) return npos;
      if (border.is == BorderAt::yes) {
        border_ = border.next;
        return npos;
      }
      scanned_ = border.next - 1;
    } else if (inString_) {
      if (c == '\\') {
        if (scanned_ + 1 == rest.size()) return npos;  // the escaped byte comes with the next block
        ++scanned_;
      } else if (c == '"') {
        inString_ = false;
      }
    } else if (c == '"') {
      inString_ = true;
    } else if (opens(c)) {
      ++depth_;
    } else if (closes(c) && --depth_ == 0) {
      return ++scanned_;
    }
  }
  return npos;
}

/// end: where the next record begins, or the input ends.
void JsonSplitter::failUnclosed(std::string_view rest, std::size_t begin, std::size_t end) {
  end = rest.find_last_not_of(kSpace, end - 1) + 1;
  const auto fault = jsonFault(rest.substr(begin, end - begin));
  if (!fault) throw RecordError(begin, "not closed");
  std::string message = fault->message;
  constexpr std::string_view kTheirs = "end of input", kOurs = "end of the record";
  if (const std::size_t at = message.find(kTheirs); at != npos) message.replace(at, kTheirs.size(), kOurs);
  throw RecordError(begin + fault->offset, message);
}

JsonPiece JsonSplitter::next(std::string_view rest, bool atEnd) {
  std::size_t at = skipSpace(rest, 0);
  if (at >= rest.size()) {
    if (!atEnd) return {};
    if (place_ == Place::top) return piece(JsonEvent::end, rest, at, at);
    const bool between = place_ == Place::afterRecord;
    throw RecordError(at, between && cut_ ? kNoSeparator : "the input ends inside an array; expected ]");
  }
  if (place_ == Place::afterRecord) {
    if (rest[at] == ',') {
      at = skipSpace(rest, at + 1);
      if (at >= rest.size()) {
        if (!atEnd) return {};
        throw RecordError(at, "the input ends behind a comma; expected a record");
      }
    } else if (rest[at] != ']') {
      throw RecordError(at, kNoSeparator);
    } else {
      return endOfArray(rest, at, atEnd);
    }
  }
  if (place_ == Place::firstInArray && rest[at] == ']') return endOfArray(rest, at, atEnd);
  return atBracket(rest, at, atEnd);
}

JsonPiece JsonSplitter::endOfArray(std::string_view rest, std::size_t at, bool atEnd) {
  if (!inDocument_) {
    place_ = Place::top;
    return piece(JsonEvent::endArray, rest, at, at + 1);
  }
  const std::size_t end = closing(rest, at + 1, 1, atEnd);
  if (end == npos) {
    if (!atEnd && border_ == npos) return {};
    throw RecordError(std::min(border_, rest.size()), "the document is not closed; expected }");
  }
  constexpr std::string_view kBefore = "{\"points\":[";
  const std::string document = std::string(kBefore) + std::string(rest.substr(at, end - at));
  const auto fail = [&](std::size_t offset, const std::string& message) {
    throw RecordError(at + offset - std::min(offset, kBefore.size()), message);
  };
  if (const auto fault = jsonFault(document)) fail(fault->offset, fault->message);
  JsonParts parts(document);
  parts.next();
  while (const auto part = parts.next())
    if (unescaped(part->key) == kPoints) fail(part->offset, "has the field 'points' twice");
  place_ = Place::top;
  inDocument_ = false;
  return piece(JsonEvent::endArray, rest, at, end);
}

JsonPiece JsonSplitter::atBracket(std::string_view rest, std::size_t at, bool atEnd) {
  const char first = rest[at];
  const bool mayOpenArray = place_ == Place::top && !elements_;
  if (mayOpenArray && first == '{') {
    const DocumentStart start = documentStart(rest, at);
    if (start.is == DocumentStart::undecided && !atEnd) return {};
    if (start.is == DocumentStart::yes) {
      place_ = Place::firstInArray;
      inDocument_ = true;
      return piece(JsonEvent::beginArray, rest, at, start.end);
    }
  }
  if (mayOpenArray && first == '[') {
    const std::size_t second = skipSpace(rest, at + 1);
    if (second >= rest.size() && !atEnd) return {};
    if (second < rest.size() && !beginsNumber(rest[second])) {
      place_ = Place::firstInArray;
      return piece(JsonEvent::beginArray, rest, at, at + 1);
    }
  }
  if (!opens(first)) return atScalar(rest, at, atEnd);

  const std::size_t end = closing(rest, at, 0, atEnd);
  if (end == npos) {
    if (!atEnd && border_ == npos) return {};
    failUnclosed(rest, at, std::min(border_, rest.size()));
  }
  if (place_ != Place::top) place_ = Place::afterRecord;
  return piece(JsonEvent::record, rest, at, end);
}

/// Between the brackets of an array it can be told where a value ends that is no record: only that one is bad.
JsonPiece JsonSplitter::atScalar(std::string_view rest, std::size_t at, bool atEnd) {
  std::size_t end = at + 1;
  if (rest[at] == '"') {
    while (end < rest.size() && rest[end] != '"' && rest[end] != '\n') end += rest[end] == '\\' ? 2 : 1;
    end = std::min(end + 1, rest.size());
  } else {
    end = std::min(rest.find_first_of(" \t\r\n,[]{}\"", end), rest.size());
  }
  const bool inArray = place_ != Place::top || elements_;
  if (inArray && end == rest.size() && !atEnd) return {};
  if (!inArray || jsonFault(rest.substr(at, end - at))) throw RecordError(at, kNoRecord);
  if (place_ != Place::top) place_ = Place::afterRecord;
  return piece(JsonEvent::record, rest, at, end);
}

}  // namespace viewproj::cmd
