#include "stream/filter.hpp"

#include <algorithm>
#include <functional>
#include <thread>

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
  CsvFormat format = {};
  OutputForm to = OutputForm::lines;
  bool writes = true;
  Shape header = {};
  BatchSetup batch = {};
  CsvColumns columns = {};
};

std::unique_ptr<RecordReader> makeReader(const Stream& stream) {
  switch (stream.form) {
    case Form::csv:
      return makeCsvReader(stream.header, stream.setup.writer.results);
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

  void work(Block& block, BlockResult& result) override {
    const bool joined = stream_.to == OutputForm::array || (stream_.setup.writer.keepArrays && block.inArray);
    if (writer_) writer_->beginBlock(joined);
    batch_.begin(block);
    try {
      reader_->read(block, batch_);
      batch_.flush();
    } catch (const Batch::StopBlock&) {
      if (writer_) writer_->endArray();
    }
    if (writer_) result.records += writer_->records();
  }

 private:
  Stream& stream_;
  std::unique_ptr<RecordWork> work_;
  std::unique_ptr<RecordReader> reader_;
  std::unique_ptr<RecordWriter> writer_;
  Batch batch_;
};

/// Whether a line is a header with the columns that are needed.
bool namesColumns(const Stream& stream, std::string_view line, const CsvFormat& format) {
  const CsvHeader header = readCsvHeader(line, {}, stream.setup.columns.numbers(), format);
  if (!header.present) return false;
  RecordParts example{line, {Form::csv, false, header.names.size(), header.names, true, format}, {}};
  example.values.assign(header.names.size(), example.text);
  try {
    (void)stream.makeWork()->find(example);
  } catch (const RecordError&) {
    return false;
  }
  return true;
}

/// What separates the columns of the first line: of comma, semicolon and tab the first by which it names the columns
/// that are needed, or the last that it has.
char separatorOf(const Stream& stream, std::string_view line) {
  CsvFormat format;
  for (const char separator : {',', ';', '\t'}) {
    if (line.find(separator) == std::string_view::npos) continue;
    format.separator = separator;
    if (namesColumns(stream, line, format)) break;
  }
  return format.separator;
}

/// The first line that is none of blanks and no comment of text, as far as it tells the form.
std::string_view firstLineOf(BlockReader& reader) {
  std::string_view start = reader.firstBytes();
  if (start.starts_with("\xEF\xBB\xBF")) start.remove_prefix(3);
  start = afterComments(start);
  start = start.substr(0, start.find('\n'));
  return start.ends_with('\r') ? start.substr(0, start.size() - 1) : start;
}

/// Reads the header of CSV, and tries it: columns must have different names, and those of the numbers must be there.
/// Returns what stands at the output's start.
TextBuffer readHeader(Stream& stream, BlockReader& reader) {
  TextBuffer out;
  std::optional<BlockReader::Line> line;
  CsvHeader header;
  if (stream.form == Form::csv && (line = reader.firstLine(false))) {
    header = readCsvHeader(line->text, stream.setup.csvDefaults, stream.setup.columns.numbers(), stream.format);
    if (header.present) (void)reader.firstLine(true);
    stream.header = {Form::csv, false, header.names.size(), header.names, header.present, stream.format};
  }
  const bool fromCsv = line.has_value();
  try {
    if (fromCsv) {
      std::vector<std::string_view> fields;
      splitCsvLine(line->text, fields, stream.format, kMostFields + 1);
      requireNoLoneReturn(line->text, fields);
      requireClosedFields(line->text, fields, stream.format);
      if (header.names.size() > kMostFields)
        throw RecordError(0, "has more than " + std::to_string(kMostFields) + " columns");
      RecordParts example{line->text, stream.header, {}};
      if (const auto again = firstRepeated(header.names, std::identity()))
        throw RecordError(0, "has the column '" + header.names[*again] + "' twice");
      example.values.assign(header.names.size(), example.text);
      const auto work = stream.makeWork();
      const Layout layout = work->find(example);
      if (stream.batch.checkNames)
        requireNoClash(example, work->results(layout, OutputForm::lines), stream.setup.writer.prefix);
    }
    if (stream.writes && hasColumns(stream.to))
      stream.columns =
          csvColumns(stream.setup.writer, fromCsv ? &header : nullptr, fromCsv ? line->text : "", stream.format, out);
  } catch (const RecordError& e) {
    throw InputError(place(reader.name(), positionAt(line->text, e.offset, line->position)) + ": " + visible(e.what()));
  }
  return out;
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

/// What was typed for a part of the output that this form does not have is not passed over.
void requireUse(const FilterSetup& setup, OutputForm form) {
  const WriterSetup& writer = setup.writer;
  if (!writer.header && !hasColumns(form))
    throw UsageError("--no-header is for CSV and tables, and the output has no header; leave it out, or add --to csv");
  if (writer.digits > 0 && form == OutputForm::f64)
    throw UsageError("--digits is of numbers as text, and f64 has doubles; leave it out, or add --to text");
}

Form formOfContent(const Stream& stream, BlockReader& reader) {
  const FilterSetup& setup = stream.setup;
  const std::string_view start = reader.firstBytes();
  if (wideEncoding(start).empty()) {
    const std::string_view line = firstLineOf(reader);
    const auto form =
        line.empty() && start.find('\0') == std::string_view::npos
            ? Form::text
            : formOfBytes(start.substr(static_cast<std::size_t>(line.data() - start.data())), setup.keepGoing);
    if (form == Form::text && !line.empty()) {
      // A header, be there numbers among its names.
      CsvFormat format = stream.format;
      format.separator = separatorOf(stream, line);
      if (setup.delimiter || namesColumns(stream, line, format)) return Form::csv;
    }
    if (form) return *form;
  }
  reader.requireUtf8();
  throw InputError(reader.name() + ": is binary; expected JSON, CSV or text, or --from f64 for little-endian doubles");
}

/// How CSV is written, in and out.
void settleFormat(Stream& stream, FilterSetup& setup, BlockReader& reader) {
  if (stream.form == Form::csv)
    stream.format.separator = setup.delimiter ? *setup.delimiter : separatorOf(stream, firstLineOf(reader));
  CsvFormat& out = setup.writer.csv;
  const bool isSame = stream.form == Form::csv && hasColumns(stream.to);
  if (isSame) out = stream.format;
  if (stream.to == OutputForm::table) out.separator = ',';
  if (stream.to == OutputForm::csv && setup.delimiter) out.separator = *setup.delimiter;
  if (stream.to == OutputForm::csv && isEnding(endingOf(nameOfOutput()), ".tsv") && out.separator != '\t') {
    if (isSame || setup.delimiter)
      throw UsageError(std::string(nameOfOutput()) +
                       ": CSV leaves with the separator that it came with or --delimiter names, and that is no tab; "
                       "call it .csv");
    out.separator = '\t';
  }
  if (setup.delimiter && stream.form != Form::csv && (!stream.writes || stream.to != OutputForm::csv))
    throw UsageError(
        "--delimiter is for CSV, and neither the input nor the output is that; --from csv reads it as CSV");
}

int run(FilterSetup& setup, const MakeWork& makeWork, bool writes) {
  auto file = setup.given.empty() ? std::make_unique<InputFile>(setup.file) : nullptr;
  std::string given;
  for (const GivenRecord& record : setup.given) given += record.json + "\n";
  auto reader =
      file ? std::make_unique<BlockReader>(std::move(file), setup.blockSize) : std::make_unique<BlockReader>(given);
  Stream stream{.setup = setup, .makeWork = makeWork, .writes = writes};
  const auto named = setup.from ? setup.from : formOfName(setup.file);
  stream.form = !setup.given.empty() ? Form::json : named ? *named : formOfContent(stream, *reader);
  if (stream.form != Form::f64) reader->requireUtf8();
  if (stream.form == Form::f64 && setup.columns.given())
    throw UsageError("--columns " + setup.columns.text +
                     ": f64 has no columns; a record is three doubles, x, y, z, or of a pixel x, y, depth");
  if (stream.form == Form::text) setup.columns.requireNoNames("lines of text");
  const auto work = makeWork();
  stream.to = formOfOutput(setup, *work, stream.form);
  settleFormat(stream, setup, *reader);
  reader->setForm(stream.form, stream.format);
  const bool toJson = stream.to == OutputForm::lines || stream.to == OutputForm::array;
  // JSON keeps its own arrangement, arrays included, unless an arrangement was asked for.
  setup.writer.keepArrays = writes && !setup.to && stream.form == Form::json;
  setup.writer.keepGoing = setup.keepGoing;
  stream.batch = {.form = stream.form,
                  .convert = stream.form == Form::f64 && stream.to == OutputForm::f64,
                  .keepGoing = setup.keepGoing,
                  .checkNames = writes && toJson,
                  .prefix = setup.writer.prefix};
  setup.writer.table = stream.to == OutputForm::table;
  setup.writer.results = work->results({}, stream.to);
  if (writes && stream.to == OutputForm::f64 && isTerminal(kStandardOutput))
    throw UsageError("f64 is binary, and standard output is a terminal; -o FILE keeps it, | cat shows it");
  if (writes) {
    requireRoom(setup.writer.results, stream.to);
    requireUse(setup, stream.to);
  }
  const TextBuffer start = readHeader(stream, *reader);

  OutputSetup output{.form = stream.to,
                     .keepArrays = setup.writer.keepArrays,
                     .placeOf =
                         [&](TextPosition position) {
                           return setup.given.empty() ? place(reader->name(), position)
                                                      : setup.given[position.line - 1].option;
                         },
                     .fromCommandLine = !setup.given.empty(),
                     .nothing = !writes,
                     .note = setup.note,
                     .before =
                         [&](const auto& write) {
                           if (stream.columns.headerIsDue) writeDueHeader(stream.columns, setup.writer, write);
                         }};
  OrderedOutput ordered(std::move(output), Progress(reader->totalBytes()));
  ordered.begin(start.view());
  const unsigned processors = std::max(1u, std::thread::hardware_concurrency());
  const PipelineSetup pipeline{
      .jobs = setup.jobs > 0 ? setup.jobs : processors,
      .makeWorker = [&](BlockResult& result) { return std::make_unique<RecordWorker>(stream, result); },
      .inOrder = [&] { return writes && hasColumns(stream.to) && !stream.columns.known; },
      .failed = setup.failed};
  runPipeline(pipeline, *reader, ordered);
  stream.columns.headerIsDue = !stream.columns.early.empty();
  return ordered.finish();
}

}  // namespace

int runFilter(FilterSetup setup, const MakeWork& makeWork) { return run(setup, makeWork, true); }

int readRecords(FilterSetup setup, const MakeWork& makeWork) {
  setup.jobs = 1;
  return run(setup, makeWork, false);
}

}  // namespace viewproj::cmd
