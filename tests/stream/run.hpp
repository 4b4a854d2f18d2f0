// A filter run inside of the test, its input from memory or through a pipe, what it writes kept.
#pragma once

#include <optional>
#include <string>

#include "stream/filter.hpp"

namespace viewproj::tests {

struct StreamRun {
  int status = 0;
  std::string out, err;
  bool operator==(const StreamRun&) const = default;
};

struct StreamHow {
  std::optional<cmd::Form> from = std::nullopt;
  std::optional<cmd::OutputForm> to = std::nullopt;
  bool keepGoing = false, visibleOnly = false;
  unsigned jobs = 1;
  std::size_t block = cmd::BlockReader::kBlock;
  /// Through a pipe, in pieces of at most so many bytes, of sizes that this seed gives.
  std::size_t largestPiece = 0;
  std::uint64_t seed = 0;
  std::string prefix = {};
  std::optional<char> delimiter = std::nullopt;
  std::optional<std::size_t> width = std::nullopt;
  std::string columns = {};
};

/// Results of a point: its numbers' sum, and their doubles. A point whose x is 4713 has none, one in four is visible.
StreamRun runStream(const std::string& input, const StreamHow& how);

/// How a command names the forms, for messages.
const char* nameOf(cmd::OutputForm form);

}  // namespace viewproj::tests
