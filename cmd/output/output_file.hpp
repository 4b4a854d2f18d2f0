// Standard output, written whole or with an error.
#pragma once

#include <cstddef>
#include <functional>
#include <string_view>

namespace viewproj::cmd {

/// Writes all of text. Throws ClosedPipe where nobody reads any more, InputError where it cannot be written.
void writeOutput(std::string_view text);

struct Written {
  std::size_t bytes = 0;
  int error = 0;  ///< errno, or 0
};

/// Writes text until all is out, writing fails, or stop() says so between two writes.
Written writeUntil(std::string_view text, const std::function<bool()>& stop);

/// Removes the last bytes written, where standard output is a file that ends with them.
void takeBack(std::size_t bytes) noexcept;

}  // namespace viewproj::cmd
