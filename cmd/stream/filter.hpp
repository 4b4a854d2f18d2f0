// Streams of records: a filter writes the same records with results, in order and with bounded memory; a reader only
// reads them.
#pragma once

#include <functional>

#include "output/record_writer.hpp"
#include "stream/batch.hpp"
#include "stream/ordered_output.hpp"

namespace viewproj::cmd {

/// Returns the exit status: 1 if --keep-going skipped a bad record. Otherwise throws InputError at the first bad
/// record, after everything before it is written and an open array is closed.
int runFilter(const StreamSetup& setup, const RecordCameras& cameras, const MakeProcessor& makeProcessor);

/// What is done with the records of a stream that is only read.
struct RecordUse {
  std::function<NumberPlan(const RecordView&)> locate;
  /// Gets each record and its line, in order. Throws RecordError if the numbers are not valid.
  std::function<void(const NumberPlan&, const Numbers&, const RecordView&, std::size_t line)> use;
};

/// Throws InputError at the first bad record; with keepGoing, skips it and returns 1.
int readRecords(const StreamSetup& setup, const RecordUse& use);

/// Records that a command makes, with results: written as a filter would that reads records like these.
class RecordOutput {
 public:
  RecordOutput(const StreamSetup& setup, const Schema& schema, const ResultRows& rows);
  /// Throws RecordError if it has no place among the others.
  void write(const RecordView& record, const ResultValues& values);
  void finish();

 private:
  void begin();
  void flush();

  StreamSetup setup_;
  WriterSetup writing_;
  CsvColumns columns_;
  BlockResult result_;
  std::unique_ptr<RecordWriter> writer_;
  OrderedOutput output_;
  const Schema* last_ = nullptr;
};

}  // namespace viewproj::cmd
