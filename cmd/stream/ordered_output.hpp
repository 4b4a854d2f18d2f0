// Writes the workers' results in the order of the input.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "output/table.hpp"
#include "stream/batch.hpp"

namespace viewproj::cmd {

struct OutputSetup {
  OutputForm form = OutputForm::lines;
  char separator = ',';  ///< of CSV
  /// Names the place of an error.
  std::function<std::string(TextPosition)> placeOf;
  bool fromCommandLine = false;  ///< a bad record is an error of the command line
  std::function<void(const std::string&)> note = {};
};

/// A line on standard error with the progress of a long run. It is shown from the second second on, if standard error
/// is a terminal and standard output is not.
class Progress {
 public:
  explicit Progress(std::optional<std::size_t> totalBytes);
  void moved(std::size_t bytes, std::size_t records);
  /// Removes the line, so that something else can be written.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  bool enabled_, shows_ = false;
  std::optional<std::size_t> total_;
  std::size_t bytes_ = 0, records_ = 0;
  Clock::time_point start_ = Clock::now(), next_ = start_ + std::chrono::seconds(1);
};

class OrderedOutput {
 public:
  /// totalBytes: the size of the input, if it is known.
  OrderedOutput(OutputSetup setup, std::optional<std::size_t> totalBytes)
      : setup_(std::move(setup)), progress_(totalBytes), table_(setup_.separator) {}
  ~OrderedOutput() { progress_.clear(); }

  /// Writes the text before all records, and opens an array that holds them.
  void begin(std::string_view text);
  /// Writes the block's records. If the run ends with this block, throws InputError (UsageError) after writing
  /// everything before the error and closing an array. Throws ClosedPipe or InputError if nothing can be written.
  void put(const Block& block, const BlockResult& result);
  /// Call it after the last block. Returns the exit status.
  int finish();

 private:
  void write(std::string_view text);
  /// Writes what is left, and closes an open array.
  void end();
  [[noreturn]] void fail(const StreamFault& fault);

  OutputSetup setup_;
  Progress progress_;
  bool passedOver_ = false;
  std::string_view closing_;  ///< the text that closes the open array
  char last_ = '\n';          ///< the last character that was written
  CsvAligner table_;
};

}  // namespace viewproj::cmd
