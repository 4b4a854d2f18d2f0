// Reads the input in blocks of complete records: the work that only one thread at a time can do.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "records/record.hpp"
#include "stream/json_splitter.hpp"
#include "text/error.hpp"
#include "text/file.hpp"
#include "text/form.hpp"
#include "text/npy_header.hpp"
#include "text/text_buffer.hpp"

namespace viewproj::cmd {

struct StreamFault {
  TextPosition position;
  std::string message;
};

/// A part of the input that ends after a record.
struct Block {
  TextBuffer bytes;
  TextPosition position;             ///< of the first byte; of binary forms, line is the record's number
  JsonState state;                   ///< JSON: after everything before the block
  bool last = false;                 ///< the input ends after this block
  std::optional<StreamFault> bad;    ///< a record after the others that is too long to be held
  std::optional<StreamFault> fault;  ///< an error after the records; nothing follows
};

/// How records of the input end.
struct RecordEnds {
  Form form = Form::json;
  char separator = ',';     ///< of CSV
  std::size_t columns = 0;  ///< of CSV
  std::size_t record = 0;   ///< bytes of a binary record
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

  /// Of text: skips a byte order mark. Throws InputError at one of UTF-16 or UTF-32.
  void passByteOrderMark();
  /// Skips the header of an .npy file. Throws InputError.
  NpyHeader passNpyHeader();

  /// More or fewer records are an error.
  void expectRecords(std::size_t count) { recordsLeft_ = count; }

  /// CSV: the first line that is not blank, and its position.
  struct Line {
    std::string text;
    TextPosition position;
  };
  std::optional<Line> firstLine(char separator);
  void passFirstLine() { drop(firstLineEnd_); }

  void setEnds(const RecordEnds& ends) { ends_ = ends; }

  /// Reads the next block; its old content is lost. False at the end of the input.
  bool next(Block& block);

  const std::string& name() const { return name_; }
  std::optional<std::size_t> totalBytes() const { return total_; }
  std::size_t blockSize() const { return block_; }

 private:
  /// How many bytes of text are complete records; 0 if more are needed.
  std::size_t completeRecords(std::string_view text);
  std::size_t completeJson(std::string_view text);
  std::size_t completeCsv(std::string_view text) const;
  /// Reads once and appends to bytes, up to a size of `most`.
  void readMore(TextBuffer& bytes, std::size_t most);
  void readMore() { readMore(carried_, carried_.size() + block_); }
  void passLongRecord(Block& block);
  void countRecords(Block& block, std::size_t& complete);
  void drop(std::size_t bytes);
  void moveOn(std::string_view text);

  std::string name_;
  std::unique_ptr<InputFile> file_;
  std::optional<std::size_t> total_;
  std::size_t block_ = kBlock;
  RecordEnds ends_;
  TextBuffer carried_;  ///< read but not yet returned in a block
  bool atEnd_ = false, over_ = false;
  TextPosition position_;  ///< of carried_
  std::size_t firstLineEnd_ = 0;
  std::optional<std::size_t> recordsLeft_;
  // JSON: the state after the complete records; and beyond them, where completeEnd_ is the offset of the last end.
  JsonState state_, stateBeyond_;
  std::size_t lookedAt_ = 0, completeEnd_ = 0;
};

}  // namespace viewproj::cmd
