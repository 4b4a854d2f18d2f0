// Matrices in any text that people paste: code, prints of debuggers and languages, logs, prose. Numbers are never
// added or guessed, and reordered only by the row and column that a text states; what nearly is a matrix is passed
// over and said.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace viewproj::cmd {

struct PrintedNumber {
  double value = 0;  ///< may be infinite or NaN
  std::string text;  ///< as printed, without a suffix; d of an exponent is e
};

struct PastedMatrix {
  std::string name;     ///< as the text calls it, or empty
  std::string context;  ///< the last lines with words in front of it, and its own first one
  std::size_t line = 1, rows = 0, columns = 0;
  std::vector<PrintedNumber> numbers;  ///< row by row, as shown
  bool isInMemoryOrder = false;        ///< numbers in a row; else rows as on paper
  bool isByColumns = false;            ///< the text says that what stands in a row is a column: mat4(, simd_float4x4
  bool isCss = false;                  ///< matrix3d(: columns, for sure
  double factor = 1;                   ///< of all entries: 1.0e+03 * of MATLAB

  double at(std::size_t row, std::size_t column) const { return numbers[row * columns + column].value * factor; }
};

/// Numbers that are no matrix.
struct PassedOver {
  std::size_t line = 0, numbers = 0;
  std::string name;     ///< what stands right in front of them: t, tvec
  std::string why;      ///< "5 rows of 4 numbers are no matrix; put an empty line between two matrices"
  bool isList = false;  ///< in brackets
};

struct PastedMatrices {
  std::vector<PastedMatrix> matrices;
  std::vector<PassedOver> passedOver;
};

/// All matrices of 3x3, 3x4, 4x4 and, in brackets, 4x3 numbers; of the comments only where the rest has none. Takes
/// time and memory in proportion to the text.
PastedMatrices findMatrices(std::string_view text);

}  // namespace viewproj::cmd
