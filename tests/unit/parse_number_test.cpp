#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "catch.hpp"
#include "text/number.hpp"

using namespace viewproj::cmd;

namespace {

struct Read {
  std::ptrdiff_t length;  ///< -1: no number
  double value;
};

Read read(const std::string& text) {
  double value = 0;
  const char* const end = readNumber(text.data(), text.data() + text.size(), value);
  return {end ? end - text.data() : -1, value};
}

bool isRead(const std::string& text, std::ptrdiff_t length, double value) {
  const Read r = read(text);
  return r.length == length && std::bit_cast<std::uint64_t>(r.value) == std::bit_cast<std::uint64_t>(value);
}

}  // namespace

TEST_CASE("A number's text is read to the double nearest, and to where it ends") {
  CHECK(isRead("1.5,2", 3, 1.5));
  CHECK(isRead("-0", 2, -0.0));
  CHECK(isRead("1e5e5", 3, 1e5));
  CHECK(isRead("1e", 1, 1));
  CHECK(isRead("1e+", 1, 1));
  CHECK(isRead("1.", 2, 1));
  CHECK(isRead(".5x", 2, 0.5));
  CHECK(isRead("0x10", 1, 0));
  CHECK(isRead("1e400 ", 5, HUGE_VAL));
  CHECK(isRead("-1e400", 6, -HUGE_VAL));
  CHECK(isRead("1e-400", 6, 0));
  CHECK(isRead("5e-324", 6, 0x1p-1074));
  CHECK(isRead("2.4703282292062327e-324", 23, 0));
  CHECK(isRead("2.4703282292062328e-324", 23, 0x1p-1074));
  CHECK(isRead("1.7976931348623158e308", 22, 0x1.fffffffffffffp1023));
  // Halfway between two doubles, and a digit beyond that, far to the right.
  CHECK(isRead("9007199254740993", 16, 9007199254740992));
  CHECK(isRead("9007199254740993." + std::string(800, '0') + "1", 818, 9007199254740994));
  CHECK(isRead("infinity", 8, HUGE_VAL));
  CHECK(read("nan").length == 3);
  for (const char* none : {"", "-", "+1", " 1", ".", "e5", "-.e5", "--1", "x", "in"}) {
    INFO(none);
    CHECK(read(none).length == -1);
  }
}

TEST_CASE("A million doubles and odd texts are read as the standard library reads them") {
  std::mt19937_64 random(0);
  int wrong = 0, plain = 0, odd = 0;
  char text[64];
  for (int i = 0; i < 1'000'000; ++i) {
    const auto number = std::bit_cast<double>(random());
    if (!std::isfinite(number)) continue;
    // As many digits as tell the double, and now and then fewer or more; then a character changed for another.
    const int digits = i % 4 == 0 ? static_cast<int>(random() % 25) : 16;
    int length = std::snprintf(text, sizeof text, "%.*e", digits, number);
    const bool isOdd = i % 8 == 1;
    if (isOdd) text[random() % static_cast<unsigned>(length)] = "0123456789.-+eE,x "[random() % 18];
    const Read r = read({text, static_cast<std::size_t>(length)});
#ifdef __cpp_lib_to_chars
    double value = 0;
    const auto [end, error] = std::from_chars(text, text + length, value);
    const bool isNone = error == std::errc::invalid_argument;
    if (error == std::errc::result_out_of_range)
      value = std::strtod(std::string(text, static_cast<std::size_t>(end - text)).c_str(), nullptr);
    wrong += isNone ? r.length != -1 : r.length != end - text || r.value != value;
#else
    if (!isOdd) wrong += r.length != length || r.value != std::strtod(text, nullptr);
#endif
    (isOdd ? odd : plain) += 1;
  }
  CHECK(wrong == 0);
  CHECK(plain > 800'000);
  CHECK(odd > 100'000);
}
