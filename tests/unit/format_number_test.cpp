#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <optional>
#include <string>

#include "catch.hpp"
#include "random.hpp"
#include "text/number.hpp"

using namespace viewproj::cmd;

namespace {

template <class T>
std::string format(T value) {
  std::string text;
  appendNumber(text, value);
  return text;
}

/// The standard library's shortest digits, laid out here.
template <class T>
std::string expected(T value) {
  if (!std::isfinite(value)) return "null";
  char text[64];
  const std::string written(text, std::to_chars(text, text + sizeof text, value, std::chars_format::scientific).ptr);
  const std::size_t e = written.find('e');
  const int point = std::atoi(written.c_str() + e + 1) + 1;  // 0.DIGITS * 10^point
  std::string sign, digits;
  for (const char c : written.substr(0, e))
    if (c == '-')
      sign = "-";
    else if (c != '.')
      digits += c;
  const int count = static_cast<int>(digits.size()), most = sizeof(T) == sizeof(double) ? 16 : 7;
  if (digits == "0") return sign + "0";
  if (point > most || point < -4)
    return sign + digits[0] + (count > 1 ? "." + digits.substr(1) : "") + "e" + std::to_string(point - 1);
  if (point <= 0) return sign + "0." + std::string(static_cast<std::size_t>(-point), '0') + digits;
  if (count <= point) return sign + digits + std::string(static_cast<std::size_t>(point - count), '0');
  return sign + digits.insert(static_cast<std::size_t>(point), ".");
}

/// VIEWPROJ_NUMBERS in the environment.
std::uint64_t numbersWanted() {
  const char* wanted = std::getenv("VIEWPROJ_NUMBERS");
  return wanted ? std::strtoull(wanted, nullptr, 10) : 1'000'000;
}

}  // namespace

TEST_CASE("A power of ten is written with one digit") {
  for (int power = -323; power <= 308; ++power) {
    const double value = std::strtod(("1e" + std::to_string(power)).c_str(), nullptr);
    CHECK(format(value) == expected(value));
  }
}

TEST_CASE("A million numbers of every size and of few digits are written as the shortest text that reads back") {
  constexpr const char* kKinds[] = {"any bits", "on a screen", "whole", "decimals", "power of two and its neighbours",
                                    "float"};
  std::array<std::uint64_t, std::size(kKinds)> visited{};
  std::uint64_t wrong = 0;
  const std::uint64_t count = numbersWanted();
  std::optional<Random> random;
  for (std::uint64_t trial = 0; trial < count; ++trial) {
    if (trial % 1000 == 0) random.emplace(trial / 1000);
    const auto bits = static_cast<std::uint64_t>(random->below(~std::size_t{0}));
    const std::size_t kind = trial % std::size(kKinds);
    double value = 0;
    if (kind == 0) value = std::bit_cast<double>(bits);
    if (kind == 1) value = random->uniform(0, 1920);
    if (kind == 2) value = static_cast<double>(static_cast<std::int64_t>(bits) >> random->below(64));
    if (kind == 3)
      value = static_cast<double>(static_cast<std::int64_t>(bits) >> (12 + random->below(52))) /
              std::pow(10.0, static_cast<double>(random->below(20)));
    if (kind == 4) value = std::bit_cast<double>((bits & 0x7ff0000000000000) + random->below(5) - 2);
    bool right = kind < 5 && format(value) == expected(value);
    if (kind == 5) {
      const auto single = std::bit_cast<float>(static_cast<std::uint32_t>(bits));
      right = format(single) == expected(single);
    }
    if (!right && ++wrong == 1) {
      INFO(kKinds[kind] << ", trial " << trial << ": " << format(value) << " in place of " << expected(value));
      CHECK(false);
    }
    ++visited[kind];
  }
  CHECK(wrong == 0);
  for (const std::uint64_t times : visited) CHECK(times >= count / std::size(kKinds));
}
