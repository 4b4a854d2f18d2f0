// Where one JSON record of a stream ends and the next begins, in good JSON and in broken JSON: a property of the text
// alone. cmd/README.md states the rules.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace viewproj::cmd {

/// A JSON record that is longer is an error, and so is one of any other form.
inline constexpr std::size_t kLongestRecord = 64 << 20;

/// A record border that needs no look at what comes before: a line that begins with an opening bracket, in its first
/// column, after one that ends with a closing bracket. Returns the offset of the last such opening bracket that is at
/// `from` or after it, or npos.
std::size_t lastBorder(std::string_view text, std::size_t from);

/// Whether an array or a document of records may begin in text, bracket and all; false is certain.
bool mayOpenArray(std::string_view text);

/// What the next bytes of a stream are.
enum class JsonEvent {
  needMore,    ///< not decided by the bytes at hand
  space,       ///< white space
  comma,       ///< of an array
  record,      ///< text is one record, or what stands in the place of one and does not close its brackets
  bad,         ///< text is none, as message says
  beginArray,  ///< text is what stands before the first record: `[`, or `{"points": [`
  endArray,    ///< text is what follows the last record: `]` and the rest of a document; message: it is broken
  end,
};

struct JsonPiece {
  JsonEvent event = JsonEvent::needMore;
  std::string_view text = {};
  std::size_t end = 0;  ///< how many bytes are used up with it
  std::string message = {};
  std::size_t at = 0;  ///< in text, where the message points
};

/// What is to be known of all that comes before a piece.
struct JsonState {
  /// Outside of arrays; in one before its first record, after a comma, after a record, after what is bad.
  enum class Place : char { top, first, comma, record, bad };

  Place place = Place::top;
  bool inDocument = false;
  std::size_t column = 0;  ///< bytes of the line

  bool insideArray() const { return place != Place::top; }
  /// So that passed is the text before.
  void moveOver(std::string_view passed);
};

/// Cuts a stream into pieces, from left to right. No byte of a record is looked at twice.
class JsonSplitter {
 public:
  explicit JsonSplitter(const JsonState& state = {}) : state_(state) {}

  /// What rest ends with; block: where another splitter found a piece to end.
  enum class End { open, block, input };
  /// rest: all bytes after the last piece, which begin with the same ones if the last call needed more.
  JsonPiece next(std::string_view rest, End end);
  /// One who begins here, with this state, finds the same pieces.
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
  // How far an unfinished piece was looked at.
  std::size_t looked_ = 0, step_ = 0;
  std::vector<bool> open_;  ///< the brackets that are; true: {
  bool isFlat_ = false, inString_ = false, lineBegins_ = false;
  bool isCut_ = false;    ///< a string has a line break: from there on brackets do not count
  std::size_t line_ = 0;  ///< where the last line begins
  char before_ = 0;       ///< what is no white space
};

}  // namespace viewproj::cmd
