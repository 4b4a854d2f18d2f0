#include "stream/ordered_output.hpp"

#include <algorithm>

#include "output/output_file.hpp"
#include "text/error.hpp"
#include "text/number.hpp"
#include "text/system.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

constexpr const char* kBlankLine = "\r\033[K";

}  // namespace

Progress::Progress(std::optional<std::size_t> totalBytes)
    : enabled_(obeysEscapes(kStandardError) && !isTerminal(kStandardOutput)), total_(totalBytes) {}

void Progress::moved(std::size_t bytes, std::size_t records) {
  if (!enabled_) return;
  bytes_ += bytes;
  records_ += records;
  const Clock::time_point now = Clock::now();
  if (now < next_) return;
  next_ = now + std::chrono::milliseconds(200);
  const double seconds = std::chrono::duration<double>(now - start_).count();
  const std::string share =
      total_ && bytes_ <= *total_ ? std::to_string(100 * bytes_ / *total_) + " %, " : std::string();
  (void)writeSome(kStandardError, kBlankLine + share + formatCount(static_cast<double>(records_)) + " records, " +
                                      formatCount(static_cast<double>(records_) / seconds) + " records/s");
  shows_ = true;
}

void Progress::clear() {
  if (shows_) (void)writeSome(kStandardError, kBlankLine);
  shows_ = false;
}

void OrderedOutput::write(std::string_view text) {
  if (text.empty()) return;
  last_ = text.back();
  writeOutput(setup_.form == OutputForm::table ? std::string_view(table_.add(text)) : text);
}

void OrderedOutput::begin(std::string_view text) {
  write(text);
  if (setup_.form != OutputForm::array) return;
  write("[");
  closing_ = "]";
}

void OrderedOutput::put(const Block& block, const BlockResult& result) try {
  const std::string_view out = result.out.view();
  const bool isEmpty = last_ == '[';
  if (result.joint == BlockJoint::record) write(isEmpty ? "\n" : ",\n");
  if (result.joint == BlockJoint::end && !isEmpty) write("\n");
  write(out);
  closing_ = result.closing;
  if (!result.passedOver.empty() || !result.notes.empty()) progress_.clear();
  if (setup_.note) std::for_each(result.notes.begin(), result.notes.end(), setup_.note);
  for (const StreamFault& bad : result.passedOver) {
    complain(setup_.placeOf(bad.position) + ": " + visible(bad.message));
    passedOver_ = true;
  }
  if (result.fault) fail(*result.fault);
  if (block.fault) fail(*block.fault);
  progress_.moved(block.bytes.size(), result.records);
} catch (...) {
  progress_.clear();  // the process may end without destructors
  throw;
}

void OrderedOutput::end() {
  writeOutput(table_.rest());
  if (!closing_.empty()) writeOutput((last_ == '[' ? "" : "\n") + std::string(closing_) + "\n");
}

void OrderedOutput::fail(const StreamFault& fault) {
  end();
  const bool placed = fault.position.line > 0;
  const std::string message = (placed ? setup_.placeOf(fault.position) + ": " : "") + fault.message;
  if (setup_.fromCommandLine) throw UsageError(message);
  throw InputError(message);
}

int OrderedOutput::finish() {
  end();
  return passedOver_ ? 1 : 0;
}

}  // namespace viewproj::cmd
