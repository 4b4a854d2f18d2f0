// What a pasted matrix can be, as a report.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "commands/pasted/readings.hpp"
#include "output/report.hpp"

namespace viewproj::cmd {

/// What is asked of matrices beside their text.
struct MatrixQuestion {
  std::optional<Convention> readAs = {};  ///< only readings of this convention
  std::vector<ReadingKind> which = {};    ///< only readings of these kinds; empty: all
  bool isQuiet = false;                   ///< notes nothing
};

/// A matrix with the readings that are asked for.
struct ReadMatrix {
  PastedMatrix pasted;
  MatrixReadings found;
};

/// The matrices of a text. Nine or twelve numbers in a row that can be nothing are passed over. Throws InputError where
/// there is none, after the source's name and otherwise's words; notes what nearly is one.
std::vector<ReadMatrix> readMatrices(std::string_view text, const std::string& source, const std::string& otherwise,
                                     const MatrixQuestion& question);

/// The numbers of a matrix by rows, as they stand or turned.
OrderedJson rowsOf(const PastedMatrix& matrix, bool isTurned);

/// {"name", "line", "rows", "order", "float32", "readings", "notes", "fault"}. angles: each reading has "angles" too,
/// null where it is no turn or of another world than the order's axes.
OrderedJson matrixReport(const ReadMatrix& matrix, const NameRow<EulerOrder>* angles = nullptr);

/// For people: the first reading whole, the others a line each.
OrderedJson matrixPage(const ReadMatrix& matrix, const NameRow<EulerOrder>* angles, std::size_t number,
                       std::size_t count);

}  // namespace viewproj::cmd
