// What matrices can be: every reading of a 4x4, the camera in a K or P, and a matrix in another convention.
#pragma once

#include <optional>

#include "commands/matrix_numbers.hpp"
#include "output/report.hpp"
#include "viewproj/cameras_of.hpp"

namespace viewproj::cmd {

/// What is known of a matrix beside its numbers.
struct InspectQuery {
  bool isFloat = false;
  std::optional<Convention> readAs;  ///< only readings of this convention
  std::optional<Convention> stated;  ///< the input's own
};

/// Whether a matrix of this camera would be written like that in this convention, apart from reverseZ and world, which
/// follow from the matrix and the rest.
bool fits(const MatrixCamera& reading, const Convention& convention, NumberOrder order);

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

/// "projection, as written, view RUB, ndcZ -1..1, reverseZ no, ndcY up".
std::string oneLine(const MatrixCamera& reading);

}  // namespace viewproj::cmd
