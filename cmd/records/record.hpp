// One record of a stream: its text, and its fields as they are written.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "text/form.hpp"

namespace viewproj::cmd {

/// The field of an object that holds an array of records. It must be the first one.
inline constexpr std::string_view kRecordsField = "points";

/// What --keep-going calls what is wrong with a record.
inline constexpr std::string_view kErrorName = "error";

/// A record with more fields is an error.
inline constexpr std::size_t kMostFields = 1 << 20;

/// A longer record, in any format, is an error.
inline constexpr std::size_t kLongestRecord = 64 << 20;

/// What records that are read alike have in common: the names of their fields, in order.
struct Schema {
  Form form = Form::json;
  bool isArray = false;            ///< a JSON array, a line of text, or binary numbers: fields have no names
  std::size_t size = 0;            ///< number of fields
  std::vector<std::string> names;  ///< escapes resolved; empty if isArray
  bool hasHeader = true;           ///< CSV: the names come from the file
  char separator = ',';            ///< CSV only

  std::optional<std::size_t> find(std::string_view name) const;
};

/// Two or three numbers that are a JSON value, [x, y, z] or {"x": X, "y": Y, "z": Z}, as the scan has read them.
struct ScannedPoint {
  std::size_t field = 0;
  std::size_t count = 0;
  bool isObject = false;
  std::array<double, 3> numbers = {};
};

/// Passes such a value; null for others.
const char* passPoint(const char* at, const char* end, ScannedPoint& point);

/// A record as it is written: a value is JSON text, or the field of CSV with its quotes. Binary records have none.
struct RecordView {
  std::string_view text;
  const Schema* schema = nullptr;
  std::span<const std::string_view> values;
  std::span<const double> numbers = {};  ///< of the values, where the scan has read them; kNoNumber of others
  std::span<const ScannedPoint> points = {};

  /// The offset of a value in the text.
  std::size_t offset(std::size_t field) const { return static_cast<std::size_t>(values[field].data() - text.data()); }
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

inline constexpr const char* kNoRecord = "expected a record: an array of numbers or an object";

/// A JSON record in one scan: the text of its keys, without their quotes, and of its values.
class JsonFields {
 public:
  std::vector<std::string_view> keys, values;
  std::vector<double> numbers;  ///< of the values with a fraction or exponent; kNoNumber for others
  std::vector<ScannedPoint> points;
  bool isArray = false;

  /// Splits the record at the beginning of a text. Returns its size; 0 if it is not valid JSON. `anywhere`: also if it
  /// is a record only in some places, as what begins like an array of records or a document of them.
  std::size_t split(std::string_view text, bool anywhere);
  /// Splits a record that is the whole text. Throws RecordError at the wrong byte.
  void splitWhole(std::string_view text);
  /// Throws RecordError if two keys are the same.
  Schema schema(std::string_view text) const;
};

/// The words of a line. Throws RecordError.
void splitText(std::string_view line, std::vector<std::string_view>& words);

/// Throws RecordError at the first value over the limit.
void requireFewFields(std::string_view text, std::span<const std::string_view> values);

/// The numbers of a binary record.
std::vector<double> binaryNumbers(Form form, std::string_view bytes);
/// Bytes of one of them.
inline std::size_t bytesOf(Form form) { return form == Form::f32 ? sizeof(float) : sizeof(double); }

/// "; the header is 'E,N,U'", or for JSON its fields; shortened if long.
std::string fieldsNote(const Schema& schema);

/// The column names of a CSV stream.
struct CsvHeader {
  std::vector<std::string> names;
  bool present = false;  ///< false: the first line is data, and the columns have default names
};

/// Reads a line as a header if it has a field that is not a number. Otherwise the columns get the default names in
/// order, then column1, ... numbered: columns, counted from 1, that decide instead: in a header none of them is a
/// number and one is a word. A blank name in a header becomes the column's number.
CsvHeader readCsvHeader(std::span<const std::string_view> fields, const std::vector<std::string>& defaults,
                        const std::vector<std::size_t>& numbered = {});

/// The name for a column without one.
std::string nameOfColumn(const std::vector<std::string>& names, std::size_t column);

}  // namespace viewproj::cmd
