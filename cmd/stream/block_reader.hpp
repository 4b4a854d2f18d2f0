// The input in blocks of whole records: the part of a stream's work that only one thread at a time can do.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "stream/json_splitter.hpp"
#include "text/csv.hpp"
#include "text/file.hpp"
#include "text/form.hpp"
#include "text/json_text.hpp"
#include "text/text_buffer.hpp"

namespace viewproj::cmd {

struct StreamFault {
  TextPosition position;
  std::string message;
};

/// A part of the input that ends after a record.
struct Block {
  TextBuffer bytes;
  TextPosition position;             ///< of the first byte. f64: line is the record's number
  JsonState state;                   ///< JSON: of all that comes before
  bool last = false;                 ///< the input ends after it
  std::optional<StreamFault> fault;  ///< what is wrong after the records: nothing follows
};

class BlockReader {
 public:
  static constexpr std::size_t kBlock = 64 << 10;  ///< bytes that are read at a time
  /// block: in place of kBlock.
  explicit BlockReader(std::unique_ptr<InputFile> file, std::size_t block = kBlock);
  /// Of bytes given instead of a file.
  explicit BlockReader(std::string_view bytes) : atEnd_(true) { carried_ += bytes; }

  /// The first bytes of the input, enough to tell its form: to the end of the first line that is no blank or comment;
  /// no more than two where a bracket begins, so that a record is not waited for. However the input arrives, they are
  /// the same.
  std::string_view firstBytes();

  /// Where the form is text of any kind, passes over a byte order mark. Throws InputError at one of UTF-16 or UTF-32.
  void setForm(Form form, char separator = ',');

  /// CSV: the first line that is not blank, and where it stands.
  struct Line {
    std::string text;
    TextPosition position;
  };
  std::optional<Line> firstLine();
  void passFirstLine() { drop(firstLineEnd_); }

  /// False at the end of the input. What the block held before is lost.
  bool next(Block& block);

  const std::string& name() const { return name_; }
  std::optional<std::size_t> totalBytes() const { return total_; }
  std::size_t blockSize() const { return block_; }

 private:
  /// How many bytes of text are whole records; 0: more are needed. text begins as it did in the call before.
  std::size_t wholeRecords(std::string_view text);
  std::size_t wholeJson(std::string_view text);
  /// Reads once, after what bytes hold, until they are `most` at the most.
  void readMore(TextBuffer& bytes, std::size_t most);
  void readMore() { readMore(carried_, carried_.size() + block_); }
  void drop(std::size_t bytes);
  void moveOn(std::string_view text);

  std::string name_;
  std::unique_ptr<InputFile> file_;
  std::optional<std::size_t> total_;
  std::size_t block_ = kBlock;
  Form form_ = Form::json;
  char separator_ = ',';
  TextBuffer carried_;  ///< read, not yet given out
  bool atEnd_ = false, over_ = false;
  TextPosition position_;  ///< where carried_ begins
  std::size_t firstLineEnd_ = 0;
  // How far wholeRecords looked for line breaks and cut JSON into pieces, and where the last whole one ends.
  std::size_t searched_ = 0, lookedAt_ = 0, whole_ = 0;
  CsvEnds csv_;
  JsonSplitter splitter_;
  JsonState state_;  ///< after the whole records
};

}  // namespace viewproj::cmd
