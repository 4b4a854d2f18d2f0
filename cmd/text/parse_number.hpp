// Numbers from text.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace viewproj::cmd {

/// Reads the double nearest the decimal number that a text begins with, as std::from_chars does where a standard
/// library has it for doubles: infinite beyond the largest, 0 next to zero. Returns where the number ends, or null if
/// there is none.
const char* readNumber(const char* begin, const char* end, double& number);

/// As readNumber, of a number that JSON has and that is finite: null for 01, 1. and .5, and for 1e999.
const char* readJsonNumber(const char* begin, const char* end, double& number);

/// The double nearest the decimal text, blanks around it and a leading + allowed; nothing if the text is not a finite
/// number as a whole.
std::optional<double> parseNumber(std::string_view text);

/// Numbers separated by commas; nothing if one is wrong.
std::optional<std::vector<double>> parseNumberList(std::string_view text);

}  // namespace viewproj::cmd
