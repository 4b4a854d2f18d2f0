// What separates the columns of CSV.
#pragma once

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

}  // namespace viewproj::cmd
