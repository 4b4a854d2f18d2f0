// Standard output, written whole or with an error.
#pragma once

#include <string_view>

namespace viewproj::cmd {

/// Writes all of text. Throws ClosedPipe where nobody reads any more, InputError where it cannot be written.
void writeOutput(std::string_view text);

}  // namespace viewproj::cmd
