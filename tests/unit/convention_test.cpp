#include "viewproj/convention.hpp"

#include <fstream>
#include <sstream>

#include "catch.hpp"
#include "internals.hpp"

using namespace viewproj;
using namespace viewproj::detail;

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

TEST_CASE(
    "Sixteen numbers in memory are read as they are written, and a translation stands where the convention keeps it") {
  Mat4 m;
  for (std::size_t i = 0; i < 16; ++i) m[i / 4][i % 4] = double(i + 1);
  for (const Vectors vectors : {Vectors::column, Vectors::row})
    for (const Storage storage : {Storage::columnMajor, Storage::rowMajor}) {
      Convention c;
      c.vectors = vectors;
      c.storage = storage;
      const std::array<double, 16> memory = inStorageOrder(m, c);
      std::array<float, 16> floats{};
      for (std::size_t i = 0; i < 16; ++i) floats[i] = float(memory[i]);
      CHECK(fromStorageOrder(memory, c) == m);
      CHECK(fromStorageOrder(floats, c) == m);
      // Column vectors by columns and row vectors by rows keep x, y, z of the translation together.
      const bool isTogether = (vectors == Vectors::column) == (storage == Storage::columnMajor);
      CHECK(memory[isTogether ? 13 : 7] == m[1][3]);
    }
}
