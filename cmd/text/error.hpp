// Errors outside of the library. main turns them into a message and an exit status.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>

namespace viewproj::cmd {

/// The command line is wrong: exit status 2.
struct UsageError : std::runtime_error {
  using runtime_error::runtime_error;
};

/// An input is wrong or an output cannot be written: exit status 1. The message names its place.
struct InputError : std::runtime_error {
  using runtime_error::runtime_error;
};

/// A text that is a camera file of no known format; whether it is another input is tried before this is told.
struct UnknownFormat : InputError {
  UnknownFormat(const std::string& message, std::string given) : InputError(message), text(std::move(given)) {}
  std::string text;  ///< all of it, or empty where it is long
};

/// The reader of the output closed it: exit without a message.
struct ClosedPipe {};

/// A record is wrong at this byte of its text.
struct RecordError : std::runtime_error {
  RecordError(std::size_t at, const std::string& message) : runtime_error(message), offset(at) {}
  std::size_t offset;
};

/// Both count from 1; columns are bytes.
struct TextPosition {
  std::size_t line = 1, column = 1;
};

/// The position of the byte at offset, if text begins at start.
inline TextPosition positionAt(std::string_view text, std::size_t offset, TextPosition start = {}) {
  for (char c : text.substr(0, offset))
    if (c == '\n') {
      ++start.line;
      start.column = 1;
    } else {
      ++start.column;
    }
  return start;
}

/// "FILE:LINE:COLUMN".
inline std::string place(std::string_view file, TextPosition position) {
  return std::string(file) + ":" + std::to_string(position.line) + ":" + std::to_string(position.column);
}

}  // namespace viewproj::cmd
