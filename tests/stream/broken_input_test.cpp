// Input that is cut off, garbage, too long or odd: one message with its place, what came before is written, and with
// --keep-going what comes after it too.
#include <algorithm>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "stream/random_text.hpp"
#include "stream/run.hpp"

using namespace viewproj;
using namespace viewproj::cmd;
using namespace viewproj::tests;

namespace {

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

std::string doubles(std::initializer_list<double> numbers) {
  std::string bytes;
  for (const double number : numbers) {
    char of[sizeof number];
    std::memcpy(of, &number, sizeof number);
    bytes.append(of, sizeof number);
  }
  return bytes;
}

std::vector<double> numbersOf(const std::string& bytes) {
  std::vector<double> numbers(bytes.size() / sizeof(double));
  std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(double));
  return numbers;
}

/// One message, or none.
void checkMessage(const StreamRun& run) {
  CHECK((run.status == 0 || run.status == 1));
  if (run.status == 0) {
    CHECK(run.err.empty());
  } else {
    CHECK(run.err.starts_with("<stdin>:"));
    CHECK(run.err.find('\n') == std::string::npos);
  }
}

}  // namespace

TEST_CASE("an input cut off at any byte gives what is whole before it") {
  struct Input {
    Form form;
    std::string whole;
    std::size_t mayRead;  ///< cuts that leave something good
  };
  const Input inputs[] = {
      {Form::json, "[1,2,3]\n{\"x\":4,\"y\":5,\"z\":6,\"s\":\"\\u00e9\"}\n  [7,8,9] [1,1,1]\n", 0},
      {Form::json, "[{\"x\":1,\"y\":2,\"z\":3},\n[4,5,6],[7,8,9]]\n", 0},
      {Form::json, "{\"points\":[[1,2,3],\n[4,5,6]],\"more\":{\"a\":1}}\n", 0},
      {Form::csv, "x,y,z,name\r\n1,2,3,a\r\n4,5,6,\"b\r\n\"\"c\"\r\n\r\n7,8,9,d\r\n", 0},
      {Form::text, "1 2 3\n4 5 6\r\n7 8 9\n", 0},
      {Form::f64, doubles({1, 2, 3, 4, 5, 6, 7, 8, 9}), 0},
  };
  for (const Input& input : inputs)
    for (const std::size_t block : {BlockReader::kBlock, std::size_t{24}}) {
      const StreamHow how{.from = input.form, .block = block};
      const StreamRun full = runStream(input.whole, how);
      REQUIRE(full.status == 0);
      std::size_t failed = 0;
      for (std::size_t size = 0; size < input.whole.size(); ++size) {
        const StreamRun run = runStream(input.whole.substr(0, size), how);
        INFO("form " << static_cast<int>(input.form) << ", " << size << " bytes: " << input.whole.substr(0, size)
                     << "\nout " << run.out << "\nerr " << run.err);
        checkMessage(run);
        failed += run.status == 1;
        if (input.form == Form::f64) {
          CHECK(run.out == full.out.substr(0, size / 24 * 32));
          CHECK(run.status == (size % 24 == 0 ? 0 : 1));
          continue;
        }
        // The last record may have lost a digit or a field; an array or a document is closed.
        const std::vector<std::string> all = linesOf(full.out);
        std::vector<std::string> lines = linesOf(run.out);
        if (!run.out.empty()) CHECK(run.out.back() == '\n');
        const bool array = input.form == Form::json && input.whole.find("[1,2,3]\n") != 0;
        if (array && size > 11) CHECK(nlohmann::json::accept(run.out));
        for (std::size_t i = 0; i + (array ? 2 : 1) < lines.size(); ++i) CHECK(lines[i] == all[i]);
      }
      CHECK(failed > (input.form == Form::text ? 5 : 15));
    }
}

TEST_CASE("garbage in any form gives one message, and keep-going comes to its end") {
  for (std::uint64_t trial = 0; trial < 200; ++trial) {
    RandomText random(trial);
    std::string garbage;
    for (std::size_t i = 0; i < 3000; ++i) garbage += static_cast<char>(random.below(256));
    for (const Form form : {Form::json, Form::csv, Form::text}) {
      // A bracket would open an array, whose end is its own matter.
      if (form == Form::json) std::erase(garbage, '[');
      INFO("trial " << trial << ", form " << static_cast<int>(form));
      const StreamRun run = runStream(garbage, {.from = form, .block = 100});
      checkMessage(run);
      CHECK((run.status == 1 && run.out.empty()));
      const StreamRun all = runStream(garbage + "\n[1,2,3]\n", {.from = form, .keepGoing = true, .block = 100});
      CHECK(all.status == 1);
      if (form == Form::json) CHECK(all.out.ends_with("{\"position\":[1,2,3],\"sum\":6,\"twice\":[2,4,6]}\n"));
    }
  }
}

TEST_CASE("lines of megabytes are read, or refused at their place") {
  const std::string name(3 << 20, 'a'), blanks(3 << 20, ' '), breaks(3 << 20, '\n');
  std::string columns = "x,y,z", fields = "\"x\":1,\"y\":2,\"z\":3", numbers = "1,2,3";
  for (int i = 0; i < 100000; ++i) {
    columns += ",c" + std::to_string(i);
    fields += ",\"f" + std::to_string(i) + "\":" + std::to_string(i);
    numbers += ",4";
  }
  const auto status = [](const std::string& input, Form form, std::optional<OutputForm> to = std::nullopt) {
    const StreamRun run = runStream(input, {.from = form, .to = to, .jobs = 2});
    checkMessage(run);
    return run.status;
  };
  CHECK(status("[1,2,3]\n{\"x\":1,\"y\":2,\"z\":3,\"s\":\"" + name + "\"}\n[1,2,3]\n", Form::json) == 0);
  CHECK(status("[1," + blanks + "2,3]\n", Form::json) == 0);
  CHECK(status("[1," + breaks + "2,3]" + breaks + "[1,2,3]", Form::json) == 0);
  CHECK(status("{\"points\"" + breaks + ":[[1,2,3]]" + breaks + "}", Form::json) == 0);
  CHECK(status(breaks + blanks + "[1,2,3]", Form::json) == 0);
  CHECK(status("{" + fields + "}\n{" + fields + "}\n", Form::json) == 0);
  CHECK(status("{" + fields + "}\n{" + fields + "}\n", Form::json, OutputForm::csv) == 0);
  CHECK(status("{" + fields + ",\"f99999\":1}\n", Form::json) == 1);
  CHECK(status("[" + numbers + "]\n", Form::json) == 1);
  CHECK(status(name, Form::json) == 1);
  CHECK(status("[" + name, Form::json) == 1);
  CHECK(status("[[1,2,3],\"" + name, Form::json) == 1);
  CHECK(status(columns + "\n" + numbers + "\n", Form::csv) == 0);
  CHECK(status("x,y,z,n\n1,2,3," + name + "\n1,2,3,\"" + breaks + "\"\n", Form::csv) == 0);
  CHECK(status("x,y,z,n\n1,2,3,\"" + name + "\n", Form::csv) == 1);
  CHECK(status("x,y,z\n" + breaks + "1,2,3\n", Form::csv) == 0);
  CHECK(status(name, Form::csv) == 1);
  CHECK(status("1" + blanks + "2 3\n" + breaks + "1 2 3", Form::text) == 0);
  CHECK(status(name, Form::text) == 1);
}

TEST_CASE("a record that is longer than what is held is refused at its place") {
  const std::string big(65 << 20, '1');
  const StreamRun run = runStream("[1,2,3]\n[1,2," + big + "]\n", {.from = Form::json});
  CHECK(run.status == 1);
  CHECK(run.err == "<stdin>:2:1: a record longer than 64 MiB");
  CHECK(run.out == "{\"position\":[1,2,3],\"sum\":6,\"twice\":[2,4,6]}\n");
}

TEST_CASE("a record that is longer than what is held costs itself and no other") {
  const std::string big(65 << 20, '1'), row = "1,2,3\n";
  const auto rest = [](const StreamRun& run) {
    CHECK(run.status == 1);
    CHECK(run.err.find("a record longer than 64 MiB") != std::string::npos);
    CHECK(linesOf(run.err).size() == 1);
    return linesOf(run.out).size();
  };
  CHECK(rest(runStream("[1,2,3]\n{\"a\":[[1," + big + ",\"]\"]]}\n[1,2,3]\n[1,2,3]\n",
                       {.from = Form::json, .keepGoing = true})) == 4);
  CHECK(rest(runStream("[\n{\"a\":\"" + big + "\"},\n[1,2,3]]\n[1,2,3]\n", {.from = Form::json, .keepGoing = true})) ==
        5);
  CHECK(rest(runStream("x,y,z\n1,2," + big + "\n" + row + row, {.from = Form::csv, .keepGoing = true})) == 4);
  CHECK(rest(runStream("1 2 3\n1 2 " + big + "\n1 2 3\n", {.from = Form::text, .keepGoing = true})) == 3);
}

TEST_CASE("a bad row of CSV stands with its message in a table that stays one") {
  const std::string rows[] = {
      "1,2",         "1,2,3,a,b",  "1,,3,a",        "1,x,3,a",
      "1,2,1e999,a", "1,2,\"\",a", "\"1\n\",2,3,a", "1,2,,\"b,\n\"\"c\"\"\"",
      "4713,2,3,a",  "0x1,2,3,a",  "1,2,NaN,a",     "1,2,inf,a",
      "1 1,2,3,a",
  };
  for (const std::string& row : rows)
    for (const char* const ending : {"\n", "\r\n"}) {
      const std::string input = std::string("\xEF\xBB\xBFx,y,z,name") + ending + "1,2,3,\"p\"\"q\"" + ending + row +
                                ending + "4,5,6,r" + ending;
      INFO(input);
      const StreamRun ended = runStream(input, {.from = Form::csv});
      checkMessage(ended);
      CHECK(ended.status == 1);
      CHECK(ended.err.starts_with("<stdin>:3:"));
      CHECK(linesOf(ended.err).size() == 1);
      const std::string head = "x,y,z,name,sum,twice_x,twice_y,twice_z";
      CHECK(ended.out == head + "\n1,2,3,\"p\"\"q\",6,2,4,6\n");
      const StreamRun all = runStream(input, {.from = Form::csv, .keepGoing = true});
      CHECK(all.status == 1);
      CHECK(all.out.starts_with(head + ",error\n1,2,3,\"p\"\"q\",6,2,4,6,\n"));
      CHECK(all.out.ends_with("\n4,5,6,r,15,8,10,12,\n"));
      // What came out is read again: as many fields in every row, but for those that were too many, at its end.
      const StreamRun again = runStream(all.out, {.from = Form::csv, .to = OutputForm::text, .keepGoing = true});
      CHECK((again.err.find("expected 9 as") == std::string::npos) == (row != "1,2,3,a,b"));
      const StreamRun asJson = runStream(input, {.from = Form::csv, .to = OutputForm::array, .keepGoing = true});
      CHECK(nlohmann::json::parse(asJson.out).size() == 3);
      CHECK(nlohmann::json::parse(asJson.out)[1]["line"] == 3);
    }
}

TEST_CASE("what is no number in f64 is named by record and byte, and NaN stands for it") {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const std::string input = doubles({1, 2, 3, 1, nan, 3, 4, 5, 6, 1, 2, -inf, 7, 8, 9});
  const StreamRun ended = runStream(input, {.from = Form::f64});
  CHECK((ended.status == 1 && ended.err == "<stdin>:2:9: NaN is not a finite number"));
  CHECK(numbersOf(ended.out) == std::vector<double>{6, 2, 4, 6});
  const StreamRun all = runStream(input + "1234567", {.from = Form::f64, .keepGoing = true});
  CHECK(all.status == 1);
  CHECK(all.err ==
        "viewproj: <stdin>:2:9: NaN is not a finite number\nviewproj: <stdin>:4:17: infinity is not a finite number\n"
        "viewproj: <stdin>:6:1: has 7 bytes; expected 3 doubles, 24 bytes; --width N tells how many\n");
  const std::vector<double> numbers = numbersOf(all.out);
  REQUIRE(numbers.size() == 24);
  for (const std::size_t bad : {1u, 3u, 5u})
    for (std::size_t i = 4 * bad; i < 4 * bad + 4; ++i) CHECK(std::isnan(numbers[i]));
  CHECK(numbers[8] == 15);
  CHECK(numbers[16] == 24);
}

TEST_CASE("columns of CSV are those of the first good record, however many bad ones come before") {
  std::string input =
      "[NaN]\n{\"position\":[1,2,3],\"position_x\":5}\n{\"x\":1,\"y\":2,\"z\":3,\"sum\":9}\n[4713,0,0]\n";
  std::string bad;
  for (int i = 0; i < 30000; ++i) bad += "[" + std::to_string(i) + ",2]\n";
  for (const std::string& first : {input, input + bad}) {
    const auto lines = static_cast<std::size_t>(std::count(first.begin(), first.end(), '\n'));
    for (const unsigned jobs : {1u, 3u}) {
      const StreamRun run = runStream(first + "[4,5,6]\n[7,8]\n",
                                      {.from = Form::json, .to = OutputForm::csv, .keepGoing = true, .jobs = jobs});
      // Those before it have no columns: standard error alone tells them.
      CHECK(run.out ==
            "position_x,position_y,position_z,sum,twice_x,twice_y,twice_z,error\n4,5,6,15,8,10,12,\n,,,,,,,line " +
                std::to_string(lines + 2) + ": has 2 numbers; expected x y z or x y z w\n");
      CHECK(linesOf(run.err).size() == lines + 1);
    }
  }
}

TEST_CASE("a record that says itself what is wrong with it passes through, and is no new error") {
  const auto keepGoing = [](const std::string& input, std::optional<OutputForm> to = std::nullopt,
                            const char* prefix = "") {
    const StreamRun run = runStream(input, {.to = to, .keepGoing = true, .prefix = prefix});
    return std::to_string(run.status) + run.out + run.err;
  };
  // Its own field, once.
  CHECK(keepGoing("x,y,z,error\n1,2,3,\n,,,\"odd, \"\"so\"\"\"\n1,2,x,\n") ==
        "1x,y,z,error,sum,twice_x,twice_y,twice_z\n1,2,3,,6,2,4,6\n,,,\"odd, \"\"so\"\"\",,,,\n"
        "1,2,x,z: 'x' is not a finite number,,,,\nviewproj: <stdin>:4:5: z: 'x' is not a finite number\n");
  CHECK(keepGoing("error,x,y,z\nodd,,,\n", std::nullopt, "p.") ==
        "0error,x,y,z,p.sum,p.twice_x,p.twice_y,p.twice_z,p.error\nodd,,,,,,,,\n");
  const std::string json = "[1,2,3]\n{\"line\":7,\"error\":\"odd\"}\n{\"x\":1,\"y\":2,\"z\":3,\"error\":\"\"}\n";
  CHECK(keepGoing(json) ==
        "0{\"position\":[1,2,3],\"sum\":6,\"twice\":[2,4,6]}\n{\"line\":7,\"error\":\"odd\"}\n"
        "{\"x\":1,\"y\":2,\"z\":3,\"error\":\"\",\"sum\":6,\"twice\":[2,4,6]}\n");
  CHECK(keepGoing("[1,2,3]\n{\"line\":7,\"error\":\"odd\"}\n", OutputForm::csv) ==
        "0position_x,position_y,position_z,sum,twice_x,twice_y,twice_z,error\n1,2,3,6,2,4,6,\n,,,,,,,line 2: odd\n");
  CHECK(keepGoing("[1,2,3]\n{\"line\":7,\"error\":\"odd\"}\n", OutputForm::text) == "06 2 4 6\nNaN NaN NaN NaN\n");
  // Without --keep-going it is as bad as any other.
  CHECK(runStream("x,y,z,error\n,,,odd\n", {}).status == 1);
}

TEST_CASE("binary records have the width that is told") {
  const auto floats = [](std::initializer_list<float> numbers) {
    std::string bytes;
    for (const float number : numbers) {
      char of[sizeof number];
      std::memcpy(of, &number, sizeof number);
      bytes.append(of, sizeof number);
    }
    return bytes;
  };
  const std::string points = floats({0.1f, 2, 3, 9, 4, 5, 6, 9});
  StreamHow how{.from = Form::f32, .to = OutputForm::lines, .width = 4, .columns = "1,2,3"};
  CHECK(runStream(points, how).out ==
        "{\"x\":0.1,\"y\":2,\"z\":3,\"column4\":9,\"sum\":5.100000001490116,\"twice\":[0.20000000298023224,4,6]}\n"
        "{\"x\":4,\"y\":5,\"z\":6,\"column4\":9,\"sum\":15,\"twice\":[8,10,12]}\n");
  how.columns = "";
  CHECK(runStream(points, how)
            .err.starts_with("<stdin>:1:1: has 4 numbers; expected x y z; --columns picks three: 1,2,3"));
  how = {.from = Form::f32, .to = OutputForm::text};
  CHECK(runStream(points.substr(0, 12), how).out == runStream(floats({0.1f, 2, 3}), how).out);
  how.width = 2;
  how.columns = "1,2,3";
  CHECK(runStream(points, how).status == 2);
  CHECK(runStream("1 2 3\n", {.from = Form::text, .width = 3}).status == 2);

  const auto npy = [](const std::string& type, const char* order, const std::string& shape, const std::string& data) {
    std::string header = "{'descr': " + type + ", 'fortran_order': " + order + ", 'shape': " + shape + ", }";
    header.resize(118, ' ');
    header.back() = '\n';
    return std::string("\x93NUMPY\x01\x00\x76\x00", 10) + header + data;
  };
  const std::string good = npy("'<f4'", "False", "(2, 4)", points);
  how = {.to = OutputForm::text, .columns = "1,2,3"};
  const StreamRun read = runStream(good, how);
  CHECK(
      (read.status == 0 &&
       read.out == runStream(points, {.from = Form::f32, .to = OutputForm::text, .width = 4, .columns = "1,2,3"}).out));
  for (std::size_t block = 1; block < 60; block += 7) {
    StreamHow small = how;
    small.block = block;
    CHECK(runStream(good, small) == read);
  }
  CHECK(runStream(npy("'<f8'", "False", "(1, 3)", doubles({1, 2, 3})), {}).out == doubles({6, 2, 4, 6}));
  const std::pair<std::string, const char*> wrong[] = {
      {npy("'>f8'", "False", "(1, 3)", doubles({1, 2, 3})), "has numbers of type '>f8'"},
      {npy("'<i4'", "False", "(2, 3)", doubles({1, 2, 3})), "has numbers of type '<i4'"},
      {npy("[('x', '<f4')]", "False", "(2,)", doubles({1, 2, 3})), "has numbers of type "},
      {npy("'<f8'", "True", "(1, 3)", doubles({1, 2, 3})), "is in Fortran order"},
      {npy("'<f8'", "False", "(3,)", doubles({1, 2, 3})), "has 1 dimensions"},
      {npy("'<f8'", "False", "(2, 3)", doubles({1, 2, 3})), "ends 1 rows before"},
      {npy("'<f8'", "False", "(1, 3)", doubles({1, 2, 3, 4})), "has more bytes than"},
      {good.substr(0, 50), "ends inside its .npy header"},
  };
  for (const auto& [input, message] : wrong) {
    const StreamRun run = runStream(input, {});
    INFO(run.err);
    CHECK((run.status == 1 && run.err.find(message) != std::string::npos));
  }
}

TEST_CASE("a point that is null passes on as null where it is so as a whole") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  // The sum of nothing is refused there; what a command writes, transcripts show.
  CHECK(runStream("{\"position\":null}\n", {}).err == "<stdin>:1:1: has no point: it is null");
  CHECK(runStream("x,y,z\n,,\n", {}).err == "<stdin>:2:1: has no point: it is null");
  CHECK(runStream("x,y,z\n1,,\n", {}).err == "<stdin>:2:3: y: '' is not a finite number");
  CHECK(runStream("NaN NaN NaN\n", {}).err == "<stdin>:1:1: has no point: it is null");
  CHECK(runStream("NaN 1 NaN\n", {}).err == "<stdin>:1:1: 'NaN' is not a finite number");
  CHECK(runStream(doubles({nan, nan, nan}), {.from = Form::f64}).err == "<stdin>:1:1: has no point: it is null");
}

TEST_CASE("text after the closing quote is an error of its record, however it is read") {
  const std::string input =
      "name,x,y,z\nl,1,2,3\n\"a,1,2,3\n\"b,1,2,4\n\"c\" ,4,5,6\r\n\"d\"\r\"d\",4,5,6\n\"e\"\"\",7,8,9\n";
  const StreamRun all = runStream(input, {.from = Form::csv, .keepGoing = true});
  INFO(all.out << all.err);
  CHECK(all.err.starts_with("viewproj: <stdin>:3:1: the quote that opens here is not closed"));
  CHECK(linesOf(all.err).size() == 4);
  CHECK(all.out.find("\n\"e\"\"\",7,8,9,24,14,16,18,\n") != std::string::npos);
  // Its row is one still, with its bytes in quotes.
  CHECK(all.out.find("\n\"\"\"c\"\" \",4,5,6,,,,,text after") != std::string::npos);
  CHECK(runStream(all.out, {.from = Form::csv, .keepGoing = true, .prefix = "p."}).status == 0);
  for (const unsigned jobs : {1u, 3u})
    for (std::size_t block = 1; block < 90; ++block)
      CHECK(runStream(input, {.from = Form::csv, .keepGoing = true, .jobs = jobs, .block = block}) == all);
  CHECK(runStream("a,\"b\"c,x,y,z\n1,2,3,4,5\n", {.from = Form::csv}).err.starts_with("<stdin>:1:6: text after"));
}
