// The readings of a pasted matrix in one layout, in no order.
#pragma once

#include <string>
#include <vector>

#include "commands/pasted/readings.hpp"

namespace viewproj::cmd {

inline constexpr double kFewestPixels = 20;  ///< a smaller focal length is in half widths

/// A pasted matrix for column vectors.
struct LaidOut {
  MatrixLayout layout;
  Mat4 m, printed;  ///< and the errors of its digits
  std::size_t rows;
  bool isWide;  ///< has a fourth column
};
LaidOut laidOut(const PastedMatrix& pasted, const std::vector<double>& printed, MatrixLayout layout);

/// Adds the readings of a matrix to those found; returns why there is none.
std::string addReadings(const PastedMatrix& pasted, const LaidOut& laid, bool isFloat, std::vector<Reading>& found);

/// Adds the projections and view-projections of which this matrix is the inverse.
void addInverses(const PastedMatrix& pasted, const LaidOut& laid, bool isFloat, std::vector<Reading>& found);

/// "row 2 has -2.241 where -0.241 would make it a rotation": of a 3x3 part in which two rows, or columns, are unit
/// vectors at a right angle and the third is their cross product but for one entry. Else empty.
std::string typedWrong(const LaidOut& laid);

/// Of the Q of OpenCV's stereoRectify, in either layout, what it is; else empty.
std::string disparityOf(const Mat4& m);

}  // namespace viewproj::cmd
