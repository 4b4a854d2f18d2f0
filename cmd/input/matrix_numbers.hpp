// Matrices as people have them: JSON, an initialiser of a program, or plain text.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "input/written_matrix.hpp"
#include "viewproj/convention.hpp"

namespace viewproj::cmd {

struct WrittenMatrices {
  std::vector<WrittenMatrix> matrices;
  std::optional<Convention> convention;  ///< what the input says of itself, as `matrix --to json` does
  bool isFloat = false;                  ///< of a type that holds float32s, in the text's own words
};

/// The text is
/// - a JSON object, whose values of 16 numbers or 4 rows of 4 are the matrices; or
/// - CSV as `matrix` writes it; or else
/// - any text in which sixteen numbers after the other are a matrix: brackets, commas, bars, words, f suffixes and
///   // or /* */ comments are passed over, and so is all before a = or a colon but the name there; a line that starts
///   with # names what follows.
/// Throws InputError with the place of what is wrong.
WrittenMatrices parseMatrices(const std::string& text, const std::string& name);

}  // namespace viewproj::cmd
