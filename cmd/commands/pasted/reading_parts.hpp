// The steps from the numbers of a pasted matrix to its readings.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "commands/pasted/readings.hpp"

namespace viewproj::cmd {

/// Of the 3x3 part.
Vec3 rowOf(const Mat4& m, std::size_t i);
Vec3 lastColumn(const Mat4& m);
bool isDiagonal(const Mat4& m);     ///< of the 3x3 part, too
double determinant(const Mat4& m);  ///< of the 3x3 part, too

Mat4 diagonal(double x, double y, double z, double w);
Mat4 product(const Mat4& a, const Mat4& b);
Mat4 absolute(Mat4 m);  ///< the size of each entry

/// By cofactors, which keep the zeros and ones of a projection.
std::optional<Mat4> inverseOf(const Mat4& m);

/// Half of the last digit that each entry could show. Programs print so many decimals or so many significant digits,
/// and either may drop zeros at the end: the most of each that any entry has are those of all. Numbers that keep a zero
/// and have different decimals were typed: each has its own last digit. Numbers without a point or exponent are exact.
std::vector<double> printedErrors(std::span<const PrintedNumber> numbers);

/// Whether each entry prints like the float32 next to it.
bool areFloats(std::span<const PrintedNumber> numbers);

/// Adds what computing the entries may have lost: a few units of the size of what was summed, in the last column the
/// eye's products. eye: nothing where there is none.
void addRounding(Mat4& errors, const Mat4& matrix, bool isFloat, const Vec3& eye);

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

/// Of a projection or a view-projection.
bool isInverse(const Reading& reading);

/// Whether it is the lens of no usual camera: without depth, of other size, very wide or narrow.
bool isStrange(const Reading& reading);

/// Puts the likeliest reading first.
void sortByCost(std::vector<Reading>& readings, const KindHint& hint, const PastedMatrix& matrix);

/// Puts the views and poses first whose axes a projection in the same text has in its likeliest reading. lens: its
/// readings, the likeliest first.
void orderBeside(std::vector<Reading>& readings, const std::vector<Reading>& lens);

}  // namespace viewproj::cmd
