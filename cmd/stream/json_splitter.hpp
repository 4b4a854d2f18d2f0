// Finds where one JSON record of a stream ends and the next begins, in valid and in broken JSON. cmd/README.md states
// the rules.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace viewproj::cmd {

/// Finds a border between records without looking at what comes before it: a line that begins with an opening bracket
/// in its first column, after a line that ends with a closing bracket. Returns the offset of the last such opening
/// bracket at or after `from`, or npos.
std::size_t lastBorder(std::string_view text, std::size_t from);

/// Whether an array or a document of records may begin in text. false is certain.
bool mayOpenArray(std::string_view text);

/// How far the brackets of a record have been read: the text may grow, and what was read be forgotten.
struct BracketScan {
  std::size_t at = 0;          ///< bytes that were read
  std::string closing = {};    ///< the brackets that will close the open ones
  bool inString = false;       ///< at is in a string
  bool isBroken = false;       ///< a bracket closes none of its kind, or is too deep: the record cannot be valid
  bool isAtLineBegin = false;  ///< only white space is between a line's beginning and at
  std::size_t line = 0;        ///< where the last line begins
  char before = 0;             ///< the last character that is not white space
  std::size_t firstLine = 0;   ///< the first line that begins with an opening bracket, no farther right; 0: none
};

/// What is known of everything before a piece.
struct JsonState {
  /// Outside of arrays; or inside, before the first record, after a comma, after a record, after an error.
  enum class Place : char { top, first, comma, record, bad };

  Place place = Place::top;
  bool inDocument = false;
  std::size_t column = 0;  ///< bytes since the line's beginning
  BracketScan scan = {};   ///< of the record that begins here, if the text ended in it

  bool insideArray() const { return place != Place::top; }
  /// The text that closes the array, or empty.
  std::string_view closing() const { return !insideArray() ? "" : inDocument ? "]}" : "]"; }
  /// Moves the state to the end of passed.
  void moveOver(std::string_view passed);
};

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

/// What follows the text. block: the end of a piece that was found before.
enum class JsonEnd { open, block, input };

/// The first piece of a text, and the state after it. If more is needed, the state keeps how far the record's brackets
/// have been read, and the text of the next call must begin with the same bytes.
JsonPiece nextPiece(std::string_view rest, JsonState& state, JsonEnd end);

/// Moves a scan to the end of a record that begins with a bracket in this column; firstLine tells another end. Returns
/// whether the end is known, which at the end of the input it is.
bool scanBrackets(std::string_view rest, const JsonState& state, bool atEnd, BracketScan& scan);

}  // namespace viewproj::cmd
