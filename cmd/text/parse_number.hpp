// Numbers from text.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace viewproj::cmd {

/// The double nearest the decimal text, blanks around it and a leading + allowed; nothing if the text is not a finite
/// number as a whole.
std::optional<double> parseNumber(std::string_view text);

/// Numbers separated by commas; nothing if one is wrong.
std::optional<std::vector<double>> parseNumberList(std::string_view text);

}  // namespace viewproj::cmd
