// Products, inverses and parts of 4x4 matrices for column vectors.
#pragma once

#include <cstddef>
#include <optional>

#include "viewproj/vectors.hpp"

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

}  // namespace viewproj::cmd
