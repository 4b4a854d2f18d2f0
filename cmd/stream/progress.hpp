// A line on the terminal that shows how far a long run has come.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>

namespace viewproj::cmd {

/// Writes to standard error where that is a terminal and standard output is none, from the second second on.
class Progress {
 public:
  explicit Progress(std::optional<std::size_t> totalBytes);
  ~Progress() { clear(); }

  void moved(std::size_t bytes, std::size_t records);
  /// Takes the line away, so that something else may be written.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  bool enabled_, visible_ = false;
  std::optional<std::size_t> total_;
  std::size_t bytes_ = 0, records_ = 0;
  Clock::time_point start_ = Clock::now(), next_ = start_ + std::chrono::seconds(1);
};

}  // namespace viewproj::cmd
