#include "output/table.hpp"

#include <algorithm>

namespace viewproj::cmd {

std::string alignedTable(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (i == widths.size()) widths.push_back(0);
      widths[i] = std::max(widths[i], row[i].size());
    }
  std::string out;
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::size_t padding = widths[i] - row[i].size();
      if (i > 0) out.append(padding + 2, ' ');
      out += row[i];
      if (i == 0 && row.size() > 1) out.append(padding, ' ');
    }
    out += '\n';
  }
  return out;
}

}  // namespace viewproj::cmd
