// The cases of a public suite of JSON, y_ valid, n_ not and i_ left open: readers call valid what nlohmann-json does,
// but for a NUL, which it takes for the end of the text.
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "camera/document.hpp"
#include "catch.hpp"
#include "stream/run.hpp"
#include "text/error.hpp"

using namespace viewproj::cmd;
using namespace viewproj::tests;

namespace {

bool isValid(const std::string& text) { return nlohmann::json::accept(text) && text.find('\0') == std::string::npos; }

struct Case {
  std::string name, bytes;
  bool valid() const { return isValid(bytes); }
};

std::string repeated(std::string_view text, std::size_t count) {
  std::string all;
  while (count-- > 0) all += text;
  return all;
}

std::string unescaped(const std::string& text) {
  std::string bytes;
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] != '\\') {
      bytes += text[i];
    } else if (text[++i] == 'x') {
      bytes += static_cast<char>(std::stoi(text.substr(i + 1, 2), nullptr, 16));
      i += 2;
    } else {
      bytes += text[i];
    }
  return bytes;
}

const std::vector<Case>& allCases() {
  static const std::vector<Case> cases = [] {
    std::vector<Case> all;
    std::ifstream file(VIEWPROJ_JSON_SUITE);
    for (std::string line; std::getline(file, line);) {
      const std::size_t blank = line.find(' ');
      all.push_back({line.substr(0, blank), unescaped(line.substr(blank + 1))});
    }
    all.push_back({"n_structure_100000_opening_arrays", repeated("[", 100000)});
    all.push_back({"n_structure_open_array_object", repeated("[{\"\":", 50000) + "\n"});
    return all;
  }();
  return cases;
}

/// Empty: it was read. A document in a file, as -c takes it.
std::string faultOfFile(const std::string& bytes) {
  const int memory = ::memfd_create("camera", MFD_CLOEXEC);
  REQUIRE(::write(memory, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size()));
  std::string fault;
  try {
    (void)load("/proc/self/fd/" + std::to_string(memory), "--camera");
  } catch (const InputError& e) {
    fault = e.what();
  }
  ::close(memory);
  return fault;
}

bool has(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

std::string recordWith(const std::string& value) { return "{\"x\":1,\"y\":2,\"z\":3,\"v\":" + value + "}"; }

std::size_t linesIn(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

std::string shown(const std::string& text) { return text.substr(0, 300); }

constexpr const char* kFirst = "{\"position\":[1,2,3],\"sum\":6,\"twice\":[2,4,6]}\n";
constexpr const char* kThird = "{\"position\":[4,5,6],\"sum\":15,\"twice\":[8,10,12]}\n";

void checkCase(const Case& one, std::size_t block) {
  const std::string record = recordWith(one.bytes);
  const bool valid = isValid(record);
  INFO(one.name << ", block " << block);
  const std::string three = "[1,2,3]\n" + record + "\n[4,5,6]\n";
  const StreamHow how{.from = Form::json, .jobs = 2, .block = block};
  StreamHow keepGoing = how;
  keepGoing.keepGoing = true;
  const StreamRun alone = runStream(record, how), second = runStream(three, how), all = runStream(three, keepGoing);
  INFO("alone: " << shown(alone.out + alone.err) << "\nsecond: " << shown(second.out + second.err)
                 << "\nkeep going: " << shown(all.out + all.err));
  if (valid) {
    std::string line = record;
    std::erase(line, '\n');
    std::erase(line, '\r');
    line.pop_back();
    line.erase(line.find_last_not_of(" \t") + 1);  // blanks before the brace
    line += ",\"sum\":6,\"twice\":[2,4,6]}\n";
    CHECK(alone.status == 0);
    CHECK((alone.out == line && alone.err.empty()));
    CHECK((second.status == 0 && second.out == kFirst + line + kThird && second.err.empty()));
    CHECK(all == second);
    return;
  }
  CHECK((alone.status == 1 && second.status == 1 && all.status == 1));
  CHECK((linesIn(alone.err) == 0 && linesIn(second.err) == 0));
  CHECK(all.out.starts_with(kFirst));
  CHECK(all.out.ends_with(kThird));
  // A brace of its own ends the record before what is wrong.
  if (one.name != "n_structure_object_followed_by_closing_object") {
    CHECK((alone.out.empty() && second.out == kFirst));
    CHECK(all.out.starts_with(std::string(kFirst) + "{\"line\":"));
    CHECK(linesIn(all.out) == linesIn(all.err) + 2);
  }
  // A bracket too many makes it more than one, and line breaks in it leave open on which line it is found.
  const bool hasBreaks = one.bytes.find('\n') != std::string::npos;
  if (one.bytes.find_first_of("]}") == std::string::npos && !hasBreaks) CHECK(linesIn(all.err) == 1);
  if (!hasBreaks) {
    CHECK(alone.err.starts_with("<stdin>:1:"));
    CHECK(second.err.starts_with("<stdin>:2:"));
    CHECK(all.err.starts_with("viewproj: <stdin>:2:"));
    CHECK(all.out.find("{\"line\":2,\"error\":\"") != std::string::npos);
  }
  for (std::size_t at = 0; at < all.out.size(); at = all.out.find('\n', at) + 1)
    CHECK(nlohmann::json::accept(all.out.substr(at, all.out.find('\n', at) - at)));
}

}  // namespace

TEST_CASE("the suite is there as a whole") {
  std::map<char, int> counts;
  int valid = 0;
  std::set<std::string> disagreed;
  for (const Case& one : allCases()) {
    ++counts[one.name[0]];
    valid += one.valid();
    const bool judged = nlohmann::json::accept(one.bytes);
    if (one.name[0] != 'i') {
      CHECK(one.valid() == (one.name[0] == 'y'));
      if (judged != one.valid()) disagreed.insert(one.name);
    }
  }
  CHECK(counts == std::map<char, int>{{'i', 35}, {'n', 188}, {'y', 95}});
  // The judge itself calls every y_ valid and every n_ not, but for one.
  CHECK(disagreed == std::set<std::string>{"n_multidigit_number_then_00"});
  CHECK(valid >= 95);
}

TEST_CASE("in a record of a stream is valid what nlohmann-json calls valid, and other records are as they are") {
  const std::string good = recordWith("0") + "\n", first = runStream(good, {}).out;
  int accepted = 0, rejected = 0;
  std::set<std::string> onlyAlone;
  for (const Case& one : allCases()) {
    const std::string record = recordWith(one.bytes);
    const bool valid = isValid(record);
    if (valid != one.valid()) onlyAlone.insert(one.name);
    for (const std::size_t block : {BlockReader::kBlock, std::size_t(7)}) {
      if (block < record.size() / 1000) continue;
      checkCase(one, block);
      // There the record's shape is new; here it is known.
      const StreamRun run = runStream(good + record, {.from = Form::json, .block = block});
      INFO(one.name << ", " << run.err);
      CHECK(run.status == (valid ? 0 : 1));
      CHECK(run.err.empty() == valid);
      CHECK(run.out.starts_with(first));
      (valid ? accepted : rejected) += 2;
    }
  }
  CHECK(onlyAlone == std::set<std::string>{"i_structure_UTF-8_BOM_empty_object"});
  CHECK(accepted >= 4 * 95);
  CHECK(rejected >= 4 * 186);
}

TEST_CASE("in a camera file is valid what nlohmann-json calls valid, but for names twice, deep nests and comments") {
  std::set<std::string> twice, deep, commented;
  int accepted = 0, rejected = 0;
  for (const Case& one : allCases())
    for (const bool inside : {false, true}) {
      const std::string text = inside ? "{\"v\":" + one.bytes + "}" : one.bytes;
      const std::string fault = faultOfFile(text);
      INFO(one.name << ", " << fault);
      if (has(fault, "is given twice")) {
        twice.insert(one.name);
      } else if (has(fault, "nested deeper")) {
        deep.insert(one.name);
      } else if (isValid(text)) {
        ++accepted;
        CHECK((fault.empty() || has(fault, "expected a JSON object")));
      } else if (fault.empty()) {
        commented.insert(one.name);
      } else {
        ++rejected;
        CHECK((has(fault, "not valid JSON") || has(fault, "larger than any double") || has(fault, "is empty") ||
               has(fault, "is UTF-16") || has(fault, "is neither JSON")));
      }
    }
  CHECK(twice == std::set<std::string>{"y_object_duplicated_key", "y_object_duplicated_key_and_value"});
  CHECK(deep == std::set<std::string>{"i_structure_500_nested_arrays", "n_structure_100000_opening_arrays",
                                      "n_structure_open_array_object"});
  CHECK(accepted >= 2 * 93);
  CHECK(commented == std::set<std::string>{"n_object_trailing_comment", "n_object_trailing_comment_slash_open",
                                           "n_structure_object_with_comment"});
  CHECK(rejected >= 2 * 183);
}
