// Lines of CSV: separators, quotes, and the ends of records. A quote opens a quoted field only at the field's
// beginning. Two quotes in a quoted field are one character of the field.
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

/// A cell of the output. It is quoted if it contains a separator, a quote or a line break.
std::string quotedIfNeeded(std::string_view cell, char separator = ',');

/// A field without its quotes.
std::string csvValue(std::string_view field);

/// The offset after the quote that closes the one at `quote`; npos if none does.
inline std::size_t afterQuotes(std::string_view text, std::size_t quote) {
  std::size_t close = text.find('"', quote + 1);
  while (close != std::string_view::npos && close + 1 < text.size() && text[close + 1] == '"')
    close = text.find('"', close + 2);
  return close == std::string_view::npos ? close : close + 1;
}

/// Whether a quoted field ends with its closing quote. True for a field without quotes.
inline bool isWholeField(std::string_view field) {
  return !field.starts_with('"') || afterQuotes(field, 0) == field.size();
}

/// Appends the fields of a record as written, or the first `most` of them.
void splitCsvLine(std::string_view line, std::vector<std::string_view>& fields, char separator,
                  std::size_t most = SIZE_MAX);

/// Throws RecordError at a carriage return outside of quotes, and at text after a field's closing quote. The fields
/// must be views of record.
void requireWholeFields(std::string_view record, const std::vector<std::string_view>& fields, char separator);

inline constexpr const char* kLoneReturn =
    "a carriage return without a line feed; expected LF or CRLF, for example from tr '\\r' '\\n'";

/// The offset of the line break that ends the record starting at `from`, or the text's size. unclosed is set to the
/// offset of an opening quote that is never closed.
inline std::size_t endOfCsvRecord(std::string_view text, std::size_t from, char separator,
                                  std::size_t* unclosed = nullptr) {
  constexpr std::size_t npos = std::string_view::npos;
  std::size_t line = std::min(text.find('\n', from), text.size());
  for (std::size_t field = from;;) {
    if (line < field) line = std::min(text.find('\n', field), text.size());  // that line break was in quotes
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

/// Finds the line breaks that end records in a growing text, without reading a byte twice.
class CsvEnds {
 public:
  explicit CsvEnds(char separator = ',') : separator_(separator) {}

  /// The offset after the last such line break; 0 if there is none yet. text must begin with the text of the last call.
  std::size_t lastEnd(std::string_view text);

 private:
  char separator_;
  std::size_t at_ = 0, after_ = 0;
  bool quoted_ = false;
};

}  // namespace viewproj::cmd
