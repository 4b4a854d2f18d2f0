// Records with their results, in any output form. json_writer, csv_writer, text_writer (text and f64).
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "input/record.hpp"
#include "output/spilled_texts.hpp"
#include "text/form.hpp"
#include "text/text_buffer.hpp"
#include "viewproj/vectors.hpp"

namespace viewproj::cmd {

/// Receives the results of a record by name. A number that is not finite has no value: null, an empty cell, or NaN.
/// Names must be literals: they are told apart by their address.
class ResultSink {
 public:
  virtual ~ResultSink() = default;
  virtual void number(std::string_view name, double value) = 0;
  /// Two to four numbers; null as a whole if one of them is not finite.
  virtual void vector(std::string_view name, std::span<const double> values) = 0;
  void vector(std::string_view name, const Vec2& v) { vector(name, std::array{v.x, v.y}); }
  void vector(std::string_view name, const Vec3& v) { vector(name, std::array{v.x, v.y, v.z}); }
  void vector(std::string_view name, const Vec4& v) { vector(name, std::array{v.x, v.y, v.z, v.w}); }
  virtual void flag(std::string_view name, bool value) = 0;
  /// always: false leaves an empty list out where the form can.
  virtual void names(std::string_view name, std::span<const std::string_view> values, bool always) = 0;
  /// A word, or none. Forms of numbers alone leave words out.
  virtual void word(std::string_view name, std::string_view value) = 0;
  /// A value as JSON text. Forms of numbers alone leave it out.
  virtual void json(std::string_view name, std::string_view value) = 0;
  /// Results that belong together: an object, or columns NAME_...; null as a whole if not present (in CSV and text by
  /// empty cells, as many as `write` makes of values without a number).
  virtual void group(std::string_view name, bool present, const std::function<void(ResultSink&)>& write) = 0;
  /// A list of objects. Forms without lists throw UsageError.
  virtual void list(std::string_view name, std::size_t count,
                    const std::function<void(ResultSink&, std::size_t)>& write) = 0;

  /// Every record gets the same results, with or without a value.
  virtual bool hasFixedColumns() const { return false; }
  /// Numbers only, without names.
  virtual bool isText() const { return false; }
};

/// Collects the names of results, as JSON has them.
class NameCollector final : public ResultSink {
 public:
  explicit NameCollector(std::string prefix) : prefix_(std::move(prefix)) {}
  void number(std::string_view name, double) override { add(name); }
  void vector(std::string_view name, std::span<const double>) override { add(name); }
  void flag(std::string_view name, bool) override { add(name); }
  void names(std::string_view name, std::span<const std::string_view>, bool) override { add(name); }
  void word(std::string_view name, std::string_view) override { add(name); }
  void json(std::string_view name, std::string_view) override { add(name); }
  void group(std::string_view name, bool, const std::function<void(ResultSink&)>&) override { add(name); }
  void list(std::string_view name, std::size_t, const std::function<void(ResultSink&, std::size_t)>&) override {
    add(name);
  }

  std::vector<std::string> found;

 private:
  void add(std::string_view name) { found.push_back(prefix_ + std::string(name)); }
  std::string prefix_;
};

struct WriterSetup {
  /// Names of the numbers that a bare JSON array or a text line holds: the array's, and that of a number behind it.
  std::string arrayName;
  std::size_t arraySize = 0;  ///< how many numbers of a text line are the array's; 0: all
  std::string extraName;
  std::string prefix;  ///< in front of every result's name
  bool keepGoing = false;
  bool keepArrays = false;  ///< an array in the input is one in the output
  bool header = true;       ///< CSV: write one
  bool table = false;       ///< CSV for an aligned table: results to nine digits, vectors in one cell
  std::function<void(ResultSink&)> exampleResults;  ///< calls the sink as for a record, so that columns are known
};

/// A record's own fields come first, then by calls of the ResultSink its results. Each worker has a writer of its own.
class RecordWriter : public ResultSink {
 public:
  explicit RecordWriter(TextBuffer& out) : out_(out) {}

  /// joined: records are to be separated, not ended, by what stands between them.
  void beginBlock(bool joined) {
    joined_ = joined;
    records_ = 0;
  }
  std::size_t records() const { return records_; }

  /// An array or a document that begins and ends in a block, as written: `[` or `{"points": [`, and `]` with what
  /// follows it. Nothing: the shortest end.
  virtual void beginArray(std::string_view /*asWritten*/) {}
  virtual void endArray(std::string_view /*asWritten*/ = {}) {}

  virtual void beginRecord(const Record& record) = 0;
  virtual void endRecord() = 0;
  /// Takes back what beginRecord and the results wrote.
  virtual void cancelRecord() = 0;

  /// --keep-going: what stands in place of a bad record.
  virtual void badRecord(std::string_view text, std::size_t line, const std::string& message) = 0;

 protected:
  TextBuffer& out_;
  bool joined_ = false;
  std::size_t records_ = 0;
};

/// The columns of CSV, which all workers share. Those of records that were not CSV are the first record's; until they
/// are known, only one worker may write.
struct CsvColumns {
  std::vector<std::string> own, results;
  bool known = false, fromCsv = false;
  bool headerIsDue = false;  ///< the columns have just become known
  SpilledTexts early;        ///< messages of bad records before the first good one
};

/// Throws RecordError where columns have the same name. Appends the header line to out, if there is one to be.
CsvColumns csvColumns(const WriterSetup& setup, const CsvHeader* input, std::string_view line, TextBuffer& out);

/// The last of the results' columns, without a prefix.
std::string lastResultColumn(const WriterSetup& setup);

/// The header of columns that were a record's, and the bad records that came before it; also after the last record,
/// where there were bad ones alone.
void writeDueHeader(CsvColumns& columns, const WriterSetup& setup, const std::function<void(std::string_view)>& write);

std::unique_ptr<RecordWriter> makeJsonWriter(const WriterSetup& setup, TextBuffer& out);
std::unique_ptr<RecordWriter> makeCsvWriter(const WriterSetup& setup, CsvColumns& columns, TextBuffer& out);
std::unique_ptr<RecordWriter> makeTextWriter(const WriterSetup& setup, TextBuffer& out);
std::unique_ptr<RecordWriter> makeBinaryWriter(const WriterSetup& setup, TextBuffer& out);

/// A field of a record under the name and with the JSON text it has when the record is written as a JSON object.
struct NamedJson {
  std::string name;
  std::string json;
};

/// The fields of a record that was not read as a JSON object.
std::vector<NamedJson> asJsonFields(const Record& record, const WriterSetup& setup);

/// Text as a JSON string. Throws RecordError where it is not UTF-8.
std::string jsonString(std::string_view text);

}  // namespace viewproj::cmd
