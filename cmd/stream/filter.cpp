#include "stream/filter.hpp"

#include <algorithm>
#include <functional>

#include "output/results.hpp"
#include "stream/pipeline.hpp"
#include "text/system.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

/// What the workers of a stream share.
struct Stream {
  const FilterSetup& setup;
  const MakeWork& makeWork;
  Form form = Form::json;
  char separator = ',';  ///< of the input, where it is CSV
  OutputForm to = OutputForm::lines;
  bool writes = true;
  Shape header = {};
  BatchSetup batch = {};
  CsvColumns columns = {};
};

std::unique_ptr<RecordReader> makeReader(const Stream& stream) {
  switch (stream.form) {
    case Form::csv:
      return makeCsvReader(stream.header);
    case Form::text:
      return makeTextReader();
    case Form::f64:
      return makeBinaryReader();
    case Form::json:
      break;
  }
  return makeJsonReader();
}

std::unique_ptr<RecordWriter> makeWriter(Stream& stream, TextBuffer& out) {
  const WriterSetup& setup = stream.setup.writer;
  switch (stream.to) {
    case OutputForm::csv:
    case OutputForm::table:
      return makeCsvWriter(setup, stream.columns, out);
    case OutputForm::text:
      return makeTextWriter(setup, out);
    case OutputForm::f64:
      return makeBinaryWriter(setup, out);
    case OutputForm::lines:
    case OutputForm::array:
      break;
  }
  return makeJsonWriter(setup, out);
}

class RecordWorker final : public BlockWorker {
 public:
  RecordWorker(Stream& stream, BlockResult& result)
      : stream_(stream),
        work_(stream.makeWork()),
        reader_(makeReader(stream)),
        writer_(stream.writes ? makeWriter(stream, result.out) : nullptr),
        batch_(stream.batch, *work_, writer_.get(), result) {}

  void work(const Block& block, BlockResult& result) override {
    result.out.clear();
    result.records = 0;
    result.passedOver.clear();
    result.notes.clear();
    result.fault.reset();
    if (writer_) writer_->beginBlock(closingOf(block));
    batch_.begin(block);
    try {
      reader_->read(block, batch_);
      batch_.flush();
    } catch (const Batch::StopBlock&) {
    }
    if (!writer_) return;
    result.frame = writer_->endBlock();
    result.records += writer_->records();
  }

 private:
  /// Of the array that stands open in the output where the block begins.
  std::string_view closingOf(const Block& block) const {
    if (stream_.to == OutputForm::array) return "]";
    if (!stream_.setup.writer.keepArrays || !block.state.insideArray()) return "";
    return block.state.inDocument ? "]}" : "]";
  }

  Stream& stream_;
  std::unique_ptr<RecordWork> work_;
  std::unique_ptr<RecordReader> reader_;
  std::unique_ptr<RecordWriter> writer_;
  Batch batch_;
};

/// What separates the columns of the first line: of tab, semicolon and comma the first that it has outside of quotes.
char separatorOf(std::string_view line) {
  bool isQuoted = false, hasSemicolon = false;
  for (const char c : line) {
    isQuoted ^= c == '"';
    if (c == '\t' && !isQuoted) return c;
    hasSemicolon |= c == ';' && !isQuoted;
  }
  return hasSemicolon ? ';' : ',';
}

/// The first line that is none of blanks and no comment of text, as far as it tells the form.
std::string_view firstLineOf(BlockReader& reader) {
  std::string_view start = reader.firstBytes();
  if (start.starts_with("\xEF\xBB\xBF")) start.remove_prefix(3);
  start = afterComments(start);
  return start.substr(0, start.find('\n'));
}

Form formOfContent(const Stream& stream, BlockReader& reader) {
  const std::string_view start = reader.firstBytes();
  requireNarrow(reader.name(), start);
  if (const auto form = formOfBytes(start)) return *form == Form::text && stream.setup.delimiter ? Form::csv : *form;
  throw InputError(reader.name() + ": is binary; expected JSON, CSV or text, or --from f64 for little-endian doubles");
}

Form formOfInput(const Stream& stream, BlockReader& reader) {
  const FilterSetup& setup = stream.setup;
  if (!setup.given.empty()) return Form::json;
  const auto named = setup.from ? setup.from : formOfName(setup.file);
  const Form form = named ? *named : formOfContent(stream, reader);
  if (form == Form::f64 && setup.columns.given())
    throw UsageError("--columns " + setup.columns.text +
                     ": f64 has no columns; a record is three doubles, x, y, z, or of a pixel x, y, depth");
  if (form == Form::text) setup.columns.requireNoNames("lines of text");
  return form;
}

/// Results of words alone turn text and f64 into JSON.
OutputForm formOfOutput(const FilterSetup& setup, const RecordWork& work, Form form) {
  if (setup.to) return *setup.to;
  const OutputForm same = sameForm(form);
  if (same != OutputForm::text && same != OutputForm::f64) return same;
  const Results results = work.results({}, same);
  const bool numbers =
      std::any_of(results.begin(), results.end(), [](const ResultRow* row) { return row->kind != ResultKind::word; });
  return numbers || results.empty() ? same : OutputForm::lines;
}

/// How CSV is written, in and out.
void settleFormat(Stream& stream, FilterSetup& setup, BlockReader& reader) {
  if (stream.form == Form::csv)
    stream.separator = setup.delimiter ? *setup.delimiter : separatorOf(firstLineOf(reader));
  char& out = setup.writer.separator;
  const bool isSame = stream.form == Form::csv && hasColumns(stream.to);
  if (isSame) out = stream.separator;
  if (stream.to == OutputForm::table) out = ',';
  if (stream.to == OutputForm::csv && setup.delimiter) out = *setup.delimiter;
  if (stream.to == OutputForm::csv && isEnding(endingOf(nameOfOutput()), ".tsv") && out != '\t') {
    if (isSame || setup.delimiter)
      throw UsageError(std::string(nameOfOutput()) +
                       ": the output has the input's separator or --delimiter's, and that is not a tab; name it .csv");
    out = '\t';
  }
}

/// What was typed for a part of the stream that these forms do not have is not passed over.
void requireUse(const Stream& stream) {
  const FilterSetup& setup = stream.setup;
  const WriterSetup& writer = setup.writer;
  if (setup.delimiter && stream.form != Form::csv && (!stream.writes || stream.to != OutputForm::csv))
    throw UsageError(
        "--delimiter is for CSV, and neither the input nor the output is that; --from csv reads it as CSV");
  if (!stream.writes) return;
  if (stream.to == OutputForm::f64 && isTerminal(kStandardOutput))
    throw UsageError("f64 is binary, and standard output is a terminal; -o FILE keeps it, | cat shows it");
  requireRoom(writer.results, stream.to);
  if (!writer.header && !hasColumns(stream.to))
    throw UsageError("--no-header is for CSV and tables, and the output has no header; leave it out, or add --to csv");
  if (writer.digits > 0 && stream.to == OutputForm::f64)
    throw UsageError("--digits rounds numbers in text, and f64 is binary; leave it out, or add --to text");
}

/// Reads the header of CSV, and tries it: columns must have different names, and those of the numbers must be there.
/// Returns what stands at the output's start.
TextBuffer readHeader(Stream& stream, BlockReader& reader) {
  TextBuffer out;
  const auto line = stream.form == Form::csv ? reader.firstLine() : std::nullopt;
  if (!line) return out;
  const CsvHeader header =
      readCsvHeader(line->text, stream.setup.csvDefaults, stream.setup.columns.numbers(), stream.separator);
  if (header.present) reader.passFirstLine();
  stream.header = {Form::csv, false, header.names.size(), header.names, header.present, stream.separator};
  try {
    RecordParts example = csvParts(line->text, stream.header);
    if (const auto again = firstRepeated(header.names, std::identity()))
      throw RecordError(0, "has the column '" + header.names[*again] + "' twice");
    example.values.assign(header.names.size(), example.text);
    const auto work = stream.makeWork();
    const Results results = work->results(work->find(example), stream.to);
    if (stream.batch.checkNames) requireNoClash(example, results, stream.setup.writer.prefix);
    if (stream.writes && hasColumns(stream.to))
      stream.columns = csvColumns(stream.setup.writer, header, line->text, stream.separator, results, out);
  } catch (const RecordError& e) {
    throw InputError(place(reader.name(), positionAt(line->text, e.offset, line->position)) + ": " + visible(e.what()));
  }
  return out;
}

int run(FilterSetup& setup, const MakeWork& makeWork, bool writes) {
  std::string given;
  for (const GivenRecord& record : setup.given) given += record.json + "\n";
  BlockReader reader =
      setup.given.empty() ? BlockReader(std::make_unique<InputFile>(setup.file), setup.blockSize) : BlockReader(given);
  Stream stream{.setup = setup, .makeWork = makeWork, .writes = writes};
  stream.form = formOfInput(stream, reader);
  const auto work = makeWork();
  stream.to = formOfOutput(setup, *work, stream.form);
  settleFormat(stream, setup, reader);
  reader.setForm(stream.form, stream.separator);
  // JSON keeps its own arrangement, arrays included, unless an arrangement was asked for.
  setup.writer.keepArrays = writes && !setup.to && stream.form == Form::json;
  setup.writer.keepGoing = setup.keepGoing;
  setup.writer.table = stream.to == OutputForm::table;
  setup.writer.results = work->results({}, stream.to);
  requireUse(stream);
  stream.columns.results = setup.writer.results;
  stream.batch = {.form = stream.form,
                  .to = stream.to,
                  .convert = stream.form == Form::f64 && stream.to == OutputForm::f64,
                  .keepGoing = setup.keepGoing,
                  .checkNames = writes && (stream.to == OutputForm::lines || stream.to == OutputForm::array),
                  .prefix = setup.writer.prefix};
  const TextBuffer start = readHeader(stream, reader);

  const auto placeOf = [&](TextPosition position) {
    return setup.given.empty() ? place(reader.name(), position) : setup.given[position.line - 1].option;
  };
  OrderedOutput output(
      {.form = stream.to, .placeOf = placeOf, .fromCommandLine = !setup.given.empty(), .note = setup.note},
      reader.totalBytes());
  if (writes && stream.to == OutputForm::array) output.openArray();
  output.write(start.view());
  const bool namesColumns = writes && hasColumns(stream.to);
  runPipeline({.jobs = setup.jobs > 0 ? setup.jobs : countProcessors(),
               .makeWorker = [&](BlockResult& result) { return std::make_unique<RecordWorker>(stream, result); },
               .mayShare = [&] { return !namesColumns || stream.columns.known; },
               .failed = setup.failed},
              reader, output);
  if (namesColumns && !stream.columns.known && !stream.columns.early.empty())
    output.write(headerOfBadRecords(setup.writer, stream.columns));
  return output.finish();
}

}  // namespace

int runFilter(FilterSetup setup, const MakeWork& makeWork) { return run(setup, makeWork, true); }

int readRecords(FilterSetup setup, const MakeWork& makeWork) {
  setup.jobs = 1;
  return run(setup, makeWork, false);
}

}  // namespace viewproj::cmd
