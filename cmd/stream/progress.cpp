#include "stream/progress.hpp"

#include <cmath>
#include <cstdio>
#include <string>
#include <string_view>

#include "text/number.hpp"
#include "text/system.hpp"

namespace viewproj::cmd {
namespace {

constexpr const char* kBlankLine = "\r\033[K";
constexpr auto kFirst = std::chrono::seconds(1);
constexpr auto kEvery = std::chrono::milliseconds(200);

std::string clockTime(double seconds) {
  const long whole = std::lround(seconds);
  char text[40];
  if (whole < 3600)
    std::snprintf(text, sizeof text, "%ld:%02ld", whole / 60, whole % 60);
  else
    std::snprintf(text, sizeof text, "%ld:%02ld:%02ld", whole / 3600, whole / 60 % 60, whole % 60);
  return text;
}

void put(std::string_view text) { (void)writeSome(kStandardError, text); }

}  // namespace

Progress::Progress(std::optional<std::size_t> totalBytes)
    : wanted_(obeysEscapes(kStandardError) && !isTerminal(kStandardOutput)),
      total_(totalBytes),
      start_(Clock::now()),
      next_(start_ + kFirst) {}

void Progress::moved(std::size_t bytes, std::size_t records) {
  if (!wanted_) return;
  bytes_ += bytes;
  records_ += records;
  const Clock::time_point now = Clock::now();
  if (now >= next_) show(now);
}

void Progress::show(Clock::time_point now) {
  const double seconds = std::chrono::duration<double>(now - start_).count();
  std::string line = kBlankLine;
  if (total_ && *total_ > 0 && bytes_ > 0 && bytes_ <= *total_) {
    const double share = static_cast<double>(bytes_) / static_cast<double>(*total_);
    char text[40];
    std::snprintf(text, sizeof text, "%.0f %%, ", 100 * share);
    line += text + formatCount(static_cast<double>(records_) / seconds) + " records/s, " +
            clockTime(seconds / share - seconds) + " left";
  } else {
    line += formatCount(static_cast<double>(records_)) + " records, " +
            formatCount(static_cast<double>(records_) / seconds) + " records/s";
  }
  put(line);
  shown_ = true;
  next_ = now + kEvery;
}

void Progress::clear() {
  if (shown_) put(kBlankLine);
  shown_ = false;
}

}  // namespace viewproj::cmd
