// Numbers as text.
#pragma once

#include <string>

#include "text/text_buffer.hpp"

namespace viewproj::cmd {

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
