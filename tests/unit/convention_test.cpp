#include "viewproj/convention.hpp"

#include <fstream>
#include <sstream>

#include "catch.hpp"

using namespace viewproj;

TEST_CASE("The page of conventions has the library's table of presets, and a picture of each") {
  const std::string folder = VIEWPROJ_CONVENTIONS;
  std::ifstream file(folder + "/README.md");
  std::stringstream text;
  text << file.rdbuf();
  for (const ConventionPreset& preset : conventionPresets()) {
    const Convention& c = preset.convention;
    constexpr const char* kViews[] = {"RUB", "RUF", "RDF"};
    std::ostringstream row;
    row << "| `" << preset.name << "` | " << (c.world == Handedness::right ? "right" : "left") << " | "
        << kViews[int(c.view)] << " | " << (c.ndcZ == NdcZ::zeroToOne ? "0..1" : "-1..1") << " | "
        << (c.reverseZ ? "yes" : "no") << " | " << (c.ndcY == NdcY::up ? "up" : "down") << " | "
        << (c.vectors == Vectors::column ? "column" : "row") << " | "
        << (c.storage == Storage::columnMajor ? "column-major" : "row-major") << " |";
    INFO(row.str());
    CHECK(text.str().find(row.str()) != std::string::npos);
    const std::string picture = std::string(preset.name) + ".svg";
    CHECK(text.str().find("](" + picture + ")") != std::string::npos);
    CHECK(std::ifstream(folder + "/" + picture).good());
  }
}

TEST_CASE("A preset is found by its name, and by nothing else") {
  CHECK(conventionPreset("opengl") == Convention{});
  CHECK_FALSE(conventionPreset("OpenGL"));
  CHECK_FALSE(conventionPreset(""));
}
