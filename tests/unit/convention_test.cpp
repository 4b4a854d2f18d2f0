#include "viewproj/convention.hpp"

#include "catch.hpp"
#include "internals.hpp"

using namespace viewproj;
using namespace viewproj::detail;

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
