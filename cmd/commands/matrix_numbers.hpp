// Matrices as people have them: JSON, an initialiser of a program, or rows of numbers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "viewproj/convention.hpp"

namespace viewproj::cmd {

/// What the order of the numbers stands for.
enum class NumberOrder {
  memory,  ///< sixteen in a row: the order in memory
  rows,    ///< four rows of four: rows as on paper, or the order in memory
};

struct WrittenMatrix {
  std::string name;             ///< as the input calls it, or "matrix 1"
  std::vector<double> numbers;  ///< 16, or of a calibration 9 (K) or 12 (K [R | t]), row by row
  NumberOrder order = NumberOrder::memory;

  bool isCalibration() const { return numbers.size() != 16; }
};

struct WrittenMatrices {
  std::vector<WrittenMatrix> matrices;
  std::optional<Convention> convention;  ///< what the input says of itself, as `matrix --to json` does
  bool isFloat = false;                  ///< of a type that holds float32s, in the text's own words
};

/// The text is
/// - a JSON object, whose values of 16 numbers or 4 rows of 4 (and 3 rows of 3 or 4) are the matrices; or else
/// - any text in which sixteen numbers after the other are a matrix: brackets, commas, bars, words, f suffixes and
///   // or /* */ comments are passed over, and so is all before a = or a colon but the name there; a line that starts
///   with # names what follows.
/// Throws InputError with the place of what is wrong.
WrittenMatrices parseMatrices(const std::string& text, const std::string& source);

}  // namespace viewproj::cmd
