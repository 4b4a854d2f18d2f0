// Where one JSON record of a stream ends and the next begins.
#pragma once

#include <cstddef>
#include <string_view>

#include "input/json_text.hpp"

namespace viewproj::cmd {

/// A record border that needs no look at what comes before: a line break, white space around it allowed, between a
/// closing and an opening bracket. Valid JSON has none inside of a value, for a comma would stand there. Returns the
/// offset of the opening bracket of the last one whose line break is at `from` or behind it, or npos.
std::size_t lastBorder(std::string_view text, std::size_t from = 0);

/// What the next bytes of a stream are.
enum class JsonEvent {
  needMore,    ///< not decided by the bytes at hand
  record,      ///< text is one record, or a value in an array that can be none
  beginArray,  ///< text is what stands before the first record: `[`, or `{"points": [`
  endArray,    ///< text is what follows the last record: `]`, or `]` and the rest of the document
  end,
};

struct JsonPiece {
  JsonEvent event = JsonEvent::needMore;
  std::string_view text;
  std::size_t end = 0;  ///< how many bytes are used up with it
};

/// Cuts a stream into pieces, from left to right.
class JsonSplitter {
 public:
  /// elements: what comes is the records of an array, separated by white space alone. cut: where the text ends, another
  /// record begins.
  explicit JsonSplitter(bool elements = false, bool cut = false) : elements_(elements), cut_(cut) {}

  /// rest: all bytes behind the last piece, which begin with the same ones if the last call needed more. atEnd: no more
  /// will follow. Throws RecordError, at an offset of rest, where no record can be.
  JsonPiece next(std::string_view rest, bool atEnd);

  /// Between an array's brackets.
  bool insideArray() const { return place_ != Place::top; }

 private:
  enum class Place { top, firstInArray, inArray, afterRecord };

  JsonPiece atBracket(std::string_view rest, std::size_t at, bool atEnd);
  JsonPiece atScalar(std::string_view rest, std::size_t at, bool atEnd);
  JsonPiece endOfArray(std::string_view rest, std::size_t at, bool atEnd);
  JsonPiece piece(JsonEvent event, std::string_view rest, std::size_t begin, std::size_t end);
  /// The end of the bracketed value that starts at begin; npos: not there yet, or a border comes first, which border_
  /// tells then. Remembers how far it looked.
  std::size_t closing(std::string_view rest, std::size_t begin, std::size_t openBefore, bool atEnd);
  [[noreturn]] static void failUnclosed(std::string_view rest, std::size_t begin, std::size_t end);

  bool elements_, cut_;
  Place place_ = Place::top;
  bool inDocument_ = false;
  // How far the scan of an unfinished value came.
  std::size_t scanned_ = 0, depth_ = 0;
  bool inString_ = false;
  std::size_t border_ = std::string_view::npos;
};

}  // namespace viewproj::cmd
