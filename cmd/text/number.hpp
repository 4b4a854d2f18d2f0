// Numbers from text, and as text.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "text/text_buffer.hpp"

namespace viewproj::cmd {

inline bool isDigit(char c) { return c >= '0' && c <= '9'; }

/// Reads the double nearest the decimal number that a text begins with, as std::from_chars does where a standard
/// library has it for doubles: infinite beyond the largest, 0 next to zero. Returns where the number ends, or null if
/// there is none.
const char* readNumber(const char* begin, const char* end, double& number);

/// As readNumber, of a number that JSON has and that is finite: null for 01, 1. and .5, and for 1e999.
const char* readJsonNumber(const char* begin, const char* end, double& number);

/// The double nearest the decimal text, blanks around it and a leading + allowed; nothing if the text is not a finite
/// number as a whole.
std::optional<double> parseNumber(std::string_view text);

/// Whether a text is a number as a whole, in digits, that is too large for a double.
bool isLargerThanDoubles(std::string_view text);

/// Numbers separated by commas; nothing if one is wrong.
std::optional<std::vector<double>> parseNumberList(std::string_view text);

/// Appends the shortest text that reads back to the same double (float), digits first: an exponent only below 1e-5 and
/// from 1e16 on. What is not finite becomes `null`, the word for no value.
void appendNumber(std::string& out, double value);
void appendNumber(std::string& out, float value);
void appendNumber(TextBuffer& out, double value);

std::string formatNumber(double value);

/// Rounded to so many significant digits first.
std::string formatDigits(double value, int digits);

/// The value to so many significant digits; 0: as it is.
double toDigits(double value, int digits);
/// What --digits takes.
inline constexpr std::size_t kMostDigits = 17;

/// A count, a rate or a size in three digits and the unit that suits them: "999", "1 k", "1.23 M", up to T.
std::string formatCount(double value);

}  // namespace viewproj::cmd
