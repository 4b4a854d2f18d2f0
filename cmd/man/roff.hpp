// The few marks of man(7) that the manual page needs.
#pragma once

#include <string>
#include <string_view>

namespace viewproj::cmd::roff {

/// Every character as itself.
std::string escaped(std::string_view text);

std::string bold(std::string_view text);
std::string italic(std::string_view text);

/// Lines of a paragraph, none of them long.
std::string filled(const std::string& text);

/// Lines as they are, further in.
std::string verbatim(const std::string& text);

}  // namespace viewproj::cmd::roff
