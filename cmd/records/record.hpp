// One record of a stream as written: its text, and its fields by name.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "text/csv.hpp"
#include "text/form.hpp"
#include "text/json_text.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {

/// Of an object that holds records: its first field, an array.
inline constexpr std::string_view kRecordsField = "points";

/// Bytes of a record of f64: three little-endian doubles.
inline constexpr std::size_t kBinaryRecord = 24;

/// A record of more fields is an error.
inline constexpr std::size_t kMostFields = 1 << 20;

/// What records that look alike have in common: the names of their fields, in order.
struct Shape {
  Form form = Form::json;
  bool isArray = false;            ///< a JSON array, a line of text, doubles: fields have no names
  std::size_t size = 0;            ///< how many fields
  std::vector<std::string> names;  ///< escapes resolved; empty if isArray
  bool hasHeader = true;           ///< CSV: the names are the file's own
  char separator = ',';            ///< of CSV

  std::optional<std::size_t> find(std::string_view name) const;
};

/// The first of these whose name stood before.
template <class T, class NameOf>
std::optional<std::size_t> firstRepeated(const std::vector<T>& all, const NameOf& nameOf) {
  constexpr std::size_t kFew = 32;
  std::unordered_set<std::string_view> seen;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::string_view name = nameOf(all[i]);
    if (all.size() > kFew) {
      if (!seen.insert(name).second) return i;
    } else {
      for (std::size_t j = 0; j < i; ++j)
        if (nameOf(all[j]) == name) return i;
    }
  }
  return std::nullopt;
}

/// A record that has been found to be of a shape.
struct Record {
  std::string_view text;
  const Shape* shape = nullptr;
};

/// A record taken apart. A value is JSON text in a JSON record and the field as written, quotes and all, in CSV.
struct RecordParts {
  std::string_view text;
  Shape shape;
  std::vector<std::string_view> values;

  /// Of a value in the text.
  std::size_t offset(std::size_t field) const;
};

/// The column names of a CSV stream.
struct CsvHeader {
  std::vector<std::string> names;
  bool present = false;  ///< false: the first line was data already, and the columns have the default names
};

inline constexpr const char* kNoRecord = "expected a record: an array of numbers or an object";

/// Throw RecordError at the byte that is wrong.
RecordParts jsonParts(std::string_view text);
RecordParts textParts(std::string_view text);
RecordParts csvParts(std::string_view text, const Shape& header);

/// The values of a record, which is known to be of its shape.
std::vector<std::string_view> valuesOf(const Record& record);

/// The doubles of a record of f64.
std::vector<double> binaryNumbers(std::string_view bytes);

/// "; the header is 'E,N,U'", or for JSON its fields, as far as they go.
std::string whatIsThere(const Shape& shape);

/// A header if the line has a field that is not a number; otherwise the default names in order, where there are any,
/// and column1, ... for the others. numbered: columns, from 1, of which none is a number in a header, and
/// one a word, whatever others hold. A column that the header leaves blank is called by its number.
CsvHeader readCsvHeader(std::string_view line, const std::vector<std::string>& defaults,
                        const std::vector<std::size_t>& numbered = {}, char separator = ',');

/// The name of a column without one.
std::string nameOfColumn(const std::vector<std::string>& names, std::size_t column);

}  // namespace viewproj::cmd
