// A filter: records in, the same records with results out, in order and in bounded memory.
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

/// A record of the command line: the option it came from, and the record as JSON.
struct GivenRecord {
  std::string option;
  std::string json;
};

struct FilterSetup {
  std::string file = "-";
  std::vector<GivenRecord> given;  ///< instead of a file
  std::optional<Form> from;
  std::optional<OutputForm> to;  ///< nothing: as the input
  bool keepGoing = false;
  unsigned jobs = 0;  ///< threads; 0: one a processor
  std::size_t blockSize = BlockReader::kBlock;
  std::optional<char> delimiter;         ///< of CSV's columns; nothing: as the first line tells
  ColumnChoice columns;                  ///< --columns
  std::vector<std::string> csvDefaults;  ///< column names of a CSV stream without a header
  std::function<void(const std::string&)> note = [](const std::string&) {};  ///< of what is obeyed to no effect
  /// As PipelineSetup has it.
  void (*failed)() = endWithException;
  WriterSetup writer;
};

/// Returns the exit status: 1 if --keep-going passed over a bad record. Throws InputError at the first bad record
/// otherwise, after everything before it has been written and an open array closed.
int runFilter(FilterSetup setup, const MakeWork& makeWork);

/// Reads the records alone, in order: they are added to the work, batch by batch, and nothing is written. Throws
/// InputError at the first bad one, or with keepGoing leaves it out and returns the exit status 1. setup: file or
/// given, from, columns, csvDefaults, keepGoing.
int readRecords(FilterSetup setup, const MakeWork& makeWork);

}  // namespace viewproj::cmd
