// Standard output, written whole or with an error, and messages.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

#include "text/system.hpp"

namespace viewproj::cmd {

/// Writes all of text. Throws ClosedPipe where nobody reads any more, InputError where it cannot be written.
void writeOutput(std::string_view text);

/// How messages call standard output from here on.
void nameOutput(const std::string& name);
std::string_view nameOfOutput();

/// Throws ClosedPipe where nobody reads any more, or else InputError. error: errno.
[[noreturn]] void failToWrite(int error);

using Stop = std::function<bool()>;

/// Writes text to a descriptor until all is out, writing fails, or stop() says so between two writes.
Written writeUntil(int descriptor, std::string_view text, const Stop& stop = {});

/// Writes `viewproj: MESSAGE` to standard error, until stop() says so. Where that cannot be written, nobody is told.
void complain(const std::string& message, const Stop& stop = {});

/// What operator new does in place of throwing: parts of libraries end or go on with less (streams, the
/// destructor of nlohmann's JSON). Waits for what another thread is writing, so that it is whole.
[[noreturn]] void endWithoutMemory();

/// Removes the last bytes written, where standard output is a file that ends with them.
void takeBack(std::size_t bytes) noexcept;

}  // namespace viewproj::cmd
