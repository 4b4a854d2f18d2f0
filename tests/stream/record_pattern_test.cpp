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

RecordPattern patternOf(const std::string& text) {
  const RecordParts record = jsonParts(text);
  return patternOf(record, findPoint(record, {.columns = {}, .worldIsEcef = text.find("lat") != std::string::npos}));
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

TEST_CASE("Records are alike but for their numbers and the fields that are not read") {
  const std::string record = R"({"id":"p1", "tag":"P","x":1,"y":-2.5,"z":3e2,"n":{"a":[1,null]}})";
  const auto with = [&](std::string_view part, const std::string& other) {
    std::string text = record;
    return text.replace(text.find(part), part.size(), other);
  };
  CHECK(isLike(record, record));
  for (const auto& [part, other] : std::initializer_list<std::pair<const char*, const char*>>{
           {"p1", ""},
           {"p1", "\xc3\xa9"},
           {"p1", R"(\"\\\/\b\f\n\r\t\u00e9\uD7fF\uE000\uD83D\uDE00)"},
           {"\"p1\"", "7"},
           {"\"p1\"", "-1e3"},
           {"\"p1\"", "null"},
           {"\"p1\"", "[]"},
           {"\"p1\"", "{ }"},
           {"\"p1\"", "[true ,\tfalse,\n[{\"b\" : {\"c\":0}, \"\":1}] ]"},
           {"\"P\"", "\"Q\""},
           {"1,", "-0,"},
           {"1,", " \t1 \r\n,"},
           {"-2.5", "1234567.12345678"},
           {"3e2", "0.1"},
       }) {
    INFO(with(part, other));
    CHECK(isLike(record, with(part, other)));
  }
  // What stands after it is another's.
  CHECK(lengthOf(record, record + " {}") == record.size());

  for (const auto& [part, other] : std::initializer_list<std::pair<const char*, const char*>>{
           {", ", ","},
           {"\"y\"", "\"Y\""},
           {"-2.5", "\"2\""},
           {"-2.5", "null"},
           {"1,", "01,"},
           {"-2.5", "-2."},
           {"3e2", "3e999"},
           {"}}", "}"},
           {"p1", R"(\a)"},
           {"p1", R"(p1\)"},
           {"p1", R"(\u00g0)"},
           {"p1", R"(\ud800)"},
           {"p1", R"(\ud800\n)"},
           {"p1", R"(\ud800\u0041)"},
           {"p1", R"(\udc00)"},
           {"p1", "p\n1"},
           {"p1", "p\xc3"},
           {"\"p1\"", "1e999"},  // nlohmann-json has none such
           {"\"p1\"", "nul"},
           {"\"p1\"", "tru"},
           {"\"p1\"", ""},
           {"\"p1\"", "[1,]"},
           {"\"p1\"", "[1 2]"},
           {"\"p1\"", "[1}"},
           {"\"p1\"", "[1 22]"},
           {"\"p1\"", "{\"a\"}"},
           {"\"p1\"", "{\"a\":}"},
           {"\"p1\"", "{a:1}"},
           {"\"p1\"", "[[[[[[[[[[[[[[[[[]]]]]]]]]]]]]]]]]"},  // deeper than any
       }) {
    INFO(with(part, other));
    CHECK(lengthOf(record, with(part, other)) == 0);
  }
  for (std::size_t size = 0; size < record.size(); ++size) CHECK(lengthOf(record, record.substr(0, size)) == 0);
}

TEST_CASE("What would make a record another, an array of them, or a document, is none like it") {
  const std::string pos = R"({"point":"A12","pos":[1,2,3]})";
  CHECK(isLike(pos, R"({"point":"","pos":[1,2,3e5]})"));
  CHECK(lengthOf(pos, R"({"point":[4,5,6],"pos":[1,2,3]})") == 0);
  CHECK(lengthOf(R"({"points":1,"x":1,"y":2,"z":3})", R"({"points":[],"x":1,"y":2,"z":3})") == 0);
  CHECK(lengthOf(R"({"points":[],"x":1,"y":2,"z":3})", R"({"points":[],"x":1,"y":2,"z":3})") == 0);
  CHECK(isLike(R"({"x":1,"points":1,"y":2,"z":3})", R"({"x":1,"points":[],"y":2,"z":3})"));
}

TEST_CASE("Records whose numbers are more than read, and long ones, have no pattern") {
  const std::string place = R"({"position":{"lat":48.86,"lon":2.35,"height":30}})";
  CHECK(lengthOf(place, place) == 0);
  const std::string fields = R"({"lat":48.86,"lon":2.35,"height":30})";
  CHECK(isLike(fields, fields));
  const std::string in = R"({"position":{"x":1,"y":2,"z":3}})";
  CHECK(isLike(in, R"({"position":{"x":-1.5,"y":20,"z":3e3}})"));
  CHECK(lengthOf(in, R"({"position":{"x":1,"z":2,"y":3}})") == 0);
  const std::string tag(20000, 'a');
  CHECK(isLike(R"({"x":1,"y":2,"z":3,"tag":""})", R"({"x":1,"y":2,"z":3,"tag":")" + tag + "\"}"));
  const std::string named = R"({"x":1,"y":2,"z":3,")" + tag + "\":1}";
  CHECK(lengthOf(named, named) == 0);
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
