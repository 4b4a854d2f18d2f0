// What goes wrong outside the library, as exceptions that main turns into a message and an exit status.
#pragma once

#include <stdexcept>
#include <string>

namespace viewproj::cmd {

/// The command line is wrong: exit status 2.
struct UsageError : std::runtime_error {
  using runtime_error::runtime_error;
};

/// An input is wrong or an output cannot be written: exit status 1. The message names its place.
struct InputError : std::runtime_error {
  using runtime_error::runtime_error;
};

/// Whoever reads the output has gone away: exit quietly.
struct ClosedPipe {};

/// A record is wrong, at a byte of its text.
struct RecordError : std::runtime_error {
  RecordError(std::size_t at, const std::string& message) : runtime_error(message), offset(at) {}
  std::size_t offset;
};

}  // namespace viewproj::cmd
