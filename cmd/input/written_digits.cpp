#include "input/written_digits.hpp"

#include <algorithm>

namespace viewproj::cmd {

WrittenNumber writtenNumber(std::string_view text, double value) {
  WrittenNumber number{.value = value};
  constexpr std::string_view kDigits = "0123456789.";
  text.remove_prefix(std::min(text.find_first_of(kDigits), text.size()));
  for (const char c : text.substr(0, text.find_first_not_of(kDigits)))
    if (c != '.' && (number.significant > 0 || c != '0')) ++number.significant;
  return number;
}

void setNumbers(WrittenMatrix& matrix, const std::array<WrittenNumber, 16>& numbers) {
  for (std::size_t i = 0; i < 16; ++i) {
    matrix.numbers[i] = numbers[i].value;
    matrix.digits = std::max(matrix.digits, numbers[i].significant);
  }
}

}  // namespace viewproj::cmd
