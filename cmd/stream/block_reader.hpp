// Reads the input in blocks of complete records: the work that only one thread at a time can do.
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
  TextPosition position;             ///< of the first byte; for f64, line is the record's number
  JsonState state;                   ///< JSON: after everything before the block
  bool last = false;                 ///< the input ends after this block
  std::optional<StreamFault> fault;  ///< an error after the records; nothing follows
};

class BlockReader {
 public:
  static constexpr std::size_t kBlock = 64 << 10;  ///< bytes to read at a time
  /// block: used instead of kBlock.
  explicit BlockReader(std::unique_ptr<InputFile> file, std::size_t block = kBlock);
  /// Reads these bytes instead of a file.
  explicit BlockReader(std::string_view bytes) : atEnd_(true) { carried_ += bytes; }

  /// The first bytes of the input, enough to tell its format: up to the end of the first line that is not blank or a
  /// comment; at most two bytes if the first is a bracket, so that it need not wait for a record. They do not depend on
  /// how the input arrives.
  std::string_view firstBytes();

  /// If the format is any text, skips a byte order mark. Throws InputError at one of UTF-16 or UTF-32.
  void setForm(Form form, char separator = ',');

  /// CSV: the first line that is not blank, and its position.
  struct Line {
    std::string text;
    TextPosition position;
  };
  std::optional<Line> firstLine();
  void passFirstLine() { drop(firstLineEnd_); }

  /// Reads the next block; its old content is lost. False at the end of the input.
  bool next(Block& block);

  const std::string& name() const { return name_; }
  std::optional<std::size_t> totalBytes() const { return total_; }
  std::size_t blockSize() const { return block_; }

 private:
  /// How many bytes of text are complete records; 0 if more are needed. text must begin with the text of the last call.
  std::size_t completeRecords(std::string_view text);
  std::size_t completeJson(std::string_view text);
  /// Reads once and appends to bytes, up to a size of `most`.
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
  TextBuffer carried_;  ///< read but not yet returned in a block
  bool atEnd_ = false, over_ = false;
  TextPosition position_;  ///< of carried_
  std::size_t firstLineEnd_ = 0;
  // How far completeRecords has searched line breaks and split JSON, and where the last complete record ends.
  std::size_t searched_ = 0, lookedAt_ = 0, completeEnd_ = 0;
  CsvEnds csv_;
  JsonSplitter splitter_;
  JsonState state_;  ///< after the complete records
};

}  // namespace viewproj::cmd
