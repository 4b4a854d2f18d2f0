// Matrices as people have them (JSON, an initialiser of a program, rows of numbers), and what they can be: every
// reading of a 4x4, the camera in a K or P, and a matrix in another convention.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "output/report.hpp"
#include "viewproj/cameras_of.hpp"

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

/// What is known of a matrix beside its numbers.
struct InspectQuery {
  bool isFloat = false;
  std::optional<Convention> readAs = {};  ///< only readings of this convention
  std::optional<Convention> stated = {};  ///< the input's own
};

/// {"name", "readings", "faults" where nothing is known, "notes"}; of a calibration {"name", "kind", "fx", ...}. Throws
/// CameraError for a calibration that is none.
OrderedJson inspectReport(const WrittenMatrix& matrix, const InspectQuery& query);

/// The report for people: a line for each reading, and one for each parameter.
OrderedJson inspectPage(const OrderedJson& report);

/// The readings of a matrix that its name (view, viewInverse, projection) and the conventions allow.
std::vector<MatrixCamera> statedReadings(const WrittenMatrix& matrix, const InspectQuery& query);

/// The matrix of the same kind in another convention, for column vectors, from the recovered parameters. Throws
/// CameraError where near or far is not determined well enough.
Mat4 converted(const MatrixCamera& reading, const Convention& convention);

}  // namespace viewproj::cmd
