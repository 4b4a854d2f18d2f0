#include "stream/progress.hpp"

#include <string>

#include "text/number.hpp"
#include "text/system.hpp"

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
  visible_ = true;
}

void Progress::clear() {
  if (visible_) (void)writeSome(kStandardError, kBlankLine);
  visible_ = false;
}

}  // namespace viewproj::cmd
