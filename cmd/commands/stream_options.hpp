// The options of a stream of records.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "commands/camera_options.hpp"
#include "records/arguments.hpp"
#include "records/columns.hpp"
#include "records/points.hpp"
#include "stream/filter.hpp"

namespace viewproj::cmd {

/// The stream of records that a command works on.
class StreamOptions {
 public:
  /// For a filter, with results in the records. what: "points" or "pixels".
  void add(CLI::App& app, const std::string& what);
  /// For a command that only reads them: a bad one need not end it.
  void addInput(CLI::App& app, const std::string& what);
  /// --point, in place of FILE and standard input.
  void addPoints(CLI::App& app);

  /// Throws UsageError for columns that are none.
  StreamSetup setup(const ChoosableColumns& choosable) const;

  /// Whether there are records, of FILE, standard input or the command line. Throws UsageError where they come from two
  /// of these, and for an option on how to read a FILE that is not read.
  bool reads(const StreamSetup& setup) const;

  /// With a camera on the Earth, points and columns that are named by neither lat, lon, height nor x, y, z are a
  /// UsageError; and what has no names in the output gets x, y, z.
  void settleOnEarth(StreamSetup& setup, bool worldIsEcef) const;

 private:
  void addReading(CLI::App& app, const std::string& what, const char* keepGoing);

  const CLI::App* app_ = nullptr;
  std::optional<std::string> file_, prefix_, columns_;
  std::optional<Form> from_;
  std::optional<OutputForm> to_;
  std::optional<char> delimiter_;
  std::optional<std::size_t> width_, jobs_, digits_;
  std::vector<PointArgument> points_;
  bool keepGoing_ = false, noHeader_ = false;
};

/// Reads points and shapes and writes none: make(plan, numbers) makes something of one, and use(thing, record, line)
/// gets it, in order. make throws RecordError. Returns the exit status.
template <class Make, class Use>
int readEachPoint(const StreamSetup& setup, const PointReading& reading, Make make, Use use) {
  return readRecords(setup, {[&](const RecordView& record) { return findPoint(record, reading); },
                             [&](const NumberPlan& plan, const Numbers& numbers, const RecordView& record,
                                 std::size_t line) { use(make(plan, numbers), record, line); }});
}

}  // namespace viewproj::cmd
