#include "stream/ordered_output.hpp"

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "output/output_file.hpp"
#include "stream/interrupt.hpp"
#include "text/csv_lines.hpp"
#include "text/error.hpp"

namespace viewproj::cmd {
namespace {

/// Records that are written one after the other.
struct Records {
  std::string_view text;
  OutputForm form;
  CsvFormat csv;
  std::size_t count;
  bool joined;  ///< an array's: separated, not ended, by what stands between them
  bool arrays;  ///< some stand in arrays

  std::size_t size() const { return count > 0 ? text.size() / count : text.size(); }  ///< f64

  /// After the record that begins there, its line break included.
  std::size_t after(std::size_t begin) const {
    const std::size_t line = form == OutputForm::csv ? endOfCsvRecord(text, begin, csv) : text.find('\n', begin);
    return line >= text.size() ? text.size() : line + 1;
  }

  /// The last place at `at` or before it where a record begins.
  std::size_t beginBefore(std::size_t at) const {
    if (form == OutputForm::f64) return at / size() * size();
    if (form != OutputForm::csv) return at == 0 ? 0 : text.rfind('\n', at - 1) + 1;  // npos + 1 is 0
    std::size_t begin = 0;
    for (std::size_t end; begin < at && (end = after(begin)) <= at;) begin = end;
    return begin;
  }

  /// The first place at `at` or after it where a record ends, and an array if it stands in one.
  std::size_t endAfter(std::size_t at) const {
    if (arrays) return text.size();
    if (joined) return std::min(text.find(",\n", at), text.size());
    const std::size_t begin = beginBefore(at);
    if (begin == at) return at;
    return form == OutputForm::f64 ? begin + size() : after(begin);
  }
};

}  // namespace

OrderedOutput::OrderedOutput(OutputSetup setup, const Progress& progress)
    : setup_(std::move(setup)), progress_(progress) {}

void OrderedOutput::begin(std::string_view text) {
  if (setup_.form == OutputForm::array) openArray("[");
  put(text, 0);
}

void OrderedOutput::openArray(std::string_view asWritten) {
  write(asWritten);
  open_ = true;
  inArray_ = 0;
  closing_ = asWritten.starts_with('{') ? "}" : "";
}

void OrderedOutput::closeArray(std::string_view asWritten) {
  if (!open_) return;
  open_ = false;
  const std::string_view after = asWritten.empty() ? std::string_view(closing_) : asWritten.substr(1);
  writeEnd((inArray_ == 0 ? "]" : "\n]") + std::string(after) + "\n");
}

void OrderedOutput::put(const BlockFrame& block, const BlockResult& result) {
  if (InterruptGuard::signal() != 0) endInterrupted();
  if (setup_.keepArrays && !block.opening.empty()) openArray(block.opening);
  if (setup_.before) setup_.before([&](std::string_view text) { put(text, 0); });
  if (!result.out.empty()) {
    if (open_) write(inArray_ == 0 ? "\n" : ",\n");
    put(result.out.view(), result.records, result.arrays);
    inArray_ += result.records;
  }
  if (!result.passedOver.empty() || !result.notes.empty()) progress_.clear();
  if (setup_.note) std::for_each(result.notes.begin(), result.notes.end(), setup_.note);
  for (const StreamFault& bad : result.passedOver) {
    const WritingHere writing;
    complain(setup_.placeOf(bad.position) + ": " + visible(bad.message), [] { return InterruptGuard::signal() != 0; });
    if (InterruptGuard::signal() != 0) endInterrupted();
    passedOver_ = true;
  }
  if (result.fault) fail(*result.fault);
  if (setup_.keepArrays && !block.closing.empty()) closeArray(block.closing);
  if (block.fault) fail(*block.fault);
  progress_.moved(block.inputBytes, result.records);
}

void OrderedOutput::fail(const StreamFault& fault) {
  write(table_.rest());
  closeArray();
  const bool placed = fault.position.line > 0;
  const std::string message = (placed ? setup_.placeOf(fault.position) + ": " : "") + fault.message;
  if (setup_.fromCommandLine) throw UsageError(message);
  throw InputError(message);
}

int OrderedOutput::finish() {
  if (setup_.before) setup_.before([&](std::string_view text) { put(text, 0); });
  write(table_.rest());
  closeArray();
  return passedOver_ ? 1 : 0;
}

void OrderedOutput::put(std::string_view text, std::size_t count, bool arrays) {
  if (setup_.form == OutputForm::table)
    write(table_.add(text));
  else
    write(text, count, arrays);
}

void OrderedOutput::write(std::string_view text, std::size_t count, bool arrays) {
  if (setup_.nothing || text.empty()) return;
  const WritingHere writing;
  const Written all = writeUntil(kStandardOutput, text, [] { return InterruptGuard::signal() != 0; });
  if (all.bytes == text.size()) return;
  const Records records{text, setup_.form, setup_.csv, count, open_, arrays};
  if (all.error != 0) {
    if (all.error != EPIPE) takeBack(all.bytes - records.beginBefore(all.bytes));
    failToWrite(all.error);
  }
  const std::size_t end = records.endAfter(all.bytes);
  writeEnd(text.substr(all.bytes, end - all.bytes));
  inArray_ += open_;
  endInterrupted();
}

void OrderedOutput::writeEnd(std::string_view text) {
  if (setup_.nothing) return;
  const Written all = writeUntil(kStandardOutput, text);
  if (all.error != 0) failToWrite(all.error);
}

void OrderedOutput::failToWrite(int error) {
  if (const int signal = InterruptGuard::signal()) throw Interrupted{signal};
  cmd::failToWrite(error);
}

void OrderedOutput::endInterrupted() {
  closeArray();
  throw Interrupted{InterruptGuard::signal()};
}

}  // namespace viewproj::cmd
