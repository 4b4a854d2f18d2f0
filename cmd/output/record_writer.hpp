// Records with their results, in any output form: json_writer, csv_writer, numbers_writer (text and f64).
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "output/output_file.hpp"
#include "output/results.hpp"
#include "records/columns.hpp"
#include "records/record.hpp"
#include "text/form.hpp"
#include "text/text_buffer.hpp"

namespace viewproj::cmd {

/// A record from the command line: its option, and the record as JSON.
struct GivenRecord {
  std::string option;
  std::string json;
};

/// How a stream of records is read and written.
struct StreamSetup {
  // Reading.
  std::string file = "-";
  std::vector<GivenRecord> given;        ///< read instead of a file
  std::optional<Form> from;              ///< empty: by its name and first bytes
  std::optional<char> delimiter;         ///< separator of CSV; empty: found in the first line
  std::optional<std::size_t> width;      ///< numbers of a binary record; empty: 3
  ColumnChoice columns;                  ///< --columns
  std::vector<std::string> csvDefaults;  ///< column names of CSV without a header
  bool keepGoing = false;
  unsigned jobs = 0;  ///< threads; 0: one per processor
  std::size_t blockSize = 64 << 10;
  std::function<void(const std::string&)> note = [](const std::string&) {};  ///< about options without effect
  /// With several jobs, called in the catch block of a worker that fails; see PipelineSetup.
  void (*failed)() = endWithException;

  // Writing.
  std::optional<OutputForm> to;  ///< empty: like the input
  bool areWords = false;         ///< the results are words alone: text and binary input gives JSON
  bool header = true;            ///< CSV: write one
  int digits = 0;                ///< significant, of results; 0: all, in tables nine
  std::string prefix;            ///< in front of every result's name
  bool namesCameras = false;     ///< the camera's name comes before the results
  bool visibleOnly = false;      ///< what is not visible is left out
  /// Names of the numbers that a bare JSON array, a text line or a binary record holds: the array's, and that of a
  /// number after it.
  std::string arrayName;
  std::size_t arraySize = 0;  ///< how many numbers without names are the array's; 0: all
  std::string extraName;
  std::vector<std::string> numberNames;  ///< instead: of each number by itself; those after it are column4, ...
};

/// How the writers of a stream write, settled by its input.
struct WriterSetup {
  const StreamSetup& stream;
  OutputForm form = OutputForm::lines;
  bool keepArrays = false;  ///< an array in the input is one in the output
  char separator = ',';     ///< of CSV
  ResultRows rows = {};     ///< of a record, unless it has others: in text and f64 those of all
};

/// What a block begins with in the array that is open before it. Only the output in order knows whether a record of the
/// array was written before, and so what to write between the two.
enum class BlockJoint : unsigned char { none, record, end };

/// A record's own fields come first, then its results. Each worker has a writer of its own.
class RecordWriter {
 public:
  explicit RecordWriter(TextBuffer& out) : out_(out) {}
  virtual ~RecordWriter() = default;

  /// closing: of the array that is open where the block begins, or empty.
  virtual void beginBlock(std::string_view /*closing*/) {}
  /// The text that closes the array that is open now, or empty.
  virtual std::string_view closing() const { return ""; }
  virtual BlockJoint joint() const { return BlockJoint::none; }
  /// An array or a document, as written: `[` or `{"points": [`, and `]` with what follows it. Nothing: the shortest
  /// end.
  virtual void beginArray(std::string_view /*asWritten*/) {}
  virtual void endArray(std::string_view /*asWritten*/) {}

  /// Throws RecordError, and writes nothing, if the record has no place among the others.
  void write(const RecordView& record, const ResultRows& rows, const ResultValues& values);
  /// --keep-going: what is written in place of a bad record. values: of a row of CSV, as far as it could be split.
  virtual void writeBad(std::span<const std::string_view> values, std::size_t line, const std::string& message) = 0;
  /// --keep-going: a record that says itself what is wrong with it, in its field `error`.
  virtual void writeError(const RecordView& record, std::size_t line, std::size_t error) = 0;

 protected:
  virtual void append(const RecordView& record, const ResultRows& rows, ResultCursor values) = 0;

  TextBuffer& out_;
};

/// The columns of CSV, which all workers share. Of records that are not CSV they are those of the first good record:
/// until it has come, only one worker may write.
struct CsvColumns {
  bool known = false, fromCsv = false;
  std::vector<std::string> own = {};
  ResultRows rows = {};
  std::vector<std::string> added = {};    ///< of the results, and the one for errors unless it is the record's own
  std::optional<std::size_t> error = {};  ///< the own column for errors
};

/// The columns of input in CSV. line: its header as it is written. Throws RecordError if two have the same name.
/// Appends the header line to out.
CsvColumns csvColumns(const WriterSetup& setup, const CsvHeader& header, std::string_view line, const ResultRows& rows,
                      TextBuffer& out);

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
std::vector<NamedJson> asJsonFields(const RecordView& record, const StreamSetup& setup);

/// The text of a CSV cell or a JSON value: a string without its quotes.
std::string plainText(const RecordView& record, std::size_t field);

}  // namespace viewproj::cmd
