// Records with their results, in any output form. json_writer, csv_writer, text_writer (text and f64).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "output/results.hpp"
#include "records/record.hpp"
#include "text/form.hpp"
#include "text/text_buffer.hpp"

namespace viewproj::cmd {

struct WriterSetup {
  /// Names of the numbers that a bare JSON array or a text line holds: the array's, and that of a number after it.
  std::string arrayName;
  std::size_t arraySize = 0;  ///< how many numbers without names are the array's; 0: all
  std::string extraName;
  std::vector<std::string> numberNames;  ///< instead: of each number by itself; those after it are column4, ...
  std::string prefix;                    ///< in front of every result's name
  bool keepGoing = false;
  bool keepArrays = false;  ///< an array in the input is one in the output
  bool header = true;       ///< CSV: write one
  int digits = 0;           ///< significant, of results; 0: all, in tables nine
  char separator = ',';     ///< of CSV
  bool table = false;       ///< CSV for an aligned table: results to nine digits, vectors in one cell
  Results results;          ///< of a record, unless it has others: in text and f64 those of all
};

/// Where a block's text lies in the arrays of the output.
struct ArrayFrame {
  // The text begins with what goes on with the array that stood open before the block.
  std::size_t size = 0, records = 0;
  // An array stands open at the text's end: what closes it, and how many of its records are in the block.
  std::string closing;
  std::size_t open = 0;
};

/// A record's own fields come first, then by calls of the ResultSink its results. Each worker has a writer of its own.
class RecordWriter : public ResultSink {
 public:
  explicit RecordWriter(TextBuffer& out) : out_(out) {}

  /// closing: of the array that stands open, or empty.
  virtual void beginBlock(std::string_view /*closing*/) { records_ = 0; }
  virtual ArrayFrame endBlock() { return {}; }
  std::size_t records() const { return records_; }

  /// An array or a document, as written: `[` or `{"points": [`, and `]` with what follows it. Nothing: the shortest
  /// end.
  virtual void beginArray(std::string_view /*asWritten*/) {}
  virtual void endArray(std::string_view /*asWritten*/) {}

  /// results: those that the record gets. Throws RecordError where it has no place among the others.
  virtual void beginRecord(const Record& record, const Results& results) = 0;
  virtual void endRecord() = 0;
  /// Takes back what beginRecord and the results wrote.
  virtual void cancelRecord() { out_.truncate(start_); }

  void object(const ResultRow& row, std::size_t /*count*/, const WriteParts& write) override {
    if (row.kind == ResultKind::group) write(*this, 0);
  }

  /// --keep-going: what stands in place of a bad record.
  virtual void badRecord(std::string_view text, std::size_t line, const std::string& message) = 0;

 protected:
  TextBuffer& out_;
  std::size_t records_ = 0, start_ = 0;  ///< start: of the record in out_
};

/// The columns of CSV, which all workers share. Of records that are not CSV they are the first good record's: until it
/// has come, only one worker may write.
struct CsvColumns {
  bool known = false, fromCsv = false;
  std::vector<std::string> own;
  Results results;
  char separator = ',';  ///< of the input, where it is CSV
  std::string early;     ///< rows of bad records before the first good one
};

/// The columns of input in CSV. Throws RecordError where two have the same name. Appends the header line to out.
CsvColumns csvColumns(const WriterSetup& setup, const CsvHeader& header, std::string_view line, char separator,
                      const Results& results, TextBuffer& out);

/// The header, and the rows of the bad records, where there was no good one.
std::string headerOfBadRecords(const WriterSetup& setup, const CsvColumns& columns);

std::unique_ptr<RecordWriter> makeJsonWriter(const WriterSetup& setup, TextBuffer& out);
std::unique_ptr<RecordWriter> makeCsvWriter(const WriterSetup& setup, CsvColumns& columns, TextBuffer& out);
std::unique_ptr<RecordWriter> makeTextWriter(const WriterSetup& setup, TextBuffer& out);
std::unique_ptr<RecordWriter> makeBinaryWriter(const WriterSetup& setup, TextBuffer& out);

/// A field of a record under the name and with the JSON text it has when the record is written as a JSON object.
struct NamedJson {
  std::string name;
  std::string json;
};

/// The fields of a record that was read neither as a JSON object nor as CSV.
std::vector<NamedJson> asJsonFields(const Record& record, const WriterSetup& setup);

/// What --keep-going calls what is wrong with a record.
inline constexpr std::string_view kErrorName = "error";

}  // namespace viewproj::cmd
