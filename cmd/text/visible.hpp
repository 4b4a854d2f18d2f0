// Names and other text of an input or a command line as messages and terminals can have them.
#pragma once

#include <string>
#include <string_view>

namespace viewproj::cmd {

/// With <U+001B> and the like for control characters (of ASCII, of Unicode, and those that turn the direction of
/// writing), which a terminal would obey. kept: characters that stay.
std::string visible(std::string_view text, std::string_view kept = "");

/// The beginning of a text in quotes, visible and on one line.
std::string inQuotes(std::string_view text, std::size_t most = 40);

}  // namespace viewproj::cmd
