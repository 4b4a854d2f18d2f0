// A bad record costs itself and no other. Good records whose x is their number are broken here and there, and what must
// come out is known from how the input was made.
#include <map>
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "stream/random_text.hpp"
#include "stream/run.hpp"

using namespace viewproj::cmd;
using namespace viewproj::tests;

namespace {

enum class Arrangement { lines, together, arrayOfLines, arrayOnOneLine, document };

struct Broken {
  std::string text;
  std::vector<int> good;                 ///< numbers of the records that must come out
  std::vector<std::size_t> lines;        ///< where something is wrong
  std::map<std::string, int> mutations;  ///< what was done
};

std::string record(RandomText& random, int number) {
  const std::string x = std::to_string(number);
  switch (random.below(5)) {
    case 0:
      return "{\"x\":" + x + ",\"y\":2,\"z\":3}";
    case 1:
      return "{\"id\":\"a]}[{\\\"\",\"position\":[" + x + ",1,2]}";
    case 2:
      return "{\"position\":[" + x + ",1,2],\"more\":{\"a\":[[1],[2]]}}";
    default:
      return "[" + x + ",2, 3]";
  }
}

/// Brackets and strings are closed.
// clang-format off
constexpr const char* kBalanced[] = {
    "[NaN,0,0]", "[+1,2,3]", "[.5,1,2]", "[1 2,3]", "[null,1,2]", "[null,[1,2,3]]", "[true]", "[1,[2,3,4],5]",
    "[1,2,\"a]b\"]", "{\"x\":1 \"y\":2,\"z\":3}", "{\"x\":1,,\"y\":2}", "{\"x\":[[1,2,3],[4,5,6]],nul}",
    "[1e400,2,3]", "[1,2,3\\]", "[1,\xFF,3]"};
/// They are not.
constexpr const char* kUnbalanced[] = {
    "[1,2,", "[1,2,3", "[1,2,\"ab", "{\"x\":1,\"y\":2", "{\"x\":1,\"y\":2,", "{\"x", "{\"x\":1,\"s\":\"abc",
    "{\"x\":1,\"s\":\"abc\\", "{\"id\":1,\"position\":[1,2", "{\"a\":{\"b\":{", "{\"position\":[1,2}",
    "[1,2,3}x", "{]", "{\"x\":", "{\"x\":1,\"y\":", "{\"id\":1,\"position\":[[", "{\"a\":[{\"b\":"};
constexpr const char* kJunk[] = {
    "x", "NaN", "nul y", "+", "\"a,]b\"", "1 2", ":", "-"};
// clang-format on

/// Cut before an array that does not close in an object: in a document, whose end closes both, records could be its
/// items.
std::string withoutOpenArray(const std::string& text) {
  const bool isOpen = std::count(text.begin(), text.end(), '[') > std::count(text.begin(), text.end(), ']');
  return text[0] == '{' && isOpen ? text.substr(0, text.find('[')) : text;
}

Broken make(RandomText& random, Arrangement arrangement) {
  const bool array = arrangement == Arrangement::arrayOfLines || arrangement == Arrangement::arrayOnOneLine ||
                     arrangement == Arrangement::document;
  const bool lines = arrangement != Arrangement::together && arrangement != Arrangement::arrayOnOneLine;
  const std::size_t indentation = arrangement == Arrangement::lines ? 0 : random.below(3);
  Broken made;
  std::size_t line = 1;
  const auto put = [&](const std::string& text) {
    made.text += text;
    line += static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  };
  if (arrangement == Arrangement::document) put("{\"points\":");
  if (array) put(lines ? "[\n" : "[");
  const int count = 2 + static_cast<int>(random.below(30));
  const std::size_t rarity = 2 + random.below(8);
  for (int i = 0; i < count; ++i) {
    if (lines) put(std::string(indentation, ' '));
    const bool last = i + 1 == count;
    std::string comma = array && !last ? "," : "";
    // The first and the last of an array say what it is.
    const bool bad = random.oneIn(rarity) && !(array && (i == 0 || last));
    if (!bad) {
      made.good.push_back(i);
      put(record(random, i));
    } else {
      const bool behindBroken = !made.lines.empty() && made.lines.back() + 1 >= line;
      made.lines.push_back(line);
      const std::size_t kind = random.below(lines ? 6 : 3);
      if (kind == 0) {
        put(random.oneOf(kBalanced));
        ++made.mutations["balanced"];
      } else if (kind == 1) {
        put(behindBroken ? "x" : random.oneOf(kJunk));  // a string might be a name
        ++made.mutations["junk"];
      } else if (kind == 2 && array) {
        made.good.push_back(i);
        put(record(random, i));
        comma.clear();
        ++made.mutations["comma missing"];
      } else if (kind == 3 && !behindBroken) {  // else it might close what is open
        made.good.push_back(i);
        put(record(random, i) + (random.oneIn(2) ? "]" : "}"));
        if (array) comma = ",";
        ++made.mutations["bracket too many"];
      } else if (kind == 4) {
        const std::string whole = record(random, 4713);
        std::string part = whole.substr(0, 2 + random.below(whole.size() - 2));  // `[` alone on a line begins an array
        if (arrangement == Arrangement::document) part = withoutOpenArray(part);
        put(part);
        if (random.oneIn(2)) comma.clear();
        ++made.mutations["cut off"];
      } else {
        std::string text = lines ? random.oneOf(kUnbalanced) : random.oneOf(kBalanced);
        if (arrangement == Arrangement::document) text = withoutOpenArray(text);
        put(text);
        if (random.oneIn(2)) comma.clear();
        ++made.mutations["not closed"];
      }
    }
    put(comma + (lines ? "\n" : random.oneIn(2) ? " " : ""));
  }
  if (array) put(arrangement == Arrangement::document ? "]}\n" : "]\n");
  return made;
}

std::vector<int> numbersOf(const std::string& out) {
  std::vector<int> numbers;
  for (const nlohmann::json& one : nlohmann::json::parse(out))
    if (!one.contains("error"))
      numbers.push_back(one.contains("x") ? one["x"].get<int>() : one["position"][0].get<int>());
  return numbers;
}

/// The lines that messages name.
std::vector<std::size_t> linesNamed(const std::string& err) {
  constexpr std::string_view kPlace = "<stdin>:";
  std::vector<std::size_t> lines;
  for (std::size_t at = err.find(kPlace); at != std::string::npos; at = err.find(kPlace, at + 1))
    lines.push_back(std::stoul(err.substr(at + kPlace.size())));
  return lines;
}

}  // namespace

TEST_CASE("every good record comes out once, in order, whatever is broken around it") {
  std::map<std::string, int> visited;
  for (std::size_t trial = 0; trial < 1500; ++trial) {
    RandomText random(trial);
    const auto arrangement = static_cast<Arrangement>(random.below(5));
    const Broken made = make(random, arrangement);
    for (const auto& [mutation, times] : made.mutations) visited[mutation] += times;
    const StreamHow how{.from = Form::json, .to = OutputForm::array, .keepGoing = true};
    const StreamRun all = runStream(made.text, how);
    INFO("trial " << trial << "\n" << made.text << "\n" << all.out << all.err);
    REQUIRE(nlohmann::json::accept(all.out));
    REQUIRE(numbersOf(all.out) == made.good);
    const std::vector<std::size_t> named = linesNamed(all.err);
    CHECK(all.status == (made.lines.empty() ? 0 : 1));
    for (const std::size_t line : named)
      CHECK(std::any_of(made.lines.begin(), made.lines.end(),
                        [&](std::size_t bad) { return line >= bad && line <= bad + 1; }));
    // What directly follows may be taken for the rest of what is not closed.
    for (std::size_t i = 0; i < made.lines.size(); ++i) {
      const std::size_t line = made.lines[i];
      const bool mayBeRest = i > 0 && made.lines[i - 1] + 1 == line;
      CHECK((mayBeRest ||
             std::any_of(named.begin(), named.end(), [&](std::size_t one) { return one >= line && one <= line + 1; })));
    }
    for (unsigned jobs = 1; jobs <= 4; ++jobs) {
      StreamHow other = how;
      other.jobs = jobs;
      other.block = 1 + random.below(jobs % 2 == 0 ? 40 : 400);
      CHECK(runStream(made.text, other) == all);
    }
    // A carriage return ends a line as well.
    std::string returns = made.text;
    std::replace(returns.begin(), returns.end(), '\n', '\r');
    CHECK(numbersOf(runStream(returns, how).out) == made.good);
    // Without it the first one ends the run, and the array is closed.
    const StreamRun first = runStream(made.text, {.from = Form::json, .to = OutputForm::array, .block = 64});
    CHECK(first.status == all.status);
    REQUIRE(nlohmann::json::accept(first.out));
    const std::vector<int> before = numbersOf(first.out);
    CHECK(std::equal(before.begin(), before.end(), made.good.begin()));
    if (first.status != 0) CHECK("viewproj: " + first.err == all.err.substr(0, all.err.find('\n')));
    ++visited["arrangement " + std::to_string(static_cast<int>(arrangement))];
  }
  for (const char* kind : {"balanced", "junk", "comma missing", "bracket too many", "cut off", "not closed",
                           "arrangement 0", "arrangement 1", "arrangement 2", "arrangement 3", "arrangement 4"}) {
    INFO(kind);
    CHECK(visited[kind] > 100);
  }
}

TEST_CASE("a record that is cut off where a value is to come costs no other on a line of its own") {
  for (const char* cut : {"{\"x\":", "{\"id\":1,\"position\":[1,2,", "{\"id\":1,\"position\":[["}) {
    const StreamRun run = runStream(std::string(cut) + "\n[1,2,3]\n[4,5,6]\n", {.from = Form::json, .keepGoing = true});
    CHECK(run.out.starts_with("{\"line\":1,"));
    CHECK(
        run.out.ends_with("}\n{\"position\":[1,2,3],\"sum\":6,\"twice\":[2,4,6]}\n"
                          "{\"position\":[4,5,6],\"sum\":15,\"twice\":[8,10,12]}\n"));
  }
}

TEST_CASE("an array keeps its place among records, whatever it lacks") {
  const struct {
    const char* input;
    const char* counts;  ///< of what stands there: ( and ) arrays, g good ones, b bad ones
  } cases[] = {
      {"[[1,2,3],NaN,[4,2,3]]\n[5,2,3]\n", "(gbg)g"},
      {"[[1,2,3]\n [4,2,3]]\n[5,2,3]\n", "(gbg)g"},
      {"[[1,2,3]\n[[4,2,3]]\n[5,2,3]\n", "(gb)(g)g"},
      {"[\n[1,2,3],\n[4,2,3]\n[\n[5,2,3]]\n", "(ggb)(g)"},
      {"[[1,2,3],[4,2\n[[5,2,3]]\n", "(gbb)(g)"},
      {"[[1,2,3],\n", "(gb)"},
      {"[null,[1,2,3]]\n[4,2,3]\n", "bg"},
      {"[[1,2,3],,[4,2,3],]\n", "(gbgb)"},
      {"{\"points\":[[1,2,3]\n{\"points\":[[4,2,3]]}\n", "(gb)(g)"},
      {"{\"points\":[[1,2,3]],\"a\":}\n[4,2,3]\n", "(gb)g"},
      {"[\n{\"x\":1,\n]\n[4,2,3]\n", "(b)g"},
  };
  for (const auto& one : cases)
    for (const std::size_t block : {BlockReader::kBlock, std::size_t{1}, std::size_t{7}}) {
      const StreamRun run = runStream(one.input, {.from = Form::json, .keepGoing = true, .block = block});
      INFO(one.input << run.out << run.err);
      std::string found;
      for (std::size_t at = 0; at < run.out.size(); at = run.out.find('\n', at) + 1) {
        const std::string line = run.out.substr(at, run.out.find('\n', at) - at);
        if (line.ends_with("[")) found += '(';
        if (line.starts_with("]")) found += ')';
        if (line.starts_with("{\"line\":")) found += 'b';
        if (line.starts_with("{\"position\":")) found += 'g';
      }
      CHECK(found == one.counts);
    }
}
