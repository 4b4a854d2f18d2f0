// Lines of CSV: what separates their columns, quotes, and where a record ends. A quote counts where a field begins with
// it, up to the one that closes; two are one of the field's own.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace viewproj::cmd {

struct SeparatorName {
  std::string_view name;
  char separator;
};
inline constexpr SeparatorName kSeparators[] = {{"comma", ','}, {"semicolon", ';'}, {"tab", '\t'}};

/// As a column of the output: in quotes where it has a separator, a quote or a line break.
std::string quotedIfNeeded(std::string_view cell, char separator = ',');

/// A field without its quotes.
std::string csvValue(std::string_view field);

/// The offset after the quote that closes the one at `quote`; npos where none does.
inline std::size_t afterQuotes(std::string_view text, std::size_t quote) {
  std::size_t close = text.find('"', quote + 1);
  while (close != std::string_view::npos && close + 1 < text.size() && text[close + 1] == '"')
    close = text.find('"', close + 2);
  return close == std::string_view::npos ? close : close + 1;
}

/// Whether a field with quotes ends with the one that closes them.
inline bool isWholeField(std::string_view field) {
  return !field.starts_with('"') || afterQuotes(field, 0) == field.size();
}

/// The fields of a record as written, or the first `most`.
void splitCsvLine(std::string_view line, std::vector<std::string_view>& fields, char separator,
                  std::size_t most = SIZE_MAX);

/// Throws RecordError at a carriage return outside of quotes, and at text after the quote that closes a field. record:
/// has the fields.
void requireWholeFields(std::string_view record, const std::vector<std::string_view>& fields, char separator);

inline constexpr const char* kLoneReturn =
    "a carriage return that ends no line; expected lines that end with LF or CRLF, as tr '\\r' '\\n' makes them";

/// The offset of the line break that ends the record which begins at `from`, or the text's size. unclosed: is set to
/// the offset of a quote that opens and does not close.
inline std::size_t endOfCsvRecord(std::string_view text, std::size_t from, char separator,
                                  std::size_t* unclosed = nullptr) {
  constexpr std::size_t npos = std::string_view::npos;
  std::size_t line = std::min(text.find('\n', from), text.size());
  for (std::size_t field = from;;) {
    if (line < field) line = std::min(text.find('\n', field), text.size());  // it stood in quotes
    const std::size_t quote = text.substr(0, line).find('"', field);
    if (quote == npos) return line;
    const bool opens = quote == from || text[quote - 1] == separator;
    field = opens ? afterQuotes(text, quote) : quote + 1;
    if (field == npos) {
      if (unclosed) *unclosed = quote;
      return text.size();
    }
  }
}

/// Finds the line breaks that end records in a text that grows, and looks at no byte twice.
class CsvEnds {
 public:
  explicit CsvEnds(char separator = ',') : separator_(separator) {}

  /// The offset after the last one; 0 if there is none yet. text begins as it did in the call before.
  std::size_t lastEnd(std::string_view text);

 private:
  char separator_;
  std::size_t at_ = 0, after_ = 0;
  bool quoted_ = false;
};

}  // namespace viewproj::cmd
