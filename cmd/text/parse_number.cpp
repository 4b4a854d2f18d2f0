#include <fast_float/fast_float.h>

#include <algorithm>
#include <bit>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "text/number.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {

namespace {

struct Digits {
  std::int64_t value;
  int count;
};

/// The digits at the start of eight bytes, without a branch that depends on their number.
Digits leadingDigits(const char* at) {
  std::uint64_t bytes = 0;
  std::memcpy(&bytes, at, sizeof bytes);
  bytes ^= 0x3030303030303030;
  const int count = std::countr_zero(((bytes + 0x7676767676767676) | bytes) & 0x8080808080808080) / 8;
  if (count == 0) return {0, 0};
  bytes <<= 64 - 8 * count;  // zeros in front of the digits
  bytes = 10 * bytes + (bytes >> 8);
  constexpr std::uint64_t kPairs = 0x000000ff000000ff;
  bytes = (bytes & kPairs) * (100 + (std::uint64_t{1000000} << 32)) +
          (bytes >> 16 & kPairs) * (1 + (std::uint64_t{10000} << 32));
  return {static_cast<std::int64_t>(bytes >> 32), count};
}

/// Like readNumber for up to eight digits before a point and after it; else null. The quotient of two integers that
/// doubles hold exactly is the double nearest to the decimal. fast_float's branches on the number of digits would take
/// a fifth of a stream's time.
const char* readShort(const char* begin, const char* end, double& number) {
  constexpr std::ptrdiff_t kLongest = 1 + 8 + 1 + 8 + 1;  // includes the byte after it
  constexpr std::int64_t kPowers[] = {1, 10, 100, 1000, 10000, 100000, 1000000, 10000000, 100000000};
  if (std::endian::native != std::endian::little || FLT_EVAL_METHOD != 0 || end - begin < kLongest) return nullptr;
  const bool negative = *begin == '-';
  const char* at = begin + negative;
  Digits digits = leadingDigits(at);
  if (digits.count == 0) return nullptr;
  at += digits.count;
  int decimals = 0;
  if (*at == '.') {
    const Digits more = leadingDigits(++at);
    if (more.count == 0) return nullptr;
    decimals = more.count;
    digits.value = digits.value * kPowers[decimals] + more.value;
    at += decimals;
  }
  if (isDigit(*at) || (*at | 0x20) == 'e' || digits.value > std::int64_t{1} << 53) return nullptr;
  number = std::copysign(static_cast<double>(digits.value) / static_cast<double>(kPowers[decimals]), negative ? -1 : 1);
  return at;
}

const char* readAny(const char* begin, const char* end, double& number) {
  // Newer versions report a number beyond all doubles, or next to zero, as an error, but still give its value.
  const auto [stop, error] = fast_float::from_chars(begin, end, number);
  return error == std::errc::invalid_argument ? nullptr : stop;
}

}  // namespace

const char* readNumber(const char* begin, const char* end, double& number) {
  const char* const stop = readShort(begin, end, number);
  return stop ? stop : readAny(begin, end, number);
}

const char* readJsonNumber(const char* begin, const char* end, double& number) {
  const char* digit = begin < end && *begin == '-' ? begin + 1 : begin;
  if (digit == end || !isDigit(*digit) || (*digit == '0' && end - digit > 1 && isDigit(digit[1]))) return nullptr;
  if (const char* const stop = readShort(begin, end, number)) return stop;
  while (digit < end && isDigit(*digit)) ++digit;
  if (digit < end && *digit == '.' && (end - digit == 1 || !isDigit(digit[1]))) return nullptr;
  const char* const stop = readAny(begin, end, number);
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
