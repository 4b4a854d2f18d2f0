// What is a valid record, which numbers are in it and what is said of the rest is what nlohmann-json says alone. A
// camera file of the same text is valid where nlohmann-json says so, too, but for names that are there twice and deep
// nests.
#include <bit>
#include <cctype>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "camera/document.hpp"
#include "catch.hpp"
#include "records/points.hpp"
#include "stream/batch.hpp"
#include "stream/random_text.hpp"
#include "text/error.hpp"

using namespace viewproj;
using namespace viewproj::cmd;
using namespace viewproj::tests;

namespace {

/// VIEWPROJ_JSON_LINES in the environment.
std::size_t linesWanted() {
  const char* wanted = std::getenv("VIEWPROJ_JSON_LINES");
  return wanted ? std::strtoull(wanted, nullptr, 10) : 30000;
}

/// A record that was read, or what was said of one that is bad.
struct Heard {
  std::string text, message;
  std::vector<std::uint64_t> numbers;  ///< their bits
  std::size_t line = 0, column = 0;
  bool operator==(const Heard&) const = default;
};

/// Keeps what it is given.
class Listener final : public RecordSink {
 public:
  Listener() : reader_(makeJsonReader(false)) {}

  const std::vector<Heard>& read(const std::string& text) {
    heard_.clear();
    block_.bytes.clear();
    block_.bytes += text;
    block_.last = true;
    position_.begin(block_, 0);
    reader_->read(block_, *this);
    return heard_;
  }

  Plan plan(const RecordView& record) override { return {findPoint(record, {})}; }
  void take(const RecordView& record, const Plan& plan, const Numbers& numbers) override {
    heard_.push_back({std::string(record.text), "", {}});
    for (std::size_t i = 0; i < plan.numbers.slots(); ++i)
      heard_.back().numbers.push_back(std::bit_cast<std::uint64_t>(numbers[i]));
    if (numbers.isNull) heard_.back().message = "null";
  }
  void bad(std::string_view text, const RecordError& error, std::span<const std::string_view>) override {
    const TextPosition position = position_.positionOf(text.data() + error.offset);
    heard_.push_back({std::string(text), error.what(), {}, position.line, position.column});
  }
  void takeError(const RecordView&, std::size_t) override {}
  void beginArray(std::string_view) override { heard_.push_back({"[", "", {}}); }
  void endArray(std::string_view) override { heard_.push_back({"]", "", {}}); }

 private:
  std::unique_ptr<RecordReader> reader_;
  Block block_;
  PositionCounter position_;
  std::vector<Heard> heard_;
};

/// The names of an object's fields are all different; of all objects in it, or the outermost alone.
bool namesDiffer(const std::string& text, bool everywhere = false) {
  bool differ = true;
  std::vector<std::vector<std::string>> open;
  const auto look = [&](int, nlohmann::json::parse_event_t event, nlohmann::json& parsed) {
    using Event = nlohmann::json::parse_event_t;
    if (event == Event::object_start || event == Event::array_start) open.emplace_back();
    if (event == Event::object_end || event == Event::array_end) open.pop_back();
    if (event == Event::key && (everywhere || open.size() == 1)) {
      const auto name = parsed.get<std::string>();
      differ = differ && std::find(open.back().begin(), open.back().end(), name) == open.back().end();
      open.back().push_back(name);
    }
    return true;
  };
  return !nlohmann::json::parse(text, look, false, true).is_discarded() && differ;
}

/// The same fields with their names in lower case, where no such name is there.
nlohmann::json inLowerCase(const nlohmann::json& value) {
  nlohmann::json lower = value;
  for (const auto& [name, field] : value.items()) {
    std::string key = name;
    std::transform(key.begin(), key.end(), key.begin(), [](unsigned char c) { return std::tolower(c); });
    if (!lower.contains(key)) lower[key] = field;
  }
  return lower;
}

/// What a record holds by nlohmann-json's DOM alone; nothing where it is none that is good.
std::optional<std::vector<std::uint64_t>> byDom(const std::string& text) {
  nlohmann::json value = nlohmann::json::parse(text, nullptr, false);
  if (value.is_discarded()) return std::nullopt;
  std::vector<double> numbers;
  // 2^64 and beyond are doubles there; -0 as an integer is 0, but the text says what it is.
  const auto take = [&](const nlohmann::json& number) {
    if (!number.is_number()) return false;
    numbers.push_back(number.get<double>());
    return true;
  };
  const auto takeAll = [&](const nlohmann::json& array, std::size_t most) {
    if (!array.is_array() || array.size() < 3 || array.size() > most) return false;
    const bool good = std::all_of(array.begin(), array.end(), take);
    numbers.resize(most, std::numeric_limits<double>::quiet_NaN());
    return good;
  };
  if (value.is_array()) {
    if (!takeAll(value, value.size() == 4 ? 4 : 3)) return std::nullopt;
  } else {
    if (!value.is_object() || !namesDiffer(text)) return std::nullopt;
    // A name in two letter cases is there twice.
    const auto isTwice = [asWritten = value](std::string_view name) {
      const std::string lower(name.substr(0, 1)), upper(name.substr(1));
      return asWritten.contains(lower) && asWritten.contains(upper);
    };
    const auto has = [&](std::initializer_list<const char*> names) {
      return std::all_of(names.begin(), names.end(), [&](const char* name) { return value.contains(name); });
    };
    if (!has({"position"}) && !has({"x", "y", "z"}) && !has({"direction"})) value = inLowerCase(value);
    const bool hasXyz = value.contains("x") && value.contains("y") && value.contains("z");
    if (hasXyz && (isTwice("xX") || isTwice("yY") || isTwice("zZ"))) return std::nullopt;
    if (value.contains("position")) {
      if (hasXyz || !takeAll(value["position"], 4)) return std::nullopt;
    } else if (hasXyz) {
      for (const char* name : {"x", "y", "z"})
        if (!take(value[name])) return std::nullopt;
    } else if (!value.contains("direction") || !takeAll(value["direction"], 3)) {
      return std::nullopt;
    }
  }
  std::vector<std::uint64_t> bits;
  for (const double number : numbers) bits.push_back(std::bit_cast<std::uint64_t>(number));
  return bits;
}

constexpr std::uint64_t kMinusZero = 1ull << 63;

/// But for the sign of zero, which nlohmann-json drops from an integer.
bool sameNumbers(std::vector<std::uint64_t> a, std::vector<std::uint64_t> b) {
  for (auto* all : {&a, &b})
    for (std::uint64_t& bits : *all)
      if (bits == kMinusZero) bits = 0;
  return a == b;
}

/// How a camera file is taken: "read", "refused", or for what else than its syntax it is refused.
std::string takenAsFile(const std::string& text) {
  try {
    (void)load(text, "FILE");
    return "read";
  } catch (const InputError& e) {
    for (const char* reason : {"is given twice", "nested deeper"})
      if (std::string_view(e.what()).find(reason) != std::string_view::npos) return reason;
    return "refused";
  }
}

std::string described(const std::vector<Heard>& heard) {
  std::string text;
  for (const Heard& one : heard) {
    text += "\n  " + one.text + " | " + one.message + " " + std::to_string(one.line) + ":" + std::to_string(one.column);
    for (const std::uint64_t bits : one.numbers) text += " " + std::to_string(std::bit_cast<double>(bits));
  }
  return text;
}

}  // namespace

TEST_CASE("mutated lines are judged and read as nlohmann-json does alone") {
  std::map<std::string, std::size_t> accepted, rejected, taken;
  std::size_t several = 0, none = 0;
  Listener listener, again;
  std::vector<Heard> good;  ///< of the lines that are read together
  std::string together;
  const std::size_t lines = linesWanted();
  for (std::size_t trial = 0; trial < lines; ++trial) {
    RandomText random(trial);
    std::string line = random.record(false);
    // Of its schema before, so that it is known.
    if (random.oneIn(2)) (void)listener.read(line);
    std::string kind(random.oneIn(20) ? "as it was" : random.mutate(line));
    if (random.oneIn(5) && kind != "as it was") kind = random.mutate(line);
    INFO("trial " << trial << ", " << kind << ": " << line);
    const std::vector<Heard>& found = listener.read(line);

    // What is one value of JSON is what its DOM says.
    const std::size_t first = line.find_first_not_of(" \t\r\n");
    const bool single = found.size() == 1 && found[0].text != "fault" && found[0].text != "[";
    if (single && found[0].message.empty()) {
      const auto numbers = byDom(line);
      if (!numbers || !sameNumbers(*numbers, found[0].numbers)) FAIL("read, which is not so:" << described(found));
      ++accepted[kind];
    } else if (single) {
      if (first != std::string::npos && (line[first] == '{' || line[first] == '[') && byDom(line) &&
          !found[0].message.starts_with("nested deeper"))
        FAIL("is good: " << described(found));
      if (found[0].line == 0 || found[0].column == 0) FAIL("without a place: " << described(found));
      ++rejected[kind];
    } else {
      ++(found.empty() ? none : several);
      for (const Heard& one : found)
        if (one.message.empty() && one.text.size() > 1 && !nlohmann::json::accept(one.text))
          FAIL("no JSON: " << one.text);
    }

    const std::string file = "{\"v\":" + line + "}";
    const bool valid = nlohmann::json::accept(file, true) && file.find('\0') == std::string::npos;
    const std::string how = takenAsFile(file);
    INFO(how);
    // (A NUL in a comment, which is blanked, is none of the file's.)
    const bool isHidden = file.find('\0') != std::string::npos && file.find("/*") != std::string::npos;
    if (!isHidden && (how == "read" || how == "refused")) REQUIRE((how == "read") == valid);
    if (how == "is given twice") REQUIRE((!valid || !namesDiffer(file, true)));
    ++taken[how];

    // A record on a line of its own is read whatever is wrong with the lines around it.
    together += line + "\n";
    // (What is farther right may be a part of the record before.)
    const bool isLine = first == 0 && line.find_first_of("\r\n") == std::string::npos;
    if (single && found[0].message.empty() && isLine) good.push_back(found[0]);
    if (trial % 16 == 15) {
      auto at = good.begin();
      for (const Heard& one : again.read(together))
        if (at != good.end() && one.text == at->text && one.numbers == at->numbers) ++at;
      if (at != good.end()) FAIL("lost " << at->text << " of\n" << together);
      together.clear();
      good.clear();
    }
  }
  std::size_t acceptedAll = 0, rejectedAll = 0;
  for (const char* kind : {"bit flipped", "byte put in", "bytes left out", "bytes doubled", "odd number",
                           "odd piece put in", "bracket or sign left out", "name twice", "NUL", "nested"}) {
    INFO(kind);
    CHECK(rejected[kind] > lines / 200);
    const bool never = std::string_view(kind) == "NUL" || std::string_view(kind) == "bracket or sign left out";
    CHECK((never || accepted[kind] > lines / 1000));
    acceptedAll += accepted[kind];
    rejectedAll += rejected[kind];
  }
  CHECK(accepted["as it was"] > lines / 50);
  CHECK(rejected["as it was"] == 0);
  CHECK(several > lines / 200);
  for (const char* how : {"read", "refused", "is given twice", "nested deeper"}) CHECK(taken[how] > lines / 1000);
  INFO("accepted " << acceptedAll << ", rejected " << rejectedAll << ", several records " << several << ", none "
                   << none);
  CHECK(acceptedAll > lines / 20);
  CHECK(rejectedAll > lines / 5);
}
