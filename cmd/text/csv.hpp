// Records of CSV (RFC 4180). A quote opens a quoted field only at the field's beginning; two quotes in a quoted field
// are one character of the field.
#pragma once

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

/// The separator of a first line: the first of tab, semicolon and comma that occurs outside of quotes.
char separatorOf(std::string_view line);

/// A record of CSV. Its fields are as written, with their quotes.
struct CsvRecord {
  std::vector<std::string_view> fields;
  std::vector<double> numbers;  ///< of the fields, where the scan has read them; kNoNumber of others
  std::size_t end = 0;          ///< the offset of its line break, or the text's size
  std::string fault = {};       ///< what is wrong with it; empty if nothing is
  std::size_t faultAt = 0;      ///< and where
  bool isOpen = false;          ///< the text ends inside of quotes

  /// Splits the record at the beginning of a text. Of more than `most` fields it keeps one more.
  void split(std::string_view text, char separator, std::size_t most = SIZE_MAX);
  /// The same of a record that should have so many fields. It ends with its first line if something is wrong with it:
  /// a quote that is missing takes no other line.
  void splitSome(std::string_view text, char separator, std::size_t size, std::size_t most);
};

/// Whether a cell contains a separator, a quote or a line break.
bool needsQuotes(std::string_view cell, char separator);

/// A cell of the output. It is quoted if it contains a separator, a quote or a line break.
std::string quotedIfNeeded(std::string_view cell, char separator = ',');

/// A field without its quotes.
std::string csvValue(std::string_view field);

/// A field of a broken record as a cell: one that is not whole keeps its bytes, in quotes.
std::string wholeCell(std::string_view field, char separator);

inline constexpr const char* kLoneReturn =
    "a carriage return without a line feed; expected LF or CRLF, for example from tr '\\r' '\\n'";

}  // namespace viewproj::cmd
