// How long pieces of work take, side by side.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace viewproj::cmd {

/// Seconds for one call.
struct Timing {
  double least = 0, median = 0;
};

inline constexpr std::size_t kRounds = 15;

/// Times every work once a round, so that what slows the machine for a while slows all of them. A work is repeated
/// within its turn until that lasts two milliseconds. Runs each beforehand, so that memory and caches are warm.
std::vector<Timing> timeInterleaved(std::span<const std::function<void()>> works);

}  // namespace viewproj::cmd
