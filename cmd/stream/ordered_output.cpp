#include "stream/ordered_output.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "input/error.hpp"
#include "output/output_file.hpp"
#include "stream/interrupt.hpp"

namespace viewproj::cmd {
namespace {

constexpr std::size_t npos = std::string_view::npos;

/// The first end of a record at `at` or behind it. recordSize: of f64, otherwise 0.
std::size_t endOfRecord(std::string_view text, std::size_t at, std::size_t recordSize, bool inArray) {
  if (recordSize > 0) return (at + recordSize - 1) / recordSize * recordSize;
  if (inArray) return std::min(text.find(",\n", at), text.size());
  if (at == 0 || text[at - 1] == '\n') return at;
  const std::size_t line = text.find('\n', at);
  return line == npos ? text.size() : line + 1;
}

/// Where the record begins that byte `at` belongs to.
std::size_t beginOfRecord(std::string_view text, std::size_t at, std::size_t recordSize) {
  if (recordSize > 0) return at / recordSize * recordSize;
  const std::size_t line = text.substr(0, at).rfind('\n');
  return line == npos ? 0 : line + 1;
}

}  // namespace

OrderedOutput::OrderedOutput(OutputSetup setup, Progress progress)
    : setup_(std::move(setup)), progress_(std::move(progress)) {}

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
  const std::string_view behind = asWritten.empty() ? std::string_view(closing_) : asWritten.substr(1);
  write((inArray_ == 0 ? "]" : "\n]") + std::string(behind) + "\n");
}

void OrderedOutput::put(const Block& block, const BlockResult& result) {
  if (setup_.keepArrays && !block.opening.empty()) openArray(block.opening);
  if (result.records > 0) {
    if (open_) write(inArray_ == 0 ? "\n" : ",\n");
    put(result.out.view(), result.records);
    inArray_ += result.records;
  }
  if (!result.passedOver.empty()) progress_.clear();
  for (const StreamFault& bad : result.passedOver) {
    std::fprintf(stderr, "viewproj: %s: %s\n", setup_.placeOf(bad.position).c_str(), bad.message.c_str());
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
  progress_.clear();
  const bool placed = fault.position.line > 0;
  const std::string message = (placed ? setup_.placeOf(fault.position) + ": " : "") + fault.message;
  if (setup_.fromCommandLine) throw UsageError(message);
  throw InputError(message);
}

int OrderedOutput::finish(std::string_view text) {
  put(text, 0);
  write(table_.rest());
  closeArray();
  progress_.clear();
  return passedOver_ ? 1 : 0;
}

void OrderedOutput::put(std::string_view text, std::size_t records) {
  if (setup_.form == OutputForm::table)
    write(table_.add(text));
  else
    write(text, records);
}

void OrderedOutput::write(std::string_view text, std::size_t records) {
  if (setup_.nothing || text.empty()) return;
  const WritingHere writing;
  const Written all = writeUntil(text, [] { return InterruptGuard::signal() != 0; });
  if (all.bytes == text.size()) return;
  const std::size_t recordSize = setup_.form == OutputForm::f64 && records > 0 ? text.size() / records : 0;
  if (all.error == EPIPE) throw ClosedPipe{};
  if (all.error != 0) {
    takeBack(all.bytes - beginOfRecord(text, all.bytes, recordSize));
    throw InputError(std::string("standard output: ") + std::strerror(all.error));
  }
  const std::size_t end = endOfRecord(text, all.bytes, recordSize, open_);
  (void)writeUntil(text.substr(all.bytes, end - all.bytes), [] { return false; });
  inArray_ += open_;
  closeArray();
  throw Interrupted{InterruptGuard::signal()};
}

}  // namespace viewproj::cmd
