// Matrices in text of any kind: prints of programs, source code, tables.
#pragma once

#include <string>
#include <vector>

#include "input/written_matrix.hpp"

namespace viewproj::cmd {

/// At least one. Throws InputError where numbers are too few or too many, or brackets do not close. name: of the file.
std::vector<WrittenMatrix> scanMatrices(const std::string& text, const std::string& name);

}  // namespace viewproj::cmd
