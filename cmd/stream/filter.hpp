// A filter: records in, the same records with results out, in order and in bounded memory.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "output/record_writer.hpp"
#include "stream/form.hpp"

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
  std::vector<std::string> csvDefaults;  ///< column names of a CSV stream without a header
  /// Reads a record whose fields are the header's names, all with the value 1; throws RecordError where one is missing.
  std::function<void(const Record&)> checkHeader;
  WriterSetup writer;
};

/// Reads a record and writes its results; throws RecordError where it is wrong.
using RecordWork = std::function<void(const Record&, ResultSink&)>;

/// Returns the exit status: 1 if --keep-going passed over a bad record. Throws InputError at the first bad record
/// otherwise, after everything before it has been written and an open array closed.
int runFilter(const FilterSetup& setup, const RecordWork& work);

/// Reads the records alone: visits each in order and writes nothing. visit throws RecordError where a record is wrong;
/// the first that is becomes an InputError that names its place. setup: file or given, from, csvDefaults, checkHeader.
void readRecords(const FilterSetup& setup, const std::function<void(const Record&)>& visit);

}  // namespace viewproj::cmd
