// Lines of CSV: what separates their columns, quotes, and where a record ends.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace viewproj::cmd {

struct CsvFormat {
  static constexpr char kBlanks = ' ';  ///< any run of blanks and tabs is one separator

  char separator = ',';

  bool isBlanks() const { return separator == kBlanks; }
  bool separates(char c) const { return c == separator || (isBlanks() && c == '\t'); }
  bool operator==(const CsvFormat&) const = default;
};

/// What separates columns, by name or as the character itself.
struct SeparatorName {
  std::string_view name, plural;
  char separator;
};
inline constexpr SeparatorName kSeparators[] = {{"comma", "commas", ','},
                                                {"semicolon", "semicolons", ';'},
                                                {"tab", "tabs", '\t'},
                                                {"bar", "bars", '|'},
                                                {"blank", "blanks", CsvFormat::kBlanks}};
std::string_view nameOfSeparator(char separator);

/// As a column of the output: in quotes where it has a separator, a quote or a line break, or would be lost.
std::string quotedIfNeeded(std::string_view cell, const CsvFormat& format = {});

/// The offset of the line break that ends the record which begins at `from`, or the text's size. unclosed: is set to
/// the offset of a quote that opens and does not close. Quotes count where a field begins with one.
inline std::size_t endOfCsvRecord(std::string_view text, std::size_t from, const CsvFormat& format,
                                  std::size_t* unclosed = nullptr) {
  constexpr std::size_t npos = std::string_view::npos;
  std::size_t line = std::min(text.find('\n', from), text.size());
  for (std::size_t field = from;;) {
    if (line < field) line = std::min(text.find('\n', field), text.size());  // it stood in quotes
    const std::size_t quote = text.substr(0, line).find('"', field);
    if (quote == npos) return line;
    if (quote > from && !format.separates(text[quote - 1])) {
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

/// Finds the line breaks that end records in a text that grows, and looks at no byte twice.
class CsvEnds {
 public:
  explicit CsvEnds(const CsvFormat& format = {}) : format_(format) {}

  /// The offset of the next one; npos if there is none yet. text begins as it did in the call before.
  std::size_t nextEnd(std::string_view text) { return scan(text, true); }
  /// The offset after the last one; 0 if there is none yet.
  std::size_t lastEnd(std::string_view text) {
    scan(text, false);
    return after_;
  }

 private:
  static constexpr std::size_t npos = std::string_view::npos;

  std::size_t scan(std::string_view text, bool first) {
    std::size_t lineBreak = first ? text.find('\n', at_) : npos;
    while (at_ < text.size()) {
      if (quoted_) {
        const std::size_t quote = text.find('"', at_);
        if (quote == npos || quote + 1 == text.size()) {
          at_ = std::min(quote, text.size());
          break;  // whether it closes, what follows tells
        }
        quoted_ = text[quote + 1] == '"';
        at_ = quote + 1 + quoted_;
        continue;
      }
      // No farther than to the line break that is wanted.
      if (first && lineBreak < at_) lineBreak = text.find('\n', at_);
      const std::size_t quote = text.substr(0, lineBreak).find('"', at_);
      const std::string_view plain = text.substr(0, std::min(quote, text.size()));
      const std::size_t line = first ? (quote == npos ? lineBreak : npos) : plain.substr(at_).rfind('\n');
      if (line != npos) {
        after_ = first ? line + 1 : at_ + line + 1;
        if (first) {
          at_ = after_;
          return line;
        }
      }
      at_ = plain.size();
      if (quote == npos) break;
      quoted_ = quote == after_ || format_.separates(text[quote - 1]);
      ++at_;
    }
    return npos;
  }

  CsvFormat format_;
  std::size_t at_ = 0, after_ = 0;
  bool quoted_ = false;
};

}  // namespace viewproj::cmd
