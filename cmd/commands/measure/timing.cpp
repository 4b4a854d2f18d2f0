#include "commands/measure/timing.hpp"

#include <algorithm>
#include <chrono>

namespace viewproj::cmd {
namespace {

using Clock = std::chrono::steady_clock;

/// Long against the clock's resolution, short against the machine's moods.
constexpr double kTurn = 2e-3;

double secondsOf(const std::function<void()>& work, std::size_t repeats) {
  const Clock::time_point start = Clock::now();
  for (std::size_t i = 0; i < repeats; ++i) work();
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::size_t repeatsFor(const std::function<void()>& work) {
  secondsOf(work, 1);
  std::size_t repeats = 1;
  while (secondsOf(work, repeats) < kTurn) repeats *= 2;
  return repeats;
}

}  // namespace

std::vector<Timing> timeInterleaved(std::span<const std::function<void()>> works) {
  std::vector<std::size_t> repeats;
  for (const auto& work : works) repeats.push_back(repeatsFor(work));
  std::vector<std::vector<double>> runs(works.size());
  for (std::size_t round = 0; round < kRounds; ++round)
    for (std::size_t i = 0; i < works.size(); ++i)
      runs[i].push_back(secondsOf(works[i], repeats[i]) / static_cast<double>(repeats[i]));
  std::vector<Timing> timings;
  for (std::vector<double>& run : runs) {
    std::sort(run.begin(), run.end());
    timings.push_back({run.front(), run[run.size() / 2]});
  }
  return timings;
}

}  // namespace viewproj::cmd
