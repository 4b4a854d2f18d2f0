// What workers made of the blocks, put out in the order of the input.
#pragma once

#include <functional>
#include <string>

#include "output/table.hpp"
#include "stream/batch.hpp"
#include "stream/progress.hpp"

namespace viewproj::cmd {

struct OutputSetup {
  OutputForm form = OutputForm::lines;
  /// Names the place of what is wrong.
  std::function<std::string(TextPosition)> placeOf;
  bool fromCommandLine = false;  ///< a bad record is a wrong command line
  std::function<void(const std::string&)> note = {};
};

class OrderedOutput {
 public:
  OrderedOutput(OutputSetup setup, const Progress& progress) : setup_(std::move(setup)), progress_(progress) {}

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
