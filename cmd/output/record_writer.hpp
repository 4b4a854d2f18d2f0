// Records with their results, in any output form. json_writer, csv_writer, text_writer (text and f64).
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "output/results.hpp"
#include "output/spilled_texts.hpp"
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
  CsvFormat csv = {};       ///< of CSV; of text its decimals
  bool table = false;       ///< CSV for an aligned table: results to nine digits, vectors in one cell
  Results results;          ///< of a record, where all records get the same: not in JSON
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
  std::optional<std::size_t> marks =
      {};                 ///< the own column in which an earlier run said what was bad; this one does too
  CsvFormat format = {};  ///< of the input, where it was CSV
  bool known = false, fromCsv = false;
  bool headerIsDue = false;  ///< the columns have just become known
  SpilledTexts early;        ///< messages of bad records before the first good one
};

/// Throws RecordError where columns have the same name. Appends the header line to out, if there is one to be.
CsvColumns csvColumns(const WriterSetup& setup, const CsvHeader* input, std::string_view line, const CsvFormat& format,
                      TextBuffer& out);

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
