// How CSV is written: what separates its columns, what marks decimals, what begins a line that is none.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace viewproj::cmd {

struct CsvFormat {
  static constexpr char kBlanks = ' ';  ///< any run of blanks and tabs is one separator

  char separator = ',';
  char decimal = '.';
  char comment = 0;  ///< 0: no line is a comment

  bool isBlanks() const { return separator == kBlanks; }
  bool separates(char c) const { return c == separator || (isBlanks() && c == '\t'); }
  bool isComment(std::string_view line) const { return comment != 0 && line.starts_with(comment); }
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
                                                {"blank", "blanks", CsvFormat::kBlanks},
                                                {"bar", "bars", '|'}};
std::string_view nameOfSeparator(char separator);

/// As a column of the output: in quotes where it has a separator, a quote or a line break, or would be passed over.
std::string quotedIfNeeded(std::string_view cell, const CsvFormat& format = {});

/// A number whose decimals follow a point or a comma.
std::optional<double> parseDecimal(std::string_view text, char decimal);

/// A number as it stands elsewhere with this mark of decimals, if it was written with a point.
std::string withDecimal(std::string_view number, char decimal);

}  // namespace viewproj::cmd
