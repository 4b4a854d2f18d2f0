// A record that a pattern takes is one by nlohmann-json, of the same shape and with the numbers that it has there.
#include "input/record_pattern.hpp"

#include <bit>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "catch.hpp"
#include "input/points.hpp"
#include "stream/random_text.hpp"
#include "text/error.hpp"

using namespace viewproj::cmd;
using namespace viewproj::tests;

namespace {

RecordPattern patternOf(const std::string& text) {
  const RecordParts record = jsonParts(text);
  return RecordPattern(record,
                       findPoint(record, {.columns = {}, .worldIsEcef = text.find("lat") != std::string::npos}));
}

std::size_t lengthOf(const std::string& pattern, const std::string& text) {
  Numbers numbers;
  return patternOf(pattern).read(text, numbers);
}

bool isLike(const std::string& pattern, const std::string& text) { return lengthOf(pattern, text) == text.size(); }

bool sameBits(const Numbers& a, const Numbers& b, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i)
    if (std::bit_cast<std::uint64_t>(a[i]) != std::bit_cast<std::uint64_t>(b[i])) return false;
  return true;
}

}  // namespace

TEST_CASE("Records are alike but for numbers, strings and flags") {
  const std::string record = R"({"id":"p1", "x":1,"y":-2.5,"z":3e2,"on":true,"at":null,"n":[1,"a"]})";
  const auto with = [&](const std::string& other, std::string_view part) {
    std::string text = record;
    return text.replace(text.find(part), part.size(), other);
  };
  CHECK(isLike(record, record));
  for (const auto& [part, other] : std::initializer_list<std::pair<const char*, const char*>>{
           {"p1", ""},
           {"p1", "\xc3\xa9"},
           {"p1", R"(\"\\\/\b\f\n\r\t)"},
           {"1,", "-0,"},
           {"-2.5", "1234567.12345678"},
           {"3e2", "0.1"},
           {"true", "false"},
           {"[1,", "[7,"},
       }) {
    INFO(with(other, part));
    CHECK(isLike(record, with(other, part)));
  }
  // What stands after it is another's.
  CHECK(lengthOf(record, record + " {}") == record.size());

  for (const auto& [part, other] : std::initializer_list<std::pair<const char*, const char*>>{
           {", ", ","},
           {"\"y\"", "\"Y\""},
           {"-2.5", "\"2\""},
           {"\"p1\"", "7"},
           {"true", "null"},
           {"null", "true"},
           {"[1,", "[1,2,"},
           {"p1", "\\u0041"},
           {"p1", "\\a"},
           {"p1", "p1\\"},
           {"p1", "p\n1"},
           {"p1", "p\xc3"},
           {"1,", "01,"},
           {"-2.5", "-2."},
           {"3e2", "3e999"},
           {"[1,", "[1e999,"},  // nlohmann-json has none such
           {"]}", "]"},
       }) {
    INFO(with(other, part));
    CHECK(lengthOf(record, with(other, part)) == 0);
  }
  for (const char* none : {"", "{"}) CHECK(lengthOf(record, none) == 0);
}

TEST_CASE("Records whose numbers are more than read, and long ones, have no pattern") {
  const std::string place = R"({"position":{"lat":48.86,"lon":2.35,"height":30}})";
  CHECK(lengthOf(place, place) == 0);
  const std::string fields = R"({"lat":48.86,"lon":2.35,"height":30})";
  CHECK(isLike(fields, fields));
  const std::string in = R"({"position":{"x":1,"y":2,"z":3}})";
  CHECK(isLike(in, R"({"position":{"x":-1.5,"y":20,"z":3e3}})"));
  const std::string tag(5000, 'a'), longer = R"({"x":1,"y":2,"z":3,"tag":")" + tag + "\"}";
  CHECK(lengthOf(longer, longer) == 0);
}

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
    const RecordPattern pattern(before, layout);
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
