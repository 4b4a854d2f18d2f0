// Patterns of names.
#pragma once

#include <string_view>

namespace viewproj::cmd {

/// Whether a name is a pattern's, in which * stands for any text.
bool fitsPattern(std::string_view name, std::string_view pattern);

}  // namespace viewproj::cmd
