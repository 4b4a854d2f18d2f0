// One record of a stream: its text, and its fields by name.
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

/// The field of an object that holds an array of records. It must be the first one.
inline constexpr std::string_view kRecordsField = "points";

/// Bytes of an f64 record: three little-endian doubles.
inline constexpr std::size_t kBinaryRecord = 24;

/// A record with more fields is an error.
inline constexpr std::size_t kMostFields = 1 << 20;

/// What similar records have in common: the names of their fields, in order.
struct Shape {
  Form form = Form::json;
  bool isArray = false;            ///< a JSON array, a line of text, or doubles: fields have no names
  std::size_t size = 0;            ///< number of fields
  std::vector<std::string> names;  ///< escapes resolved; empty if isArray
  bool hasHeader = true;           ///< CSV: the names come from the file
  char separator = ',';            ///< CSV only

  std::optional<std::size_t> find(std::string_view name) const;
};

/// The index of the first item whose name an earlier item has.
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

/// A record whose shape is known.
struct Record {
  std::string_view text;
  const Shape* shape = nullptr;
};

/// A record split into fields. A value is JSON text in a JSON record, and the field with its quotes in CSV.
struct RecordParts {
  std::string_view text;
  Shape shape;
  std::vector<std::string_view> values;

  /// The offset of a value in the text.
  std::size_t offset(std::size_t field) const;
};

/// The column names of a CSV stream.
struct CsvHeader {
  std::vector<std::string> names;
  bool present = false;  ///< false: the first line is data, and the columns have default names
};

inline constexpr const char* kNoRecord = "expected a record: an array of numbers or an object";

/// These throw RecordError at the wrong byte.
RecordParts jsonParts(std::string_view text);
RecordParts textParts(std::string_view text);
RecordParts csvParts(std::string_view text, const Shape& header);

/// The values of a record whose shape is known.
std::vector<std::string_view> valuesOf(const Record& record);

/// The doubles of an f64 record.
std::vector<double> binaryNumbers(std::string_view bytes);

/// "; the header is 'E,N,U'", or for JSON its fields; shortened if long.
std::string fieldsNote(const Shape& shape);

/// Reads a line as a header if it has a field that is not a number. Otherwise the columns get the default names in
/// order, then column1, ... numbered: columns, counted from 1, that decide instead: in a header none of them is a
/// number and one is a word. A blank name in a header becomes the column's number.
CsvHeader readCsvHeader(std::string_view line, const std::vector<std::string>& defaults,
                        const std::vector<std::size_t>& numbered = {}, char separator = ',');

/// The name for a column without one.
std::string nameOfColumn(const std::vector<std::string>& names, std::size_t column);

}  // namespace viewproj::cmd
