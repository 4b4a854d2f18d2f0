#include <fast_float/fast_float.h>

#include <algorithm>
#include <cmath>

#include "text/number.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {

const char* readNumber(const char* begin, const char* end, double& number) {
  // Newer versions report a number beyond all doubles, or next to zero, as an error, but still give its value.
  const auto [stop, error] = fast_float::from_chars(begin, end, number);
  return error == std::errc::invalid_argument ? nullptr : stop;
}

const char* passJsonNumber(const char* at, const char* end, double& number) {
  constexpr std::ptrdiff_t kFinite = 300;  // so many digits are
  const char* digit = at < end && *at == '-' ? at + 1 : at;
  if (digit == end || !isDigit(*digit) || (*digit == '0' && end - digit > 1 && isDigit(digit[1]))) return nullptr;
  while (digit < end && isDigit(*digit)) ++digit;
  if ((digit == end || (*digit != '.' && (*digit | 0x20) != 'e')) && digit - at < kFinite) return digit;
  if (digit < end && *digit == '.' && (end - digit == 1 || !isDigit(digit[1]))) return nullptr;
  const char* const stop = readNumber(at, end, number);
  return std::isfinite(number) ? stop : nullptr;
}

std::optional<double> parseNumber(std::string_view text) {
  text = trimmed(text);
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0;
  const char* const end = text.data() + text.size();
  if (readNumber(text.data(), end, value) != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

bool isLargerThanDoubles(std::string_view text) {
  double number = 0;
  const char* const end = text.data() + text.size();
  return !text.empty() && isDigit(text.back()) && readNumber(text.data(), end, number) == end && std::isinf(number);
}

std::optional<std::vector<double>> parseNumberList(std::string_view text) {
  std::vector<double> numbers;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    const auto number = parseNumber(text.substr(at, comma - at));
    if (!number) return std::nullopt;
    numbers.push_back(*number);
    at = comma + 1;
  }
  return numbers;
}

}  // namespace viewproj::cmd
