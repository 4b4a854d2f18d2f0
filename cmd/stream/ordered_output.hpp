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
  bool keepArrays = false;  ///< an array in the input is one in the output
  /// Names the place of what is wrong.
  std::function<std::string(TextPosition)> placeOf;
  bool fromCommandLine = false;  ///< a bad record is a wrong command line
  bool nothing = false;          ///< write no records
  std::function<void(const std::string&)> note = {};
  /// Calls back with what is to stand before the block's records, if anything.
  std::function<void(const std::function<void(std::string_view)>&)> before = {};
};

class OrderedOutput {
 public:
  OrderedOutput(OutputSetup setup, const Progress& progress);

  /// Before the first block. Writes what stands before all records.
  void begin(std::string_view text);
  /// Writes the block's records whole. Throws InputError (UsageError) where the run ends with it, after all that came
  /// before and an array's end; ClosedPipe and InputError where nothing can be written.
  void put(const BlockFrame& block, const BlockResult& result);
  /// After the last block. Returns the exit status.
  int finish();

 private:
  void closeArray(std::string_view asWritten = "");
  void openArray(std::string_view asWritten);
  /// As write does, a table once its columns are known.
  void put(std::string_view text);
  void write(std::string_view text);
  [[noreturn]] void fail(const StreamFault& fault);

  OutputSetup setup_;
  Progress progress_;
  bool open_ = false, passedOver_ = false;
  std::string closing_;  ///< after the bracket: what ends a document
  std::size_t inArray_ = 0;
  CsvAligner table_;
};

}  // namespace viewproj::cmd
