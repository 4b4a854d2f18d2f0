// The options of a stream of records.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <type_traits>
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
  FilterSetup setup(const ChoosableColumns& choosable) const;

  /// Whether there are records, of FILE, standard input or the command line. Throws UsageError where they come from two
  /// of these, and for an option on how to read a FILE that is not read.
  bool reads(const FilterSetup& setup) const;

  /// With a camera on the Earth, points and columns that are named by neither lat, lon, height nor x, y, z are a
  /// UsageError; and what has no names in the output gets x, y, z.
  void settleOnEarth(FilterSetup& setup, bool worldIsEcef) const;

 private:
  void addReading(CLI::App& app, const std::string& what, const char* keepGoing);

  const CLI::App* app_ = nullptr;
  std::optional<std::string> file_, prefix_, columns_;
  std::optional<Form> from_;
  std::optional<OutputForm> to_;
  std::optional<char> delimiter_;
  std::optional<std::size_t> jobs_, digits_;
  std::vector<PointArgument> points_;
  bool keepGoing_ = false, noHeader_ = false;
};

/// Reads records and writes none: find(parts) tells where one has its numbers, make(layout, numbers) makes something of
/// them, and use(thing, record, line) gets it, in order. find and make throw RecordError. Returns the exit status.
template <class Find, class Make, class Use>
int readEach(const FilterSetup& setup, Find find, Make make, Use use) {
  class Work final : public RecordWork {
   public:
    Work(Find& find, Make& make, Use& use) : find_(find), make_(make), use_(use) {}
    Layout find(const RecordParts& record) const override { return find_(record); }
    void add(const Layout& layout, const Numbers& numbers) override { things_.push_back(make_(layout, numbers)); }
    void read(std::size_t i, const Record& record, std::size_t line) override { use_(things_[i], record, line); }
    void clear() override { things_.clear(); }

   private:
    Find& find_;
    Make& make_;
    Use& use_;
    std::vector<std::invoke_result_t<Make&, const Layout&, const Numbers&>> things_;
  };
  return readRecords(setup, [&] { return std::make_unique<Work>(find, make, use); });
}

/// The same of points and shapes.
template <class Make, class Use>
int readEachPoint(const FilterSetup& setup, const PointReading& reading, Make make, Use use) {
  return readEach(
      setup, [&](const RecordParts& record) { return findPoint(record, reading); }, make, use);
}

}  // namespace viewproj::cmd
