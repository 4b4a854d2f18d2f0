// How results of several numbers spread over CSV columns: viewDistance is view_distance, screen is screen_x, screen_y.
#pragma once

#include <cctype>
#include <string>
#include <string_view>

namespace viewproj::cmd {

inline constexpr std::string_view kColumnSuffixes[] = {"_x", "_y", "_z", "_w"};

/// The results of a record and how many numbers each has, and the vectors that are read.
struct FieldSize {
  std::string_view name;
  std::size_t size;
};
inline constexpr FieldSize kFieldSizes[] = {
    {"screen", 2}, {"depth", 1}, {"viewDistance", 1}, {"visible", 1}, {"outside", 1},   {"ndc", 3},   {"clip", 4},
    {"view", 3},   {"bound", 1}, {"pixel", 2},        {"origin", 3},  {"direction", 3}, {"point", 3}, {"position", 3}};

/// The row of a name that begins with this prefix.
inline const FieldSize* findFieldSize(std::string_view name, std::string_view prefix = "") {
  if (!name.starts_with(prefix)) return nullptr;
  name.remove_prefix(prefix.size());
  for (const FieldSize& row : kFieldSizes)
    if (row.name == name) return &row;
  return nullptr;
}

inline std::string columnName(std::string_view name) {
  std::string column;
  for (char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isupper(byte)) column += '_';
    column += static_cast<char>(std::tolower(byte));
  }
  return column;
}

}  // namespace viewproj::cmd
