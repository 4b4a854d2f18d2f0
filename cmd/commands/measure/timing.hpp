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

struct InterleavedTimings {
  std::vector<Timing> works;  ///< in the order given
  std::size_t rounds = 0;
};

inline constexpr std::size_t kFewestRounds = 7;

/// Times every work once a round, so that what slows the machine for a while slows all of them: at least kFewestRounds
/// rounds, and more until `seconds` have passed. A work is repeated within its turn until that lasts two milliseconds,
/// or as long as seven rounds within `seconds` allow, but twenty microseconds at least, for clocks have ticks. Runs
/// each beforehand, so that memory and caches are warm.
InterleavedTimings timeInterleaved(std::span<const std::function<void()>> works, double seconds);

}  // namespace viewproj::cmd
