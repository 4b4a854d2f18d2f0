#include "text/parse_number.hpp"

#include <fast_float/fast_float.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace viewproj::cmd {

const char* readNumber(const char* begin, const char* end, double& number) {
  // Newer versions call what is beyond all doubles, or next to zero, an error, and give its value all the same.
  const auto [stop, error] = fast_float::from_chars(begin, end, number);
  return error == std::errc::invalid_argument ? nullptr : stop;
}

double powerOfTen(int exponent) {
  const std::string text = "1e" + std::to_string(exponent);
  double power = 0;
  readNumber(text.data(), text.data() + text.size(), power);
  return power;
}

std::optional<double> parseNumber(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return std::nullopt;
  text = text.substr(first, text.find_last_not_of(" \t") - first + 1);
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0;
  const char* const end = text.data() + text.size();
  if (readNumber(text.data(), end, value) != end || !std::isfinite(value)) return std::nullopt;
  return value;
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
