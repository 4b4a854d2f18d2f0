// Numbers from text, and as text.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "text/text_buffer.hpp"

namespace viewproj::cmd {

inline bool isDigit(char c) { return c >= '0' && c <= '9'; }
inline bool beginsNumber(char c) { return c == '-' || isDigit(c); }

/// Among numbers: there is none.
inline constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

/// Reads the double nearest to the decimal number at the beginning of a text, like std::from_chars, but infinite beyond
/// the largest double and 0 next to zero. Returns the end of the number, or null if there is none.
const char* readNumber(const char* begin, const char* end, double& number);

/// Returns the end of the finite number that begins at `at`, or null if JSON does not allow it: 01, 1., .5, 1e999.
/// Reads it if it has a fraction or an exponent. Integers are often names: for them `number` stays as it is.
const char* passJsonNumber(const char* at, const char* end, double& number);

/// The double nearest to a decimal text. Blanks around it and a leading + are allowed. Nothing if the whole text is not
/// a finite number.
std::optional<double> parseNumber(std::string_view text);

/// Whether the whole text is a number in digits that is too large for a double.
bool isLargerThanDoubles(std::string_view text);

/// The numbers of a list separated by commas; nothing if one is wrong.
std::optional<std::vector<double>> parseNumberList(std::string_view text);

/// Appends the shortest text that reads back to the same double (float). Uses an exponent only below 1e-5 and from 1e16
/// on. Infinities and NaN become `null`, the word for no value.
void appendNumber(std::string& out, double value);
void appendNumber(std::string& out, float value);
void appendNumber(TextBuffer& out, double value);

std::string formatNumber(double value);

/// Rounds to this many significant digits first.
std::string formatDigits(double value, int digits);

/// The value rounded to this many significant digits; 0 keeps it.
double toDigits(double value, int digits);
/// The largest value of --digits.
inline constexpr std::size_t kMostDigits = 17;

/// A count, a rate or a size in three digits with a suitable unit: "999", "1 k", "1.23 M", up to T.
std::string formatCount(double value);

}  // namespace viewproj::cmd
