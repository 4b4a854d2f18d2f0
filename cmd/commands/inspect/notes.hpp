// What the readings of a matrix mean for a picture, in words.
#pragma once

#include <string>
#include <vector>

#include "viewproj/cameras_of.hpp"

namespace viewproj::cmd {

/// That of an orthographic view-projection is not in the matrix.
inline bool isEyeKnown(const MatrixCamera& r) noexcept { return r.pose && !(r.lens && r.lens->orthographic); }

/// What the numbers leave open, and what is seen where one reading is taken for another.
std::vector<std::string> notesOn(const std::vector<MatrixCamera>& readings);

/// A decimal number of the interval with as few digits as there is one.
std::string shortestWithin(const PlaneDistance& estimate);

}  // namespace viewproj::cmd
