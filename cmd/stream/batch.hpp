// Records with their results: collected in batches, computed together, and written.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "output/record_writer.hpp"
#include "stream/record_reader.hpp"

namespace viewproj::cmd {

/// What a command makes of the records of a stream. Each worker has its own. The records of a batch are added one by
/// one, computed together, and then asked for their results.
class RecordProcessor {
 public:
  virtual ~RecordProcessor() = default;

  /// Where records like this one have their numbers. Throws RecordError if they lack some.
  virtual NumberPlan locate(const RecordView& record) const = 0;
  /// The results of such records, in order. Throws RecordError if the form of the output cannot hold them.
  virtual ResultRows rows(const NumberPlan& plan) const = 0;
  /// camera: stays until clear(). Throws RecordError, without adding anything, if the numbers are not valid.
  virtual void add(const NumberPlan& plan, const Numbers& numbers, const RecordCamera& camera) = 0;
  virtual void compute() {}
  /// The results of record i, in the order of adding. Throws RecordError if it has none.
  virtual void results(std::size_t i, ResultValues& values) = 0;
  /// Whether record i, the last one that was asked for its results, is seen.
  virtual bool isVisible(std::size_t /*i*/) const { return true; }
  /// The batch is finished.
  virtual void clear() = 0;

  /// Of one camera: converts many records at once from f64 to f64: three numbers per record in, and the writer's bytes
  /// out. Returns how many records from the start it converted; the others are added.
  virtual std::size_t convert(std::span<const double> /*in*/, TextBuffer& /*out*/) { return 0; }
};

/// to: the form of the output.
using MakeProcessor = std::function<std::unique_ptr<RecordProcessor>(OutputForm to)>;

/// The result of a block.
struct BlockResult {
  TextBuffer out;
  std::string_view closing;             ///< of the array that is open at the end of out
  BlockJoint joint = BlockJoint::none;  ///< to what was written before out
  std::size_t records = 0;              ///< including bad records that --keep-going writes
  std::vector<StreamFault> passedOver;  ///< bad records, with --keep-going
  std::vector<std::string> notes;       ///< each note once
  std::optional<StreamFault> fault;     ///< a bad record that ends the run; out has everything before it

  void clear();
  void note(const std::string& text);
};

/// Where a block's records are. Positions must be asked for in order.
class PositionCounter {
 public:
  void begin(const Block& block, std::size_t binaryRecord);
  TextPosition positionOf(const char* where);

 private:
  const Block* block_ = nullptr;
  std::size_t binaryRecord_ = 0, countedTo_ = 0;
  TextPosition counted_;
};

/// Throws RecordError if a field has the name of a result.
void requireNoClash(const RecordView& record, const ResultRows& rows, const std::string& prefix);

/// All results of a record: those of a processor, and its camera's name before them.
ResultRows withCameraName(const StreamSetup& setup, ResultRows rows);

class Batch final : public RecordSink {
 public:
  /// binaryRecord: bytes of a binary record, or 0.
  Batch(const WriterSetup& setup, const RecordCameras& cameras, RecordProcessor& processor, RecordWriter& writer,
        std::size_t binaryRecord, bool mayConvert, BlockResult& result);

  void begin(const Block& block);
  /// Writes the remaining records. Throws Stop.
  void flush();

  Plan plan(const RecordView& record) override;
  void forgetPlans() override { flush(); }
  void take(const RecordView& record, const Plan& plan, const Numbers& numbers) override;
  void bad(std::string_view text, const RecordError& error, std::span<const std::string_view> values) override;
  void takeError(const RecordView& record, std::size_t field) override;
  void beginArray(std::string_view asWritten) override;
  void endArray(std::string_view asWritten) override;
  std::size_t convert(std::span<const double> numbers) override;

 private:
  struct Row {
    RecordView record;
    const Plan* plan = nullptr;  ///< null: a bad record
    const RecordCamera* camera = nullptr;
    std::size_t values = 0, count = 0;  ///< where those of the record are kept, and how many
    std::size_t error = 0;              ///< of a bad record: its error, or the field that tells it
    bool saysError = false;
  };

  void keep(Row row);
  bool needsValues(const Row& row) const;
  void writeBad(const RecordView& record, const RecordError& error);

  const WriterSetup& setup_;
  const RecordCameras& cameras_;
  CamerasOfBatch camerasOfBatch_;
  RecordProcessor& processor_;
  RecordWriter& writer_;
  std::size_t binaryRecord_;
  bool mayConvert_;
  BlockResult& result_;
  PositionCounter position_;
  std::vector<Row> rows_;
  std::vector<std::string_view> values_;
  std::vector<RecordError> errors_;
  ResultValues results_;
};

}  // namespace viewproj::cmd
