// Tables for people.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace viewproj::cmd {

/// Rows as lines in aligned columns, two blanks apart: the first column to the left, the others to the right. All rows
/// have as many cells as the first, which is the header.
std::string alignedTable(const std::vector<std::vector<std::string>>& rows);

/// Lines of CSV as aligned columns. How wide these are, the first thousand lines tell, or the first MiB; a cell of more
/// than 200 bytes does not.
class CsvAligner {
 public:
  /// csv: whole lines. Returns what can be written: nothing before the widths are known.
  std::string add(std::string_view csv);
  /// All that is left.
  std::string rest();

 private:
  void align(std::string& out);

  std::vector<std::vector<std::string>> rows_;
  std::vector<std::size_t> widths_;
  std::size_t bytes_ = 0;  ///< of rows_
  bool widthsAreSet_ = false;
};

}  // namespace viewproj::cmd
