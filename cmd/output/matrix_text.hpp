// Matrices in text formats. To add a format: a function in matrix_text.cpp and a row in kMatrixFormats.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "viewproj/camera/convention.hpp"
#include "viewproj/numbers/vectors.hpp"

namespace viewproj::cmd {

struct NamedMatrix {
  std::string name;
  Mat4 matrix;  ///< for column vectors; the writer lays it out
};

struct MatrixSet {
  std::vector<NamedMatrix> matrices;
  Convention convention;
  std::optional<Vec3> eye;  ///< where the view was left without its translation
  bool asFloat = false;     ///< round to float32 and write its shortest text
};

/// The names of the formats.
std::vector<std::string_view> matrixFormats();

/// format: one of matrixFormats().
std::string writeMatrices(const MatrixSet& set, std::string_view format);

}  // namespace viewproj::cmd
