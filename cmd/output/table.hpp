// Tables for people.
#pragma once

#include <string>
#include <vector>

namespace viewproj::cmd {

/// Rows as lines in aligned columns, two blanks apart: the first column to the left, the others to the right. All rows
/// have as many cells as the first, which is the header.
std::string alignedTable(const std::vector<std::vector<std::string>>& rows);

}  // namespace viewproj::cmd
