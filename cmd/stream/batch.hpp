// Records in a worker: recognised by their shape, collected in batches, and written with their results.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "records/record_pattern.hpp"
#include "stream/block_reader.hpp"
#include "stream/work.hpp"
#include "text/error.hpp"

namespace viewproj::cmd {

/// A shape that occurred, and where its numbers are.
struct Plan {
  Shape shape;
  Layout layout;
  Results results;
  std::vector<RecordPattern> patterns = {};  ///< for JSON records of this shape, the last used first
};

/// The result of a block.
struct BlockResult {
  TextBuffer out;
  ArrayFrame frame;                     ///< of out
  std::size_t records = 0;              ///< including bad records that --keep-going writes
  std::vector<StreamFault> passedOver;  ///< bad records, with --keep-going
  std::vector<std::string> notes;       ///< each note once
  std::optional<StreamFault> fault;     ///< a bad record that ends the run; out has everything before it
};

struct BatchSetup {
  Form form = Form::json;
  OutputForm to = OutputForm::lines;
  bool convert = false;  ///< from f64 to f64: the work's convert may be used
  bool keepGoing = false;
  bool checkNames = false;  ///< results have names, which must differ from the records' names
  std::string prefix;
};

/// Throws RecordError if a field has the name of a result.
void requireNoClash(const RecordParts& record, const Results& results, const std::string& prefix);

class Batch {
 public:
  /// writer: null to read records only.
  Batch(const BatchSetup& setup, RecordWork& work, RecordWriter* writer, BlockResult& result);

  void begin(const Block& block);
  /// Writes the remaining records. Throws StopBlock.
  void flush();

  /// The plan for records like this one, valid until the next begin(). Throws RecordError.
  Plan& planFor(const RecordParts& record);
  /// All plans, the last used first.
  const std::vector<std::unique_ptr<Plan>>& plans() const { return plans_; }
  void moveToFront(std::size_t plan);

  /// text must be in the block. Throws StopBlock if the run ends.
  void add(std::string_view text, const Plan& plan, const Numbers& numbers);
  void bad(std::string_view text, const RecordError& error);
  /// Returns how many records from the start the work converted at once.
  std::size_t convert(std::span<const double> numbers);
  /// The text as written: `[` or `{"points": [` at the beginning, `]` and the rest of a document at the end.
  void beginArray(std::string_view asWritten);
  void endArray(std::string_view asWritten);

  /// Ends the run after the records that were added.
  struct StopBlock {};

 private:
  struct Row {
    std::string_view text;
    const Plan* plan;  ///< null: a bad record; errors_ has its error
  };

  void note(const std::string& text);
  void writeBad(std::string_view text, const RecordError& error);
  TextPosition positionOf(const char* at);

  const BatchSetup& setup_;
  RecordWork& work_;
  RecordWriter* writer_;
  BlockResult& result_;
  const Block* block_ = nullptr;
  std::vector<std::unique_ptr<Plan>> plans_;
  std::vector<Row> rows_;
  std::vector<RecordError> errors_;
  // The position up to which the block's lines have been counted.
  std::size_t countedTo_ = 0;
  TextPosition countedPosition_;
};

/// Reads the records of a block into a batch. One class per format.
class RecordReader {
 public:
  virtual ~RecordReader() = default;
  /// Throws Batch::StopBlock.
  virtual void read(const Block& block, Batch& batch) = 0;
};

/// byPattern: false splits every record into fields, for comparison.
std::unique_ptr<RecordReader> makeJsonReader(bool byPattern = true);
std::unique_ptr<RecordReader> makeCsvReader(const Shape& header);
std::unique_ptr<RecordReader> makeTextReader();
std::unique_ptr<RecordReader> makeBinaryReader();

}  // namespace viewproj::cmd
