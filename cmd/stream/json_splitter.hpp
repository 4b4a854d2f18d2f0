// Where one JSON record of a stream ends and the next begins, in good JSON and in broken JSON: a property of the text
// alone. "What is broken" in cmd/README.md states the rules.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "text/json_text.hpp"

namespace viewproj::cmd {

/// A line of JSON ends with LF, CRLF or CR.
inline bool isLineBreak(char c) { return c == '\n' || c == '\r'; }
/// The first or last line break at `at` or after or before it, or npos.
std::size_t findLineBreak(std::string_view text, std::size_t at);
std::size_t findLastLineBreak(std::string_view text);

/// A JSON record that is longer is an error, and so is one of any other form.
inline constexpr std::size_t kLongestRecord = 64 << 20;

/// A record border that needs no look at what comes before: a line that begins with an opening bracket after one that
/// ends with a closing bracket. Valid JSON has none inside of a value, for a comma would stand there. Returns the
/// offset of the last such opening bracket that is at `from` or after it, or npos.
std::size_t lastBorder(std::string_view text, std::size_t from = 0);

/// Whether an array or a document of records may begin in text, bracket and all; false is certain.
bool mayOpenArray(std::string_view text);

/// What the next bytes of a stream are.
enum class JsonEvent {
  needMore,    ///< not decided by the bytes at hand
  passed,      ///< nothing of its own: white space, a comma of an array, the rest of what was bad
  record,      ///< text is one record, its brackets closed
  bad,         ///< text is none, as message says
  beginArray,  ///< text is what stands before the first record: `[`, or `{"points": [`
  endArray,  ///< text is what follows the last record: `]`, or `]` and the rest of the document. message: it is broken
  end,
};

struct JsonPiece {
  JsonEvent event = JsonEvent::needMore;
  std::string_view text = {};
  std::size_t end = 0;  ///< how many bytes are used up with it
  std::string message = {};
  std::size_t at = 0;  ///< in the rest, where the message points
};

/// What is to be known of all that comes before a piece.
struct JsonState {
  enum class Place : char { top, firstInArray, inArray, afterRecord, afterBad };
  enum class Passing : char { nothing, junk, lines };  ///< over the rest of what is bad

  Place place = Place::top;
  bool inDocument = false;
  Passing passing = Passing::nothing;
  bool inString = false, escaped = false;  ///< of junk
  std::size_t linesColumn = 0;             ///< lines: where the bad record began in its line
  std::size_t column = 0;                  ///< bytes of the line
  bool lineIsBlank = true;                 ///< so far
  bool newLine = false;                    ///< since the last piece that was not white space
  char before = 0;                         ///< the last byte that is not white space
  std::size_t arrayColumn = 0;
  bool onArraysLine = false;  ///< the array began in the line of the last piece

  /// A bit for each byte of a stretch of the text: a bracket that was found not to be closed before the stretch ends.
  /// No record that begins with one is looked through again.
  std::shared_ptr<const std::vector<bool>> unclosed;
  std::size_t unclosedAt = 0;      ///< where in the stretch the next byte is
  bool unclosedCutsLines = false;  ///< what does not close there goes on to a line that begins as a record does
};

/// Cuts a stream into pieces, from left to right.
class JsonSplitter {
 public:
  explicit JsonSplitter(const JsonState& state = {}) : state_(state) {}

  enum class End { open, ofBlock, ofInput };
  /// rest: all bytes after the last piece, which begin with the same ones if the last call needed more. end: what it
  /// ends with; ofBlock: where another splitter found a piece to end.
  JsonPiece next(std::string_view rest, End end);
  /// Without it no time is spent on what exactly is wrong with a record that is not closed.
  void explain(bool faults) { explains_ = faults; }

  /// Between an array's brackets.
  bool insideArray() const { return state_.place != JsonState::Place::top; }
  /// Nothing of what comes next was looked at.
  bool isFresh() const { return !insideArray() && state_.passing == JsonState::Passing::nothing && !state_.unclosed; }
  /// One who begins here, with this state, finds the same pieces.
  const JsonState& state() const { return state_; }

 private:
  enum class Scan { closed, failed, needMore };
  enum class DocumentStart { no, yes, undecided };

  JsonPiece pass(std::string_view rest);
  JsonPiece afterRecord(std::string_view rest, std::size_t at, bool atEnd);
  JsonPiece atEndOf(std::string_view rest, End end);
  JsonPiece atBracket(std::string_view rest, std::size_t at, bool atEnd);
  JsonPiece endOfArray(std::string_view rest, std::size_t at, bool atEnd);
  JsonPiece endOfDocument(std::string_view rest, std::size_t at, bool atEnd);
  JsonPiece brokenEnd(std::string_view rest, std::size_t end, const std::string& message);
  JsonPiece junk(std::string_view rest, std::size_t at, const char* message);
  JsonPiece missing(std::string_view rest, std::size_t at, const char* message, JsonState::Place next);
  JsonPiece unclosedRecord(std::string_view rest, std::size_t at, std::size_t end, bool passLines, bool tooLong);
  JsonPiece failedRecord(std::string_view rest, std::size_t at);
  JsonPiece piece(JsonEvent event, std::string_view rest, std::size_t begin, std::size_t end);
  void moveOn(std::string_view over, bool blank);

  Scan scan(std::string_view rest, std::size_t begin, char open, bool flat, bool atEnd);
  void noteUnclosed(std::string_view rest, std::size_t begin);
  bool isKnownUnclosed(std::size_t at) const;
  std::size_t nextLineOfRecord(std::string_view rest, std::size_t from, std::size_t end, std::size_t column) const;
  std::size_t columnOf(std::string_view rest, std::size_t at) const;
  bool endsArraysLine(std::string_view rest, std::size_t at) const;
  DocumentStart documentStart(std::string_view rest, std::size_t at);
  DocumentStart arrayStart(std::string_view rest, std::size_t at);

  JsonState state_;

  // How far an unfinished piece was looked at.
  std::size_t scanned_ = 0;
  std::vector<bool> open_;  ///< the brackets that are; true: {
  bool inString_ = false, lineBegins_ = false;
  std::size_t line_ = 0, column_ = 0;
  char before_ = 0;
  std::size_t lastEnd_ = 0;    ///< a line in it that begins as an array's end does; npos: none
  std::size_t firstLine_ = 0;  ///< in it that begins as a record does; npos: none
  bool flat_ = false, cutLines_ = false, tooLong_ = false;
  std::size_t looked_ = 0;
  int step_ = 0;
  bool explains_ = true;
};

}  // namespace viewproj::cmd
