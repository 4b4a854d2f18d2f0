// Records on their way through a worker: recognised by their shape, gathered in batches, written with their results.
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

/// A shape that was met, and where its numbers are.
struct Plan {
  Shape shape;
  Layout layout;
  Results results;
  std::vector<RecordPattern> patterns = {};  ///< of JSON records of it that were met, the one used last first
};

/// What became of a block.
struct BlockResult {
  TextBuffer out;
  ArrayFrame frame;                     ///< of out
  std::size_t records = 0;              ///< the bad ones that --keep-going puts there included
  std::vector<StreamFault> passedOver;  ///< --keep-going
  std::vector<std::string> notes;       ///< each once
  std::optional<StreamFault> fault;     ///< a record that ends the run: out has what came before it
};

struct BatchSetup {
  Form form = Form::json;
  OutputForm to = OutputForm::lines;
  bool convert = false;  ///< from f64 to f64: the work's convert may be used
  bool keepGoing = false;
  bool checkNames = false;  ///< results have names, which the records must not have
  std::string prefix;
};

/// Throws RecordError where a field has the name of a result.
void requireNoClash(const RecordParts& record, const Results& results, const std::string& prefix);

class Batch {
 public:
  /// writer: null to read records only.
  Batch(const BatchSetup& setup, RecordWork& work, RecordWriter* writer, BlockResult& result);

  void begin(const Block& block);
  /// Writes what is left. Throws StopBlock.
  void flush();

  /// The plan for records like this one. Throws RecordError. It holds until the next begin().
  Plan& planFor(const RecordParts& record);
  /// The plans of before, the one used last first.
  const std::vector<std::unique_ptr<Plan>>& plans() const { return plans_; }
  void usedAgain(std::size_t plan);

  /// text: in the block. Throws StopBlock where the run ends.
  void add(std::string_view text, const Plan& plan, const Numbers& numbers);
  void bad(std::string_view text, const RecordError& error);
  /// How many of the records from the start the work took as a whole.
  std::size_t convert(std::span<const double> numbers);
  /// As written: `[`, or `{"points": [`; and `]` with what follows it in a document.
  void beginArray(std::string_view asWritten);
  void endArray(std::string_view asWritten);

  /// Ends the run after what was added.
  struct StopBlock {};

 private:
  struct Row {
    std::string_view text;
    const Plan* plan;  ///< null: bad, and errors_ has the next error
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
  // How far the block's lines have been counted.
  std::size_t countedTo_ = 0;
  TextPosition countedPosition_;
};

/// Reads the records of blocks of one form into a batch.
class RecordReader {
 public:
  virtual ~RecordReader() = default;
  /// Throws Batch::StopBlock.
  virtual void read(const Block& block, Batch& batch) = 0;
};

/// byPattern: false to take every record apart, for comparison.
std::unique_ptr<RecordReader> makeJsonReader(bool byPattern = true);
std::unique_ptr<RecordReader> makeCsvReader(const Shape& header);
std::unique_ptr<RecordReader> makeTextReader();
std::unique_ptr<RecordReader> makeBinaryReader();

}  // namespace viewproj::cmd
