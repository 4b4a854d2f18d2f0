// A filter: reads records and writes the same records with results, in order and with bounded memory.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "output/output_file.hpp"
#include "output/record_writer.hpp"
#include "records/columns.hpp"
#include "stream/block_reader.hpp"
#include "stream/work.hpp"
#include "text/form.hpp"

namespace viewproj::cmd {

/// A record from the command line: its option, and the record as JSON.
struct GivenRecord {
  std::string option;
  std::string json;
};

struct FilterSetup {
  std::string file = "-";
  std::vector<GivenRecord> given;  ///< read instead of a file
  std::optional<Form> from;
  std::optional<OutputForm> to;  ///< empty: like the input
  bool keepGoing = false;
  unsigned jobs = 0;  ///< threads; 0: one per processor
  std::size_t blockSize = BlockReader::kBlock;
  std::optional<char> delimiter;         ///< separator of CSV; empty: found in the first line
  ColumnChoice columns;                  ///< --columns
  std::vector<std::string> csvDefaults;  ///< column names of a CSV stream without a header
  std::function<void(const std::string&)> note = [](const std::string&) {};  ///< about options without effect
  /// See PipelineSetup.
  void (*failed)() = endWithException;
  WriterSetup writer;
};

/// Returns the exit status: 1 if --keep-going skipped a bad record. Otherwise throws InputError at the first bad
/// record, after everything before it is written and an open array is closed.
int runFilter(FilterSetup setup, const MakeWork& makeWork);

/// Only reads the records, in order: they are added to the work, batch by batch, and nothing is written. Throws
/// InputError at the first bad record; with keepGoing, skips it and returns 1. Uses of setup: file or given, from,
/// columns, csvDefaults, keepGoing.
int readRecords(FilterSetup setup, const MakeWork& makeWork);

}  // namespace viewproj::cmd
