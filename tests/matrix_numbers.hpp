// A matrix as the sixteen numbers that `inspect` and inspectMatrix take.
#pragma once

#include <array>

#include "viewproj/vectors.hpp"

using Numbers = std::array<double, 16>;

inline Numbers rowsOf(const viewproj::Mat4& m) {
  Numbers n{};
  for (std::size_t i = 0; i < 16; ++i) n[i] = m[i / 4][i % 4];
  return n;
}
