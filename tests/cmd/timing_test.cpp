// How long pieces of work take, told by how often they are called: no time is asserted but that of a sleep, which is
// never less.
#include "commands/measure/timing.hpp"

#include <algorithm>
#include <chrono>
#include <functional>
#include <thread>
#include <vector>

#include "catch.hpp"

using namespace viewproj::cmd;

namespace {

struct Measured {
  InterleavedTimings timings;
  std::size_t sleeps = 0, steps = 0;
};

/// A work that sleeps a millisecond, and one that is done at once.
Measured measured(double seconds) {
  Measured m;
  const std::vector<std::function<void()>> works = {[&] {
                                                      ++m.sleeps;
                                                      std::this_thread::sleep_for(std::chrono::milliseconds(1));
                                                    },
                                                    [&] { ++m.steps; }};
  m.timings = timeInterleaved(works, seconds);
  return m;
}

}  // namespace

TEST_CASE("A time is that of one call, whatever a turn repeats") {
  const Measured m = measured(0.1);
  REQUIRE(m.timings.works.size() == 2);
  const Timing& sleep = m.timings.works[0];
  const Timing& step = m.timings.works[1];
  CHECK(sleep.least >= 1e-3);
  CHECK(sleep.least <= sleep.median);
  CHECK(step.least > 0);
  CHECK(step.least <= step.median);
  CHECK(step.median < 1e-3);  // in a turn of two milliseconds, so that it would not be
  CHECK(m.steps > 100 * m.sleeps);
}

TEST_CASE("Seven rounds are made however little time there is, of turns that fit into it") {
  // One call beforehand, and one that a turn is as long as; then a call in each round.
  for (const double seconds : {1e-9, 1e-6, 0.0135}) {
    const Measured m = measured(seconds);
    CAPTURE(seconds);
    CHECK(m.timings.rounds >= kFewestRounds);
    CHECK(m.sleeps == 2 + m.timings.rounds);
    CHECK(m.timings.works[1].least > 0);
  }
  // Where there is time a turn takes two milliseconds, and there are more rounds.
  const Measured m = measured(0.2);
  CHECK(m.timings.rounds > kFewestRounds);
  CHECK(m.sleeps > 2 + m.timings.rounds);
}
