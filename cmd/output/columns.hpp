// How results of several numbers spread over CSV columns: viewDistance is view_distance, screen is screen_x, screen_y.
#pragma once

#include <cctype>
#include <string>
#include <string_view>

namespace viewproj::cmd {

inline constexpr std::string_view kColumnSuffixes[] = {"_x", "_y", "_z", "_w"};

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
