// Finds where one JSON record of a stream ends and the next begins, in valid and in broken JSON. The result depends
// only on the text. cmd/README.md states the rules.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace viewproj::cmd {

/// A longer record, in any format, is an error.
inline constexpr std::size_t kLongestRecord = 64 << 20;

/// Finds a border between records without looking at what comes before it: a line that begins with an opening bracket
/// in its first column, after a line that ends with a closing bracket. Returns the offset of the last such opening
/// bracket at or after `from`, or npos.
std::size_t lastBorder(std::string_view text, std::size_t from);

/// Whether an array or a document of records may begin in text. false is certain.
bool mayOpenArray(std::string_view text);

/// The kind of the next bytes of a stream.
enum class JsonEvent {
  needMore,    ///< more bytes are needed to decide
  space,       ///< white space
  comma,       ///< between records of an array
  record,      ///< text is one record, or stands in place of one and does not close its brackets
  bad,         ///< text is not a record; message says why
  beginArray,  ///< text is everything before the first record: `[` or `{"points": [`
  endArray,    ///< text is `]` and the rest of a document; message: why it is broken
  end,
};

struct JsonPiece {
  JsonEvent event = JsonEvent::needMore;
  std::string_view text = {};
  std::size_t end = 0;  ///< how many bytes belong to it
  std::string message = {};
  std::size_t at = 0;  ///< where in text the error is
};

/// What is known of everything before a piece.
struct JsonState {
  /// Outside of arrays; or inside, before the first record, after a comma, after a record, after an error.
  enum class Place : char { top, first, comma, record, bad };

  Place place = Place::top;
  bool inDocument = false;
  std::size_t column = 0;  ///< bytes since the line's beginning

  bool insideArray() const { return place != Place::top; }
  /// Moves the state to the end of passed.
  void moveOver(std::string_view passed);
};

/// Splits a stream into pieces, from left to right, without reading a byte of a record twice.
class JsonSplitter {
 public:
  explicit JsonSplitter(const JsonState& state = {}) : state_(state) {}

  /// What follows rest. block: the end of a piece that another splitter found.
  enum class End { open, block, input };
  /// rest: all bytes after the last piece. If the last call needed more, rest must begin with the same bytes.
  JsonPiece next(std::string_view rest, End end);
  /// A splitter that begins here with this state finds the same pieces.
  const JsonState& state() const { return state_; }

 private:
  enum class Answer { no, yes, undecided };

  JsonPiece piece(JsonEvent event, std::string_view text, JsonState::Place next);
  JsonPiece bad(std::string_view text, std::size_t at, std::string message);
  JsonPiece missing(std::string_view rest, const char* message, JsonState::Place next);
  JsonPiece brokenEnd(std::string_view text, std::size_t at, std::string message);
  JsonPiece atBracket(std::string_view rest, bool atEnd);
  JsonPiece endOfArray(std::string_view rest, bool atEnd);
  JsonPiece endOfDocument(std::string_view rest, bool atEnd);
  JsonPiece junk(std::string_view rest, bool atEnd, const char* message);
  Answer beginsArray(std::string_view rest);
  Answer isClosed(std::string_view rest, char open, bool atEnd);
  bool passString(std::string_view rest);
  bool endsRecord(char c) const;

  JsonState state_;
  // How far an unfinished piece has been read.
  std::size_t looked_ = 0, step_ = 0;
  std::vector<bool> open_;  ///< the open brackets; true for {
  bool isFlat_ = false, inString_ = false, lineBegins_ = false;
  bool isCut_ = false;    ///< a string has a line break; brackets after it do not count
  std::size_t line_ = 0;  ///< where the last line begins
  char before_ = 0;       ///< the last character that is not white space
};

}  // namespace viewproj::cmd
