// Inputs that are no stream of records as a whole.
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "stream/run.hpp"

using namespace viewproj::cmd;
using namespace viewproj::tests;

namespace {

struct Case {
  const char* name;
  std::string value;
};

/// With NUL bytes, which a literal has too.
template <std::size_t N>
std::string bytes(const char (&literal)[N]) {
  return {literal, N - 1};
}

}  // namespace

TEST_CASE("whole inputs that are no stream of records get one message with its place") {
  const Case kInputs[] = {
      {"1:1: a number", "1"},
      {"1:1: a string", "\"abc\""},
      {"1:1: null", "null\n"},
      {"1:1: a word", "abc\n[1,2,3]"},
      {"1:1: a comma", ",[1,2,3]"},
      {"1:8: a comma between records", "[1,2,3],[4,5,6]\n"},
      {"1:1: a closing bracket", "]"},
      {"1:8: a closing bracket behind a record", "[1,2,3]]"},
      {"1:2: an array that does not end", "["},
      {"1:12: an object that does not end", "{\"x\":1,\"y\":"},
      {"1:9: an array that ends behind a record", "[[1,2,3]"},
      {"1:10: an array that ends behind a comma", "[[1,2,3],"},
      {"1:10: a comma before the end", "[[1,2,3],]"},
      {"2:1: a comma missing", "[[1,2,3]\n[4,5,6]]"},
      {"1:10: a comma missing on the line", "[[1,2,3] [4,5,6]]"},
      {"1:2: an array of commas", "[,]"},
      {"1:2: an array of words", "[abc]"},
      {"1:2: an array of strings that do not end", "[\"abc]"},
      {"1:1: an array that begins with null is one record", "[null,[1,2,3]]"},
      {"1:20: a document that does not end", "{\"points\":[[1,2,3]]"},
      {"1:21: a document with a comma too many", "{\"points\":[[1,2,3]],}"},
      {"1:25: a document with an invalid end", "{\"points\":[[1,2,3]],\"a\":}"},
      {"1:1: an object closed by a bracket", "{]"},
      {"1:1: numbers without brackets", "1,2,3"},
      {"1:1: a NUL", bytes("\0")},
      {"1:1: a word joiner", "\xE2\x81\xA0[1,2,3]"},
      {"1:1: a byte order mark twice", "\xEF\xBB\xBF\xEF\xBB\xBF[1,2,3]"},
      {"1:1: half a byte order mark", "\xEF\xBB[1,2,3]"},
      {"1:1: a comment", "/* */ [1,2,3]"},
      {"1:1: a form feed", "\f[1,2,3]"},
  };
  for (const Case& input : kInputs)
    for (const std::size_t block : {BlockReader::kBlock, std::size_t{3}}) {
      const StreamRun run = runStream(input.value, {.from = Form::json, .block = block});
      INFO(input.name << "\n" << run.out << run.err);
      CHECK(run.status == 1);
      CHECK(run.err.find('\n') == std::string::npos);
      const std::string place(input.name, std::string_view(input.name).find(' '));
      // Two closings are of the same array.
      if (input.value == "{]")
        CHECK(run.err.starts_with("<stdin>:1:"));
      else
        CHECK(run.err.substr(0, run.err.find(' ')) == "<stdin>:" + place);
      if (input.value.starts_with("[[")) CHECK(nlohmann::json::accept(run.out));
    }
  for (const char* nothing : {"", "\n", " \t\r\n\n", "\xEF\xBB\xBF", "\xEF\xBB\xBF\n"}) {
    const StreamRun run = runStream(nothing, {.from = Form::json});
    CHECK((run.status == 0 && run.out.empty() && run.err.empty()));
  }
}
