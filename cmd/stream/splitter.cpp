#include "stream/splitter.hpp"

#include <algorithm>
#include <utility>

#include "input/error.hpp"

namespace viewproj::cmd {
namespace {

constexpr std::size_t npos = std::string_view::npos;

std::size_t skipSpace(std::string_view text, std::size_t at) {
  return std::min(text.find_first_not_of(" \t\r\n", at), text.size());
}

bool beginsNumber(char c) { return c == '-' || (c >= '0' && c <= '9'); }

/// Whether an object that starts at `at` has "points" for its first key and an array behind it.
struct DocumentStart {
  enum { no, yes, undecided } is;
  std::size_t end = 0;  ///< behind the array's opening bracket
};

DocumentStart documentStart(std::string_view text, std::size_t at) {
  constexpr std::string_view kKey = "\"points\"";
  at = skipSpace(text, at + 1);
  const std::string_view key = text.substr(at, kKey.size());
  if (!kKey.starts_with(key)) return {DocumentStart::no};
  if (key.size() < kKey.size()) return {DocumentStart::undecided};
  at = skipSpace(text, at + kKey.size());
  if (at >= text.size()) return {DocumentStart::undecided};
  if (text[at] != ':') return {DocumentStart::no};
  at = skipSpace(text, at + 1);
  if (at >= text.size()) return {DocumentStart::undecided};
  if (text[at] != '[') return {DocumentStart::no};
  return {DocumentStart::yes, at + 1};
}

}  // namespace

Piece Splitter::piece(Event event, std::string_view rest, std::size_t begin, std::size_t end) {
  used_ = end;
  scanned_ = depth_ = 0;
  inString_ = false;
  return {event, rest.substr(begin, end - begin), positionAt(rest, begin, position_)};
}

std::size_t Splitter::taken(std::string_view rest) {
  position_ = positionAt(rest, used_, position_);
  return std::exchange(used_, 0);
}

std::size_t Splitter::skip(std::string_view rest, std::size_t bytes) {
  (void)piece(Event::needMore, rest, 0, bytes);
  place_ = Place::top;
  inDocument_ = false;
  return taken(rest);
}

std::size_t Splitter::closing(std::string_view rest, std::size_t begin, std::size_t openBefore) {
  if (scanned_ == 0) {
    scanned_ = begin;
    depth_ = openBefore;
  }
  for (; scanned_ < rest.size(); ++scanned_) {
    const char c = rest[scanned_];
    if (inString_) {
      if (c == '\\') {
        if (scanned_ + 1 == rest.size()) return npos;  // the escaped byte comes with the next block
        ++scanned_;
      } else if (c == '"') {
        inString_ = false;
      }
    } else if (c == '"') {
      inString_ = true;
    } else if (c == '{' || c == '[') {
      ++depth_;
    } else if ((c == '}' || c == ']') && --depth_ == 0) {
      return ++scanned_;
    }
  }
  return npos;
}

Piece Splitter::next(std::string_view rest, bool atEnd) {
  return form_ == Form::json ? nextJson(rest, atEnd) : nextLine(rest, atEnd);
}

Piece Splitter::nextLine(std::string_view rest, bool atEnd) {
  // A line break inside the quotes of a CSV field belongs to the record.
  if (form_ == Form::csv) {
    for (; scanned_ < rest.size(); ++scanned_) {
      if (rest[scanned_] == '"') inString_ = !inString_;
      if (rest[scanned_] == '\n' && !inString_) break;
    }
  } else {
    scanned_ = std::min(rest.find('\n', scanned_), rest.size());
  }
  std::size_t end = scanned_;
  if (end == rest.size()) {
    if (!atEnd) return {};
    if (rest.empty()) return piece(Event::end, rest, 0, 0);
    if (inString_) throw RecordError(rest.rfind('"'), "the quote that opens here is not closed");
  }
  const std::size_t behind = std::min(end + 1, rest.size());
  if (end > 0 && rest[end - 1] == '\r') --end;
  Piece line = piece(Event::record, rest, 0, end);
  used_ = behind;
  return line;
}

Piece Splitter::nextJson(std::string_view rest, bool atEnd) {
  std::size_t at = skipSpace(rest, 0);
  if (at >= rest.size()) {
    if (!atEnd) return {};
    if (place_ == Place::top) return piece(Event::end, rest, at, at);
    throw RecordError(at, "the input ends inside an array; expected ]");
  }
  const bool inArray = place_ != Place::top;
  if (place_ == Place::afterRecord) {
    if (rest[at] == ',') {
      at = skipSpace(rest, at + 1);
      if (at >= rest.size()) {
        if (!atEnd) return {};
        throw RecordError(at, "the input ends behind a comma; expected a record");
      }
    } else if (rest[at] != ']') {
      throw RecordError(at, "expected , or ] behind a record of an array");
    } else {
      place_ = Place::firstInArray;
    }
  }
  if (place_ == Place::firstInArray && rest[at] == ']') {
    if (!inDocument_) {
      place_ = Place::top;
      return piece(Event::endArray, rest, at, at + 1);
    }
    const std::size_t end = closing(rest, at + 1, 1);
    if (end == npos) {
      if (!atEnd) return {};
      throw RecordError(rest.size(), "the input ends inside the document; expected }");
    }
    if (const auto fault = jsonFault("{\"points\":[" + std::string(rest.substr(at, end - at))))
      throw RecordError(at + fault->offset - std::min<std::size_t>(fault->offset, 11), fault->message);
    place_ = Place::top;
    inDocument_ = false;
    return piece(Event::endArray, rest, at, end);
  }

  const char first = rest[at];
  if (!inArray && first == '{') {
    const DocumentStart start = documentStart(rest, at);
    if (start.is == DocumentStart::undecided && !atEnd) return {};
    if (start.is == DocumentStart::yes) {
      place_ = Place::firstInArray;
      inDocument_ = true;
      return piece(Event::beginArray, rest, at, start.end);
    }
  }
  if (!inArray && first == '[') {
    const std::size_t second = skipSpace(rest, at + 1);
    if (second >= rest.size() && !atEnd) return {};
    if (second < rest.size() && !beginsNumber(rest[second])) {
      place_ = Place::firstInArray;
      return piece(Event::beginArray, rest, at, at + 1);
    }
  }
  if (first != '{' && first != '[') throw RecordError(at, "expected a record: an array of numbers or an object");

  const std::size_t end = closing(rest, at, 0);
  if (end == npos) {
    if (!atEnd) return {};
    const auto fault = jsonFault(rest.substr(at));
    throw RecordError(at + (fault ? fault->offset : 0), fault ? fault->message : "not closed");
  }
  if (inArray) place_ = Place::afterRecord;
  return piece(Event::record, rest, at, end);
}

}  // namespace viewproj::cmd
