// A value in a document, and the numbers in it, however they are written.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "input/document.hpp"
#include "input/kinds/kind.hpp"

namespace viewproj::cmd {

/// A value and the keys that lead to it from the root.
struct Found {
  Path path;
  const nlohmann::json* value;
};

/// The value at the end of the steps from a place on, none of which is "*"; nothing where it is absent or null. Counts
/// as read.
std::optional<Found> follow(const Document& document, const Found& from, const Steps& steps);

/// The numbers of an array of any nesting, of {"rows", "cols", "data"}, of {"x", "y", "z"} or of a text with blanks
/// between them; false at what is none.
bool numbersOf(const Document& document, const Found& found, std::vector<double>& numbers);

/// Of 3x3, 3x4 or 4x4 numbers.
bool isIdentity(std::span<const double> numbers);

/// Throws where a matrix that FileStorage wrote has not as many numbers as its rows and columns say.
void requireStored(const Document& document, const Found& found, std::size_t count);
/// Rows and columns, where the file tells them.
std::optional<std::array<double, 2>> shapeOf(const Document& document, const Found& found);
/// How many rows an array of arrays or a matrix of FileStorage has; 0: it is none.
std::size_t rowsOf(const Document& document, const Found& found);
/// The numbers of one of them; false where it has none.
bool numbersOfRow(const Document& document, const Found& found, std::size_t row, std::vector<double>& numbers);

/// Whether two values are the same numbers, or texts.
bool isSame(const Document& document, const Found& a, const Found& b);

}  // namespace viewproj::cmd
