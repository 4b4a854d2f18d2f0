// Matrices in text formats. To add a language: a row of kLanguages in matrix_text.cpp.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "text/form.hpp"
#include "viewproj/convention.hpp"
#include "viewproj/vectors.hpp"

namespace viewproj::cmd {

struct NamedMatrix {
  std::string name;
  Mat4 matrix;  ///< for column vectors; the writer lays it out
};

struct MatrixSet {
  std::vector<NamedMatrix> matrices;
  std::optional<std::string> camera = {};  ///< of several: JSON is one line that names it
  Convention convention;
  std::optional<Vec3> eye;     ///< where the view was left without its translation
  bool asFloat = false;        ///< round to float32 and write its shortest text
  bool bakesViewport = false;  ///< projections go to the screen, not to clip space
};

/// A form is its name.
std::vector<FormRow<std::string_view>> matrixForms();

/// format: one of matrixForms(). What its language knows only as float32 is rounded to that. Throws InputError, after
/// the source's name, for an entry too large for what is written, or where float32 leaves a row or column of 0.
std::string writeMatrices(MatrixSet set, std::string_view format, const std::string& source);

}  // namespace viewproj::cmd
