#include "stream/ordered_output.hpp"

#include <algorithm>

#include "output/output_file.hpp"
#include "text/error.hpp"

namespace viewproj::cmd {

OrderedOutput::OrderedOutput(OutputSetup setup, const Progress& progress)
    : setup_(std::move(setup)), progress_(progress) {}

void OrderedOutput::begin(std::string_view text) {
  if (setup_.form == OutputForm::array) openArray("[");
  put(text);
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
  write((inArray_ == 0 ? "]" : "\n]") + std::string(after) + "\n");
}

void OrderedOutput::put(const BlockFrame& block, const BlockResult& result) try {
  if (setup_.keepArrays && !block.opening.empty()) openArray(block.opening);
  if (setup_.before) setup_.before([&](std::string_view text) { put(text); });
  if (!result.out.empty()) {
    if (open_) write(inArray_ == 0 ? "\n" : ",\n");
    put(result.out.view());
    inArray_ += result.records;
  }
  if (!result.passedOver.empty() || !result.notes.empty()) progress_.clear();
  if (setup_.note) std::for_each(result.notes.begin(), result.notes.end(), setup_.note);
  for (const StreamFault& bad : result.passedOver) {
    complain(setup_.placeOf(bad.position) + ": " + visible(bad.message));
    passedOver_ = true;
  }
  if (result.fault) fail(*result.fault);
  if (setup_.keepArrays && !block.closing.empty()) closeArray(block.closing);
  if (block.fault) fail(*block.fault);
  progress_.moved(block.inputBytes, result.records);
} catch (...) {
  progress_.clear();  // the process may end without destructors
  throw;
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
  if (setup_.before) setup_.before([&](std::string_view text) { put(text); });
  write(table_.rest());
  closeArray();
  return passedOver_ ? 1 : 0;
}

void OrderedOutput::put(std::string_view text) {
  if (setup_.form == OutputForm::table)
    write(table_.add(text));
  else
    write(text);
}

void OrderedOutput::write(std::string_view text) {
  if (!setup_.nothing) writeOutput(text);
}

}  // namespace viewproj::cmd
