// The cases of a public suite of JSON, y_ valid, n_ not and i_ left open: readers call valid what nlohmann-json does,
// but for a NUL, which it takes for the end of the text.
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
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

constexpr const char* kFirst = "{\"position\":[1,2,3],\"sum\":6,\"twice\":[2,4,6]}\n";
constexpr const char* kThird = "{\"position\":[4,5,6],\"sum\":15,\"twice\":[8,10,12]}\n";

bool has(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("in a record of a stream is valid what nlohmann-json calls valid, and other records are as they are") {
  int accepted = 0, rejected = 0;
  for (const Case& one : allCases())
    for (const std::size_t block : {BlockReader::kBlock, std::size_t(7)}) {
      const std::string record = "{\"x\":1,\"y\":2,\"z\":3,\"v\":" + one.bytes + "}";
      if (block < record.size() / 1000) continue;
      const std::string text = "[1,2,3]\n" + record + "\n[4,5,6]\n";
      const StreamRun all = runStream(text, {.from = Form::json, .keepGoing = true, .jobs = 2, .block = block});
      const StreamRun ended = runStream(text, {.from = Form::json, .jobs = 2, .block = block});
      INFO(one.name << ", block " << block << "\n" << all.out.substr(0, 300) << all.err.substr(0, 300));
      CHECK((all.out.starts_with(kFirst) && all.out.ends_with(kThird)));
      if (isValid(record)) {
        ++accepted;
        std::string line = record.substr(0, record.size() - 1);
        std::erase(line, '\n');
        std::erase(line, '\r');
        line.erase(line.find_last_not_of(" \t") + 1);  // blanks before the brace
        CHECK(all.out == kFirst + line + ",\"sum\":6,\"twice\":[2,4,6]}\n" + kThird);
        CHECK((all.status == 0 && all.err.empty() && ended == all));
        continue;
      }
      ++rejected;
      CHECK((all.status == 1 && ended.status == 1 && ended.out.starts_with(kFirst)));
      CHECK(std::count(ended.err.begin(), ended.err.end(), '\n') == 0);
      // A line break in it leaves open on which line it is found.
      if (!has(one.bytes, "\n"))
        CHECK((ended.err.starts_with("<stdin>:2:") && has(all.out, "{\"line\":2,\"error\":\"")));
      for (std::size_t at = 0; at < all.out.size(); at = all.out.find('\n', at) + 1)
        CHECK(nlohmann::json::accept(all.out.substr(at, all.out.find('\n', at) - at)));
    }
  CHECK(accepted >= 2 * 46);
  CHECK(rejected >= 2 * 153);
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
  CHECK(accepted >= 2 * 43);
  CHECK(commented == std::set<std::string>{"n_object_trailing_comment", "n_object_trailing_comment_slash_open",
                                           "n_structure_object_with_comment"});
  CHECK(rejected >= 2 * 149);
}
