// Cameras in other programs' files put points where those programs put them. What they say is in fixtures, written by
// judge.sh; VIEWPROJ_FIXTURES in the environment names other ones, fresh from the judges.
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "tool.hpp"

namespace {

using nlohmann::json;

json run(const std::vector<std::string>& arguments) { return json::parse(tool::printed(arguments)); }

/// Files of this test alone.
class Scratch {
 public:
  Scratch() {
    std::string name = (std::filesystem::temp_directory_path() / "viewproj-judged-XXXXXX").string();
    REQUIRE(mkdtemp(name.data()));
    folder_ = name;
  }
  ~Scratch() { std::filesystem::remove_all(folder_); }

  std::string folder() const { return folder_.string(); }

  /// A text is written as it is.
  std::string write(const std::string& name, const json& value) const {
    const std::string path = (folder_ / name).string();
    if (value.is_string())
      std::ofstream(path) << value.get_ref<const std::string&>();
    else
      std::ofstream(path) << value;
    return path;
  }

 private:
  std::filesystem::path folder_;
};

/// What the judges say, and the tool's field for it. A judge leaves out what it does not know.
constexpr const char* kJudged[] = {"screen", "depth", "viewDistance", "visible", "outside"};

struct Compared {
  std::map<std::string, double> worst;  ///< by the name of the case, in pixels
  std::map<std::string, int> fields;    ///< how often each was compared; "behind" and the sides, how often met
};

/// Within the tolerance, of numbers above 1 of their size; everything else must be equal.
void compareField(const std::string& field, const json& got, const json& said, double tolerance, double& worst) {
  if (field == "screen" && said.is_array() && got.is_array()) {
    for (std::size_t k = 0; k < 2; ++k) compareField("", got[k], said[k], tolerance, worst);
  } else if (said.is_number() && got.is_number()) {
    const double off = std::fabs(got.get<double>() - said.get<double>());
    REQUIRE(off <= tolerance * std::max(1.0, field.empty() ? 1.0 : std::fabs(said.get<double>())));
    if (field.empty()) worst = std::max(worst, off);
  } else {
    REQUIRE(got == said);
  }
}

Compared compare(const std::string& fixture, double tolerance) {
  const char* fresh = std::getenv("VIEWPROJ_FIXTURES");
  std::ifstream lines(std::string(fresh ? fresh : VIEWPROJ_FIXTURES_DIR) + "/" + fixture);
  REQUIRE(lines);
  const Scratch scratch;
  Compared compared;
  for (std::string line; std::getline(lines, line);) {
    const json test = json::parse(line);
    const std::string name = test["name"];
    std::string camera = scratch.write("camera", test["file"]);
    if (test.contains("files")) {  // the camera's is a folder
      for (const auto& [file, text] : test["files"].items())
        if (const std::string path = scratch.write(file, text); text.is_null()) std::filesystem::remove(path);
      camera = scratch.folder();
    }
    if (test["pick"].is_string()) camera += "#" + test["pick"].get<std::string>();
    std::vector<std::string> arguments{"project", "-c", camera, scratch.write("points.json", test["points"])};
    if (test["viewport"].is_string()) {
      arguments.push_back("--viewport");
      arguments.push_back(test["viewport"]);
    }
    if (test.contains("options"))
      for (const json& option : test["options"]) arguments.push_back(option);
    const json got = run(arguments);
    const json& judgements = test["judgements"];
    REQUIRE(got.size() == judgements.size());
    REQUIRE(!got.empty());
    for (std::size_t i = 0; i < got.size(); ++i) {
      INFO(name << ": " << line);
      INFO(got[i].dump());
      INFO(judgements[i].dump());
      for (const char* field : kJudged) {
        if (!judgements[i].contains(field)) continue;
        INFO(field);
        // Nothing is said of a point that lies beyond no side.
        const json said = got[i].value(field, json::array());
        compareField(field, said, judgements[i][field], tolerance, compared.worst[name]);
        ++compared.fields[field];
      }
      for (const json& side : judgements[i]["outside"]) ++compared.fields[side];
    }
  }
  return compared;
}

void report(const std::map<std::string, double>& worst) {
  for (const auto& [name, off] : worst) std::printf("  %-45s %.1e px\n", name.c_str(), off);
}

}  // namespace

TEST_CASE("three.js, glTF and matrices put points where three.js puts them, to 1e-9 px, and see what it sees") {
  Compared compared = compare("threejs.jsonl", 1e-9);
  report(compared.worst);
  CHECK(compared.worst.size() == 24);
  for (const char* field : {"screen", "depth", "viewDistance", "visible", "outside"})
    CHECK(compared.fields[field] >= 200);
  for (const char* side : {"left", "right", "bottom", "top", "near", "far", "behind"})
    CHECK(compared.fields[side] >= 10);
}

TEST_CASE("Calibrations and transforms.json put points where OpenCV puts them, to 1e-9 px, and show what it shows") {
  Compared compared = compare("opencv.jsonl", 1e-9);
  report(compared.worst);
  CHECK(compared.worst.size() == 22);
  for (const char* field : {"screen", "viewDistance", "visible", "outside"}) CHECK(compared.fields[field] >= 300);
  for (const char* side : {"left", "right", "bottom", "top", "near", "far", "behind"})
    CHECK(compared.fields[side] >= 2);
  CHECK(compared.fields["lens"] >= 20);
}

TEST_CASE("Files of other programs put points where forty digits put them, to 1e-9 px, and show what those show") {
  Compared compared = compare("decimals.jsonl", 1e-9);
  report(compared.worst);
  CHECK(compared.worst.size() == 26);
  for (const char* field : {"screen", "viewDistance", "visible", "outside"}) CHECK(compared.fields[field] >= 300);
  for (const char* side : {"left", "right", "bottom", "top", "behind"}) CHECK(compared.fields[side] >= 25);
}
