// What workers made of the blocks, put out in the order of the input.
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
  /// Names the place of what is wrong.
  std::function<std::string(TextPosition)> placeOf;
  bool fromCommandLine = false;  ///< a bad record is a wrong command line
  std::function<void(const std::string&)> note = {};
};

/// A line on standard error that shows how far a long run has come: where that is a terminal and standard output is
/// none, from the second second on.
class Progress {
 public:
  explicit Progress(std::optional<std::size_t> totalBytes);
  void moved(std::size_t bytes, std::size_t records);
  /// Takes the line away, so that something else may be written.
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
  /// totalBytes: of the input, if that is known.
  OrderedOutput(OutputSetup setup, std::optional<std::size_t> totalBytes)
      : setup_(std::move(setup)), progress_(totalBytes) {}
  ~OrderedOutput() { progress_.clear(); }

  /// What stands before or after all records.
  void write(std::string_view text);
  /// An array that holds all records.
  void openArray();
  /// Writes the block's records whole. Throws InputError (UsageError) where the run ends with it, after all that came
  /// before and an array's end; ClosedPipe and InputError where nothing can be written.
  void put(const Block& block, const BlockResult& result);
  /// After the last block. Returns the exit status.
  int finish();

 private:
  void closeArray();
  [[noreturn]] void fail(const StreamFault& fault);

  OutputSetup setup_;
  Progress progress_;
  bool passedOver_ = false;
  std::string closing_;  ///< of the array that stands open
  std::size_t inArray_ = 0;
  CsvAligner table_;
};

}  // namespace viewproj::cmd
