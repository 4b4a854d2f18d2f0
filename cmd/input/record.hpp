// One record of a stream: its text, and its fields by name.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "input/json_text.hpp"
#include "stream/form.hpp"

namespace viewproj::cmd {

/// A named part of a record. value is JSON text in a JSON record and the field as written, quotes and all, in CSV.
struct Field {
  std::string name;
  std::string_view value;
  std::size_t offset = 0;  ///< of value in the record's text
};

struct Record {
  Form form = Form::json;
  std::string_view text;
  TextPosition position;
  bool isArray = false;  ///< JSON: [x, y, z]; its fields have no names
  std::vector<Field> fields;

  const Field* find(std::string_view name) const;
};

/// The column names of a CSV stream.
struct CsvHeader {
  std::vector<std::string> names;
  bool present = false;  ///< false: the first line was data already, and the columns have the default names
};

/// Throws RecordError at the byte that is wrong.
Record parseJsonRecord(std::string_view text, TextPosition position);
Record parseTextRecord(std::string_view text, TextPosition position);
Record parseCsvRecord(std::string_view text, TextPosition position, const CsvHeader& header);

/// The fields of a CSV line as written.
std::vector<std::string_view> splitCsvLine(std::string_view text);

/// A CSV field without its quotes.
std::string csvValue(std::string_view field);

/// A header if the line has a field that is not a number; otherwise the default names in order.
CsvHeader readCsvHeader(std::string_view line, const std::vector<std::string>& defaults);

/// The number of a field; throws RecordError.
double numberOf(const Field& field, Form form);

/// The numbers of a JSON array of numbers; throws RecordError unless there are fewest to most of them.
std::vector<double> numbersOf(const Field& field, std::size_t fewest, std::size_t most);

/// A JSON null or an empty CSV field.
bool isAbsent(const Field& field, Form form);

}  // namespace viewproj::cmd
