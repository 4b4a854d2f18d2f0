// Streams of records: a filter writes the same records with results, in order and with bounded memory; a reader only
// reads them.
#pragma once

#include <functional>

#include "output/record_writer.hpp"
#include "stream/batch.hpp"

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

}  // namespace viewproj::cmd
