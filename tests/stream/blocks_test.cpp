// What a stream gives does not depend on where its blocks end, how it arrives, or how many work on it.
#include <cstdio>
#include <cstdlib>
#include <map>

#include "catch.hpp"
#include "stream/random_text.hpp"
#include "stream/run.hpp"

using namespace viewproj;
using namespace viewproj::cmd;
using namespace viewproj::tests;

namespace {

constexpr Form kForms[] = {Form::json, Form::csv, Form::text, Form::f64, Form::f32};
constexpr OutputForm kOutputs[] = {OutputForm::lines, OutputForm::array, OutputForm::csv, OutputForm::text,
                                   OutputForm::f64};

/// VIEWPROJ_STREAM_TRIALS in the environment: so many percent.
std::size_t trials(std::size_t usual) {
  const char* percent = std::getenv("VIEWPROJ_STREAM_TRIALS");
  return percent ? usual * std::strtoull(percent, nullptr, 10) / 100 : usual;
}

std::string inputOf(Form form, RandomText& random, std::size_t records, std::size_t bad) {
  switch (form) {
    case Form::csv:
      return random.csv(records, bad);
    case Form::text:
      return random.text(records, bad);
    case Form::f64:
    case Form::f32:
      return random.f64(records, bad);
    case Form::json:
    case Form::npy:
      break;
  }
  return random.json(records, bad);
}

std::string shown(const std::string& text) {
  std::string all;
  for (const char c : text.size() > 900 ? text.substr(0, 100) + " ... " + text.substr(text.size() - 700) : text) {
    char code[8];
    std::snprintf(code, sizeof code, "\\x%02x", static_cast<unsigned char>(c));
    all += c == '\n' ? "\\n" : c >= ' ' && c < 0x7f ? std::string(1, c) : code;
  }
  return all;
}

void requireSame(const std::string& input, const StreamHow& a, const StreamHow& b, const StreamRun& expected) {
  const StreamRun other = runStream(input, b);
  if (other == expected) return;
  FAIL("form " << (a.from ? static_cast<int>(*a.from) : -1) << " to " << (a.to ? nameOf(*a.to) : "the same")
               << ", keep going " << a.keepGoing << ", block " << b.block << ", jobs " << b.jobs << ", pieces "
               << b.largestPiece << "\ninput " << shown(input) << "\nstatus " << expected.status << " and "
               << other.status << "\nout " << shown(expected.out) << "\nand " << shown(other.out) << "\nerr "
               << shown(expected.err) << "\nand " << shown(other.err));
}

/// Other separators in place of commas, and comments of text with quotes in them.
std::string inOtherFormat(const std::string& text, Form form, RandomText& random, StreamHow& how) {
  if (form == Form::csv && random.oneIn(2)) how.delimiter = "; \t"[random.below(3)];
  const char separator = how.delimiter.value_or(form == Form::csv && random.oneIn(2) ? ';' : ',');
  std::string other;
  for (const char c : text) {
    other += form == Form::csv && c == ',' ? separator : c;
    if (form == Form::csv || c != '\n' || !random.oneIn(6)) continue;
    other += std::string(random.oneIn(3), ' ') + '#' + (random.oneIn(2) ? separator : ' ');
    other += random.oneIn(3) ? "\"not closed" : random.oneIn(2) ? "\"a\", b" : "";
    other += random.oneIn(4) ? "\r\n" : "\n";
  }
  return other;
}

}  // namespace

TEST_CASE("a stream gives the same wherever its blocks end") {
  std::map<std::string, int> visited;
  for (std::size_t trial = 0; trial < trials(1500); ++trial) {
    RandomText random(trial);
    const Form form = random.oneIn(2) ? Form::json : random.oneOf(kForms);
    std::string input = inputOf(form, random, 1 + random.below(40), random.oneIn(3) ? 0 : 2 + random.below(20));
    StreamHow how{.from = form, .keepGoing = random.oneIn(2)};
    if (!random.oneIn(3)) how.to = random.oneOf(kOutputs);
    const bool hasNumbersOnly = how.to == OutputForm::text || how.to == OutputForm::f64;
    how.visibleOnly = form == Form::json && !hasNumbersOnly && random.oneIn(2);
    const bool isOther = (form == Form::csv || form == Form::text) && random.oneIn(2);
    if (isOther) input = inOtherFormat(input, form, random, how);
    if (!isBinary(form) && random.oneIn(3)) random.mutate(input);
    const StreamRun expected = runStream(input, how);
    ++visited[expected.status == 0 ? "good" : how.keepGoing ? "went on" : "ended"];
    ++visited["form " + std::to_string(static_cast<int>(form))];
    visited["other separators"] += isOther;
    for (int i = 0; i < 3; ++i) {
      StreamHow other = how;
      other.block = random.oneIn(2) ? 1 + random.below(50) : 1 + random.below(input.size() + 2);
      if (isBinary(form)) other.block += 24;
      other.jobs = static_cast<unsigned>(1 + random.below(3));
      if (random.oneIn(4)) {
        other.largestPiece = 1 + random.below(200);
        other.seed = trial;
      }
      INFO("trial " << trial);
      requireSame(input, how, other, expected);
    }
  }
  for (const char* kind :
       {"good", "went on", "ended", "form 0", "form 1", "form 2", "form 3", "form 4", "other separators"}) {
    INFO(kind);
    CHECK(visited[kind] > 50);
  }
}

TEST_CASE("megabytes give the same through every form, number of jobs, file or pipe") {
  std::map<std::string, int> visited;
  for (const Form form : kForms)
    for (const OutputForm to : kOutputs) {
      const std::size_t combination = static_cast<std::size_t>(form) * 5 + static_cast<std::size_t>(to);
      RandomText random(combination);
      const std::size_t records = form == Form::json ? 15000 : 35000;
      const bool bad = combination % 2 == 1;
      const std::string input = inputOf(form, random, records, bad ? 500 : 0);
      REQUIRE(input.size() > 2 * BlockReader::kBlock);
      for (const bool keepGoing : {false, true}) {
        if (!bad && keepGoing) continue;
        const StreamHow how{.from = form, .to = to, .keepGoing = keepGoing};
        const StreamRun expected = runStream(input, how);
        ++visited[expected.status == 0 ? "good" : keepGoing ? "went on" : "ended"];
        for (const unsigned jobs : {2u, 5u}) {
          StreamHow other = how;
          other.jobs = jobs;
          requireSame(input, how, other, expected);
          other.largestPiece = 70000;
          other.seed = jobs;
          requireSame(input, how, other, expected);
        }
      }
    }
  for (const char* kind : {"good", "went on", "ended"}) {
    INFO(kind);
    CHECK(visited[kind] > 4);
  }
}

TEST_CASE("the form is told alike however the input arrives") {
  for (std::size_t trial = 0; trial < trials(300); ++trial) {
    RandomText random(trial);
    std::string input = inputOf(random.oneOf(kForms), random, 1 + random.below(30), 20);
    if (random.oneIn(4)) random.mutate(input);
    const StreamRun expected = runStream(input, {});
    INFO("trial " << trial);
    requireSame(input, {}, {.block = 1 + random.below(9)}, expected);
    requireSame(input, {}, {.largestPiece = 1 + random.below(30), .seed = trial}, expected);
  }
}

TEST_CASE("the first JSON record names the columns of CSV, whichever of many workers is the first to end") {
  // A record of megabytes, and behind it short ones with other fields: those are read before the first is.
  std::string input = R"([{"first":")" + std::string(2 << 20, 'a') +
                      R"(","x":1,"y":2,"z":3},)"
                      "\n";
  for (int i = 0; i < 2000; ++i) input += R"({"x":1,"y":2,"z":3,"second":)" + std::to_string(i) + "},\n";
  input += R"({"x":1,"y":2,"z":3}])"
           "\n";
  const StreamHow one{.from = Form::json, .to = OutputForm::csv, .keepGoing = true};
  const StreamRun expected = runStream(input, one);
  CHECK(expected.out.starts_with("first,x,y,z,"));
  for (const std::size_t block : {std::size_t{2000}, BlockReader::kBlock}) {
    StreamHow many = one;
    many.jobs = 5;
    many.block = block;
    for (int i = 0; i < 5; ++i) CHECK(runStream(input, many) == expected);
  }
}
