// A record that a pattern takes is one by nlohmann-json, of the same shape and with the numbers that it has there.
#include "records/record_pattern.hpp"

#include <bit>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "catch.hpp"
#include "records/points.hpp"
#include "stream/random_text.hpp"
#include "text/error.hpp"

using namespace viewproj::cmd;
using namespace viewproj::tests;

namespace {

RecordPattern patternOf(const RecordParts& record, const Layout& layout) {
  Numbers numbers;
  NumberTexts texts;
  readNumbers(record, layout, numbers, &texts);
  return RecordPattern(record, layout, numbers, texts);
}

bool sameBits(const Numbers& a, const Numbers& b, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i)
    if (std::bit_cast<std::uint64_t>(a[i]) != std::bit_cast<std::uint64_t>(b[i])) return false;
  return true;
}

}  // namespace

TEST_CASE("What a pattern takes is what nlohmann-json takes, number for number") {
  std::map<std::string, int> taken;
  int left = 0, bad = 0;
  for (std::uint64_t trial = 0; trial < 200'000; ++trial) {
    RandomText random(trial);
    const std::string first = random.record(random.oneIn(2));
    const RecordParts before = jsonParts(first);
    Layout layout;
    try {
      layout = findPoint(before, {});
    } catch (const RecordError&) {
      continue;
    }
    const RecordPattern pattern = patternOf(before, layout);
    std::string text = first;
    std::string kind(random.mutate(text));
    if (random.oneIn(2)) kind = random.mutate(text);
    text += random.oneIn(2) ? "\n" : " {\"x\":1}";
    Numbers numbers;
    const std::size_t size = pattern.read(text, numbers);
    if (size == 0) {
      ++left;
      continue;
    }
    INFO("trial " << trial << ": " << first << " then " << text);
    const std::string record = text.substr(0, size);
    const auto judged = nlohmann::json::parse(record, nullptr, false);
    if (judged.is_discarded()) FAIL("no JSON");
    const RecordParts parts = jsonParts(record);
    Numbers expected;
    readNumbers(parts, layout, expected);
    if (parts.shape.names != before.shape.names || parts.shape.size != before.shape.size || !layout.fits(parts.values))
      FAIL("of another shape");
    if (!sameBits(numbers, expected, layout.slots())) FAIL("other numbers");
    ++taken[record == first ? "as it was" : kind];
    bad += !nlohmann::json::accept(text);
  }
  for (const char* kind :
       {"as it was", "bit flipped", "byte put in", "bytes left out", "bytes doubled", "odd number"}) {
    INFO(kind);
    CHECK(taken[kind] > 200);
  }
  CHECK(left > 50'000);
  CHECK(bad > 500);
}
