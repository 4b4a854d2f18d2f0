#include <dragonbox/dragonbox.h>

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <utility>

#include "text/number.hpp"

namespace viewproj::cmd {
namespace {

/// Longer than any number, and than what is written on the way to it.
constexpr std::size_t kLongest = 40;

/// The most digits that the shortest text of a double has.
constexpr int kDigits = 17;

constexpr std::size_t kPowers = kDigits + 1;

consteval auto powersOfTen() {
  std::array<std::uint64_t, kPowers> powers = {1};
  for (std::size_t i = 1; i < kPowers; ++i) powers[i] = 10 * powers[i - 1];
  return powers;
}
constexpr auto kPowersOfTen = powersOfTen();

/// For 0 < number < 10^17.
int countDigits(std::uint64_t number) {
  const double size = static_cast<double>(static_cast<std::int64_t>(number));
  const int bits = static_cast<int>(std::bit_cast<std::uint64_t>(size) >> 52) - 1022;
  const int atLeast = bits * 1233 >> 12;  // by log10(2)
  return atLeast + (number >= kPowersOfTen[static_cast<std::size_t>(atLeast)] ? 1 : 0);
}

/// The digits of a number below 10^8, one byte each, the first in the highest byte.
std::uint64_t eightDigits(std::uint32_t number) {
  std::uint64_t digits = number % 10000 | static_cast<std::uint64_t>(number / 10000) << 32;
  const std::uint64_t hundreds = digits * 10486 >> 20 & 0x7f0000007f;
  digits = (digits - 100 * hundreds) | hundreds << 16;
  const std::uint64_t tens = digits * 103 >> 10 & 0xf000f000f000f;
  return (digits - 10 * tens) | tens << 8;
}

/// The digits as characters.
std::uint64_t asText(std::uint64_t digits) { return digits | 0x3030303030303030; }

/// Inserts a point after the first `before` of eight digits, 1 to 7. The last digit is lost.
std::uint64_t withPoint(std::uint64_t text, int before) {
  const std::uint64_t after = ~std::uint64_t{0} >> 8 * before;
  return (text & ~after) | std::uint64_t{'.'} << (56 - 8 * before) | (text & after) >> 8;
}

void put(char* out, std::uint64_t text) {
  if (std::endian::native == std::endian::little) text = __builtin_bswap64(text);
  std::memcpy(out, &text, sizeof text);
}

/// The number 0.DIGITS * 10^point. count: how many digits there are up to the last that is not 0.
struct Digits {
  std::uint64_t first, second;  ///< eight digits each, as text
  char last;
  int count, point;
};

/// The shortest digits that read back to the same number. value must be finite and not 0.
template <class T>
Digits shortestDigits(T value) {
  namespace policy = jkj::dragonbox::policy;
  const auto decimal = jkj::dragonbox::to_decimal(value, policy::sign::ignore, policy::trailing_zero::ignore);
  std::uint64_t number = decimal.significand;
  int size;
  if (number >= kPowersOfTen[15]) {  // nearly all doubles with many digits
    const bool all = number >= kPowersOfTen[16];
    size = all ? kDigits : kDigits - 1;
    number = all ? number : 10 * number;
  } else {
    size = countDigits(number);
    number *= kPowersOfTen[static_cast<std::size_t>(kDigits - size)];
  }
  const auto rest = static_cast<std::uint32_t>(number % 1'000'000'000), last = rest % 10;
  const std::uint64_t first = eightDigits(static_cast<std::uint32_t>(number / 1'000'000'000));
  const std::uint64_t second = eightDigits(rest / 10);
  const auto ended = [](std::uint64_t digits) { return 8 - (std::countr_zero(digits) >> 3); };
  const int count = last != 0 ? kDigits : second != 0 ? 8 + ended(second) : ended(first);
  return {asText(first), asText(second), static_cast<char>('0' + last), count, size + decimal.exponent};
}

void putAll(char* out, const Digits& digits) {
  put(out, digits.first);
  put(out + 8, digits.second);
  out[16] = digits.last;
}

/// Writes a number with `point` digits before the point, 1 to 16. May overwrite bytes after the end that it returns.
char* putWithoutExponent(char* out, Digits digits) {
  if (digits.point > 8) {
    put(out, digits.first);
    out += 8;
    const std::uint64_t rest = static_cast<std::uint64_t>(digits.last) << 56 | asText(0) >> 8;
    digits = {digits.second, rest, '0', digits.count - 8, digits.point - 8};
  }
  const bool isPointAfterFirst = digits.point == 8;
  put(out, isPointAfterFirst ? digits.first : withPoint(digits.first, digits.point));
  out[8] = isPointAfterFirst ? '.' : static_cast<char>(digits.first & 0xff);
  put(out + 9, digits.second);
  out[17] = digits.last;
  return out + (digits.count > digits.point ? digits.count + 1 : digits.point);
}

/// Returns the end of the written text.
template <class T>
char* write(char* out, T value) {
  if (!std::isfinite(value)) {
    std::memcpy(out, "null", 4);
    return out + 4;
  }
  *out = '-';
  out += std::signbit(value) ? 1 : 0;
  if (value == 0) {
    *out = '0';
    return out + 1;
  }
  const Digits digits = shortestDigits(value);
  // Beyond the integers that T holds exactly, digits without an exponent would be longer than the shortest text.
  if (digits.point > 0 && digits.point <= (sizeof(T) == sizeof(double) ? 16 : 7))
    return putWithoutExponent(out, digits);
  if (digits.point <= 0 && digits.point >= -4) {
    std::memcpy(out, "0.0000", 6);
    out += 2 - digits.point;
    putAll(out, digits);
    return out + digits.count;
  }
  putAll(out + 1, digits);
  out[0] = out[1];
  out[1] = '.';
  out += digits.count > 1 ? digits.count + 1 : 1;
  *out++ = 'e';
  return std::to_chars(out, out + kLongest / 4, digits.point - 1).ptr;
}

}  // namespace

double toDigits(double value, int digits) {
  if (digits == 0 || !std::isfinite(value)) return value;
  char text[kLongest];
  // Not std::to_chars, whose tables are larger than all that is in here.
  const int size = std::snprintf(text, sizeof text, "%.*e", digits - 1, value);
  readNumber(text, text + size, value);
  return value;
}

void appendNumber(std::string& out, double value) {
  char text[kLongest];
  out.append(text, write(text, value));
}

void appendNumber(std::string& out, float value) {
  char text[kLongest];
  out.append(text, write(text, value));
}

void appendNumber(TextBuffer& out, double value) { out.written(write(out.room(kLongest), value)); }

std::string formatNumber(double value) {
  std::string text;
  appendNumber(text, value);
  return text;
}

std::string formatDigits(double value, int digits) { return formatNumber(toDigits(value, digits)); }

std::string formatCount(double value) {
  static constexpr std::pair<double, const char*> kUnits[] = {{1e12, " T"}, {1e9, " G"}, {1e6, " M"}, {1e3, " k"}};
  constexpr int kFew = 3;
  value = toDigits(value, kFew);  // round first: 999.6 is 1 k
  for (const auto& [unit, name] : kUnits)
    if (std::fabs(value) >= unit) return formatDigits(value / unit, kFew) + name;
  return formatNumber(value);
}

}  // namespace viewproj::cmd
