// Records with their results, in any output form. One file a form: json_writer, csv_writer, text_writer.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "input/record.hpp"
#include "stream/form.hpp"

namespace viewproj::cmd {

/// Receives the results of a record by name. A number that is not finite has no value: null, an empty cell, or NaN.
class ResultSink {
 public:
  virtual ~ResultSink() = default;
  virtual void number(std::string_view name, double value) = 0;
  /// Two to four numbers; null as a whole if one of them is not finite.
  virtual void vector(std::string_view name, std::span<const double> values) = 0;
  virtual void flag(std::string_view name, bool value) = 0;
  /// always: false leaves an empty list out where the form can.
  virtual void names(std::string_view name, std::span<const std::string_view> values, bool always) = 0;

  /// Every record gets the same results, with or without a value.
  virtual bool hasFixedColumns() const { return false; }
  /// Numbers only, without names.
  virtual bool isText() const { return false; }
};

/// A record's own fields come first, then by calls of the ResultSink its results.
class RecordWriter : public ResultSink {
 public:
  virtual void beginArray() {}
  virtual void endArray() {}

  /// CSV in: the first line of the input, before its first record.
  virtual void header(const CsvHeader&, std::string_view /*line*/) {}

  /// Throws RecordError where the record has a field of a result's name.
  virtual void beginRecord(const Record& record) = 0;
  virtual void endRecord() = 0;
  /// Takes back what beginRecord and the results wrote.
  virtual void cancelRecord() = 0;

  /// After the last record.
  virtual void finish() {}

  /// --keep-going: what stands in place of a bad record.
  virtual void badRecord(std::string_view text, std::size_t line, const std::string& message) = 0;
};

struct WriterSetup {
  /// Names of the numbers that a bare JSON array or a text line holds: the array's, and that of a number behind it.
  std::string arrayName;
  std::size_t arraySize = 0;  ///< how many numbers of a text line are the array's; 0: all
  std::string extraName;
  std::string prefix;  ///< in front of every result's name
  bool keepGoing = false;
  std::function<void(ResultSink&)> exampleResults;  ///< calls the sink as for a record, so that columns are known
};

std::unique_ptr<RecordWriter> makeJsonWriter(bool asArray, WriterSetup setup, std::string& out);
std::unique_ptr<RecordWriter> makeCsvWriter(WriterSetup setup, std::string& out);
std::unique_ptr<RecordWriter> makeTextWriter(WriterSetup setup, std::string& out);

/// A field of a record under the name and with the JSON text it has when the record is written as a JSON object.
struct NamedJson {
  std::string name;
  std::string json;
};

/// The fields of a record that was not read as a JSON object.
std::vector<NamedJson> asJsonFields(const Record& record, const WriterSetup& setup);

/// Appends text as a JSON string.
void appendJsonString(std::string& out, std::string_view text);

}  // namespace viewproj::cmd
