// Where a record of CSV ends: a line break inside the quotes of a field belongs to the record.
#pragma once

#include <algorithm>
#include <string_view>

namespace viewproj::cmd {

/// The offset of the line break that ends the record which begins at `from`, or the text's size. unclosed: is set to
/// the offset of a quote that opens and does not close. Quotes count where a field begins with one.
inline std::size_t endOfCsvRecord(std::string_view text, std::size_t from, std::size_t* unclosed = nullptr) {
  constexpr std::size_t npos = std::string_view::npos;
  std::size_t line = std::min(text.find('\n', from), text.size());
  for (std::size_t field = from;;) {
    if (line < field) line = std::min(text.find('\n', field), text.size());  // it stood in quotes
    const std::size_t quote = text.substr(0, line).find('"', field);
    if (quote == npos) return line;
    if (quote > from && text[quote - 1] != ',') {
      field = quote + 1;  // one of the field's own
      continue;
    }
    std::size_t close = text.find('"', quote + 1);
    while (close != npos && close + 1 < text.size() && text[close + 1] == '"') close = text.find('"', close + 2);
    if (close == npos) {
      if (unclosed) *unclosed = quote;
      return text.size();
    }
    field = close + 1;
  }
}

}  // namespace viewproj::cmd
