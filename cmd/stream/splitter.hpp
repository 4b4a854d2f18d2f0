// Where one record of a stream ends and the next begins, block by block.
#pragma once

#include <string_view>

#include "input/json_text.hpp"
#include "stream/form.hpp"

namespace viewproj::cmd {

/// What the next bytes of a stream are.
enum class Event {
  needMore,    ///< not decided by the bytes at hand
  record,      ///< text is one record
  beginArray,  ///< JSON: text is what stands before the first record: `[`, or `{"points": [`
  endArray,    ///< JSON: text is what follows the last record: `]`, or `]` and the rest of the document
  end,
};

struct Piece {
  Event event = Event::needMore;
  std::string_view text;
  TextPosition position;  ///< of text's first byte in the stream
};

/// Cuts a stream into pieces. Throws RecordError, at an offset of `rest`, where the bytes cannot be of the form.
class Splitter {
 public:
  explicit Splitter(Form form) : form_(form) {}

  /// rest: all bytes not yet taken; atEnd: no more will follow. Call taken() between two calls that gave a piece.
  Piece next(std::string_view rest, bool atEnd);

  /// How many bytes of rest the last piece used, from its start. The position moves on by them.
  std::size_t taken(std::string_view rest);

  /// Gives up on the first bytes of rest, and starts afresh behind them. Returns bytes.
  std::size_t skip(std::string_view rest, std::size_t bytes);

  TextPosition position() const { return position_; }

  /// JSON: between an array's brackets.
  bool insideArray() const { return place_ != Place::top; }

 private:
  Piece nextJson(std::string_view rest, bool atEnd);
  Piece nextLine(std::string_view rest, bool atEnd);
  Piece piece(Event event, std::string_view rest, std::size_t begin, std::size_t end);
  /// The end of the bracketed value that starts at begin, or npos; remembers how far it looked.
  std::size_t closing(std::string_view rest, std::size_t begin, std::size_t openBefore);

  enum class Place { top, firstInArray, inArray, afterRecord };

  Form form_;
  TextPosition position_;
  std::size_t used_ = 0;
  Place place_ = Place::top;
  bool inDocument_ = false;
  // How far the scan of an unfinished value came.
  std::size_t scanned_ = 0, depth_ = 0;
  bool inString_ = false;
};

}  // namespace viewproj::cmd
