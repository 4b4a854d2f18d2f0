// How far the entries of a matrix may be off, from the digits they were printed with.
#pragma once

#include <span>
#include <vector>

#include "text/pasted_matrices.hpp"
#include "viewproj/vectors.hpp"

namespace viewproj::cmd {

/// Half of the last digit that each entry could show. Programs print so many decimals or so many significant digits,
/// and either may drop zeros at the end: the most of each that any entry has are those of all. Numbers that keep a zero
/// and have different decimals were typed: each has its own last digit. Numbers without a point or exponent are exact.
std::vector<double> printedErrors(std::span<const PrintedNumber> numbers);

/// Whether each entry prints like the float32 next to it.
bool areFloats(std::span<const PrintedNumber> numbers);

/// Adds what computing the entries may have lost: a few units of the size of what was summed, in the last column the
/// eye's products. eye: nothing where there is none.
void addRounding(Mat4& errors, const Mat4& matrix, bool isFloat, const Vec3& eye);

}  // namespace viewproj::cmd
