// Tables for people.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace viewproj::cmd {

using TextRows = std::vector<std::vector<std::string>>;

/// Rows as lines in aligned columns, two blanks apart, and indented.
std::string aligned(const TextRows& rows, const std::function<bool(std::size_t column)>& isRightAligned,
                    std::size_t indent = 0);

/// Lines of CSV as aligned columns. How wide these are, the first thousand lines tell, or the first MiB; a cell of more
/// than 200 bytes does not.
class CsvAligner {
 public:
  explicit CsvAligner(char separator = ',') : separator_(separator) {}

  /// csv: whole lines. Returns what can be written: nothing before the widths are known.
  std::string add(std::string_view csv);
  /// All that is left.
  std::string rest();

 private:
  void align(std::string& out);

  char separator_;
  TextRows rows_;
  std::vector<std::size_t> widths_;
  std::size_t bytes_ = 0;  ///< of rows_
  bool widthsAreSet_ = false;
};

}  // namespace viewproj::cmd
