// The input in blocks of whole records: the part of a stream's work that only one thread at a time can do.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "stream/json_splitter.hpp"
#include "text/csv.hpp"
#include "text/file.hpp"
#include "text/form.hpp"
#include "text/json_text.hpp"

namespace viewproj::cmd {

/// Bytes, which no one makes zero first.
class ByteBuffer {
 public:
  char* data() { return data_.get(); }
  std::size_t size() const { return size_; }
  std::size_t capacity() const { return capacity_; }
  std::string_view view() const { return {data_.get(), size_}; }
  void resize(std::size_t size) { size_ = size; }
  /// Keeps the bytes.
  void reserve(std::size_t capacity);
  void assign(std::string_view bytes);

 private:
  std::unique_ptr<char[]> data_;
  std::size_t size_ = 0, capacity_ = 0;
};

struct StreamFault {
  TextPosition position;
  std::string message;
};

/// What stands around a block's records.
struct BlockFrame {
  std::size_t inputBytes = 0;        ///< of the whole input that the block takes up
  std::string opening;               ///< an array begins here: what stands before its first record
  std::string closing;               ///< and ends here: what stands after its last one
  std::optional<StreamFault> fault;  ///< what is wrong after the records: nothing follows
};

/// A part of the input that ends after a record.
struct Block : BlockFrame {
  ByteBuffer bytes;
  std::string_view records;  ///< in bytes. JSON: separated by white space alone, commas of an array made blank
  TextPosition position;     ///< of the first of records. f64: line is the record's number
  bool last = false;         ///< the input ends after it
  bool inArray = false;      ///< the records are an array's
  JsonState state;           ///< JSON, outside of an array: of all that comes before the records
  /// JSON, in an array: what is wrong between the records, or in their place, which was made blank, line breaks apart.
  struct Bad {
    std::size_t begin, at;  ///< offsets in records: of what is wrong, and where the message points
    std::string message;
  };
  std::vector<Bad> bad;
};

class BlockReader {
 public:
  static constexpr std::size_t kBlock = 64 << 10;  ///< bytes that are read at a time
  /// block: in place of kBlock.
  explicit BlockReader(std::unique_ptr<InputFile> file, std::size_t block = kBlock);
  /// Of bytes given instead of a file.
  explicit BlockReader(const std::string& bytes);

  /// The first bytes of the input, enough to tell its form: to the end of the first line that is no blank or comment;
  /// no more than two where a bracket begins, so that a record is not waited for. However the input arrives, they are
  /// the same.
  std::string_view firstBytes();

  /// Throws InputError where the first bytes are of text in UTF-16 or UTF-32.
  void requireUtf8();

  /// Passes over a byte order mark, where the form is text of any kind.
  void setForm(Form form, const CsvFormat& format = {});

  /// CSV: the first line that is not blank, and where it stands. It is taken, unless it is to be read again.
  struct Line {
    std::string text;
    TextPosition position;
  };
  std::optional<Line> firstLine(bool take);

  /// False at the end of the input. What the block held before is lost.
  bool next(Block& block);

  const std::string& name() const { return name_; }
  std::optional<std::size_t> totalBytes() const { return total_; }
  std::size_t blockSize() const { return block_; }

 private:
  /// How many bytes of text are whole records; 0: more are needed. Sets the block's array and fault.
  std::size_t wholeRecords(Block& block, std::string_view text);
  std::size_t wholeJson(Block& block, std::string_view text);
  std::size_t wholeArrayRecords(Block& block, std::string_view text);
  std::size_t wholeArray(JsonSplitter& splitter, std::string_view text) const;
  /// JSON: what a long record that does not close leaves is given out in blocks as large as others.
  bool isMuch(std::string_view text) const { return text.size() > 4 * block_ && !failed_; }
  bool isFull(std::size_t whole, std::string_view text) const {
    return whole >= block_ && whole < text.size() && isMuch(text);
  }
  /// Takes what the block is made of out of `bytes`, and keeps the rest for the next one.
  void keepRest(Block& block, std::size_t from, std::size_t whole);
  /// Whether a record can end in bytes that were not looked at yet.
  bool mayEndRecord(std::string_view fresh) const;
  /// Reads into carried_ until what is new has a line break, or no more is to be had or to be kept.
  void readToLineBreak();
  /// Reads once, after what bytes hold, until they are `most` at the most.
  void readMore(ByteBuffer& bytes, std::size_t most);
  void moveOn(std::string_view text);

  std::string name_;
  std::unique_ptr<InputFile> file_;
  std::optional<std::size_t> total_;
  std::size_t block_ = kBlock;
  Form form_ = Form::json;
  CsvFormat format_;
  ByteBuffer carried_;     ///< read, not yet given out
  std::size_t given_ = 0;  ///< but for so much of carried_
  bool atEnd_ = false, over_ = false, failed_ = false;
  TextPosition position_;
  JsonState state_;        ///< where carried_ begins
  JsonSplitter splitter_;  ///< on the way through what it holds
  std::size_t lookedAt_ = 0;
  CsvEnds csv_;
};

}  // namespace viewproj::cmd
