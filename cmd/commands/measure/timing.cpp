#include "commands/measure/timing.hpp"

#include <algorithm>
#include <chrono>

namespace viewproj::cmd {
namespace {

using Clock = std::chrono::steady_clock;

/// Long against the clock's resolution, short against the machine's moods.
constexpr double kTurn = 2e-3, kShortestTurn = 2e-5;

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

double secondsOf(const std::function<void()>& work, std::size_t repeats) {
  const Clock::time_point start = Clock::now();
  for (std::size_t i = 0; i < repeats; ++i) work();
  return secondsSince(start);
}

std::size_t repeatsFor(const std::function<void()>& work, double turn) {
  secondsOf(work, 1);
  std::size_t repeats = 1;
  while (secondsOf(work, repeats) < turn) repeats *= 2;
  return repeats;
}

}  // namespace

InterleavedTimings timeInterleaved(std::span<const std::function<void()>> works, double seconds) {
  const double turn = std::clamp(seconds / static_cast<double>(kFewestRounds * works.size()), kShortestTurn, kTurn);
  std::vector<std::size_t> repeats;
  for (const auto& work : works) repeats.push_back(repeatsFor(work, turn));
  std::vector<std::vector<double>> runs(works.size());
  InterleavedTimings timings;
  const Clock::time_point start = Clock::now();
  while (timings.rounds < kFewestRounds || secondsSince(start) < seconds) {
    for (std::size_t i = 0; i < works.size(); ++i)
      runs[i].push_back(secondsOf(works[i], repeats[i]) / static_cast<double>(repeats[i]));
    ++timings.rounds;
  }
  for (std::vector<double>& run : runs) {
    std::sort(run.begin(), run.end());
    timings.works.push_back({run.front(), run[run.size() / 2]});
  }
  return timings;
}

}  // namespace viewproj::cmd
