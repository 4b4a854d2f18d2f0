#include "stream/filter.hpp"

#include <algorithm>
#include <functional>

#include "stream/pipeline.hpp"
#include "text/csv.hpp"
#include "text/names.hpp"
#include "text/system.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

/// The input of a stream, and how its records are read.
class Source {
 public:
  explicit Source(const StreamSetup& setup) : setup_(setup) {
    for (const GivenRecord& record : setup.given) typed_ += record.json + "\n";
    reader_ = setup.given.empty()
                  ? std::make_unique<BlockReader>(std::make_unique<InputFile>(setup.file), setup.blockSize)
                  : std::make_unique<BlockReader>(typed_);
    settleForm();
    if (isBinary(schema.form))
      settleBinary();
    else
      reader_->passByteOrderMark();
    if (schema.form == Form::text) setup.columns.requireNoNames("lines of text");
    if (setup.width && !isBinary(schema.form))
      throw UsageError("--width is for f32 and f64, and the input is neither; leave it out, or add --from f32");
    ends_.form = schema.form;
  }

  /// The header of CSV; nothing of other forms, and of no line.
  std::optional<BlockReader::Line> readHeader() {
    if (schema.form != Form::csv) return std::nullopt;
    schema.separator = ends_.separator = setup_.delimiter ? *setup_.delimiter : separatorOf(firstLineOf());
    auto line = reader_->firstLine(schema.separator);
    if (!line) return line;
    CsvRecord record;
    record.split(line->text, schema.separator, kMostFields);
    const CsvHeader header = readCsvHeader(record.fields, setup_.csvDefaults, setup_.columns.numbers());
    if (header.present) reader_->passFirstLine();
    schema.size = ends_.columns = header.names.size();
    schema.names = header.names;
    schema.hasHeader = header.present;
    failAt(*line, [&] {
      requireFewFields(line->text, record.fields);
      if (!record.fault.empty()) throw RecordError(record.faultAt, record.fault);
      if (const auto again = firstRepeated(schema.names, std::identity()))
        throw RecordError(0, "has the column '" + schema.names[*again] + "' twice");
    });
    return line;
  }

  /// An error of the header has its place.
  template <class Action>
  void failAt(const BlockReader::Line& line, const Action& action) const {
    try {
      action();
    } catch (const RecordError& e) {
      throw InputError(place(reader_->name(), positionAt(line.text, e.offset, line.position)) + ": " +
                       visible(e.what()));
    }
  }

  BlockReader& begin() {
    reader_->setEnds(ends_);
    return *reader_;
  }
  std::size_t binaryRecord() const { return ends_.record; }

  std::unique_ptr<RecordReader> makeReader() const {
    switch (schema.form) {
      case Form::json:
        return makeJsonReader(setup_.keepGoing);
      case Form::csv:
        return makeCsvReader(schema, setup_.keepGoing);
      case Form::text:
        return makeTextReader();
      default:
        return makeBinaryReader(schema);
    }
  }

  std::string placeOf(TextPosition position) const {
    return setup_.given.empty() ? place(reader_->name(), position) : setup_.given[position.line - 1].option;
  }

  Schema schema;

 private:
  void settleForm() {
    const auto named = setup_.from ? setup_.from : formOfName(setup_.file);
    schema.form = !setup_.given.empty() ? Form::json : named ? *named : formOfContent();
  }

  Form formOfContent() {
    const std::string_view start = reader_->firstBytes();
    requireNarrow(reader_->name(), start);
    if (const auto form = formOfBytes(start)) return *form == Form::text && setup_.delimiter ? Form::csv : *form;
    throw InputError(reader_->name() +
                     ": is binary; expected JSON, CSV, text or an .npy file, or --from f32 or f64 for numbers alone");
  }

  /// The first line that is not blank or a comment, as far as it is needed to tell the format.
  std::string_view firstLineOf() {
    const std::string_view start = afterComments(withoutByteOrderMark(reader_->firstBytes()));
    return start.substr(0, start.find('\n'));
  }

  void settleBinary() {
    schema.isArray = true;
    schema.size = setup_.width.value_or(3);
    if (schema.form == Form::npy) readNpy();
    ends_.record = schema.size * bytesOf(schema.form);
    setup_.columns.requireNoNames("binary numbers");
    for (const std::size_t number : setup_.columns.numbers())
      if (number > schema.size)
        throw UsageError("--columns " + setup_.columns.text + ": a record has " + std::to_string(schema.size) +
                         " numbers" + (setup_.from == Form::npy || setup_.width ? "" : "; --width N tells how many"));
  }

  void readNpy() {
    if (setup_.width) throw UsageError("--width is for f32 and f64; an .npy file tells its width itself");
    const NpyHeader header = reader_->passNpyHeader();
    const auto fail = [&](const std::string& what) {
      throw InputError(reader_->name() + ": " + what +
                       "; expected little-endian floats or doubles, in C order, of two dimensions, as numpy.save "
                       "writes numpy.ascontiguousarray(a, '<f8')");
    };
    if (header.type != "<f4" && header.type != "<f8") fail("has numbers of type " + inQuotes(header.type));
    if (header.isFortranOrder) fail("is in Fortran order");
    if (header.shape.size() != 2) fail("has " + std::to_string(header.shape.size()) + " dimensions");
    if (header.shape[1] == 0 || header.shape[1] > kMostFields)
      fail("has " + std::to_string(header.shape[1]) + " columns");
    schema.form = header.type == "<f4" ? Form::f32 : Form::f64;
    schema.size = header.shape[1];
    reader_->expectRecords(header.shape[0]);
  }

  const StreamSetup& setup_;
  std::string typed_;
  std::unique_ptr<BlockReader> reader_;
  RecordEnds ends_;
};

// ---- Filters

/// Results that are only words turn numbers alone into JSON.
OutputForm formOfOutput(const StreamSetup& setup, Form form) {
  if (setup.to) return *setup.to;
  const OutputForm same = sameForm(form);
  return setup.areWords && hasNumbersOnly(same) ? OutputForm::lines : same;
}

char separatorOfOutput(const StreamSetup& setup, const Schema& schema, OutputForm to) {
  const bool isFromCsv = schema.form == Form::csv;
  const bool isTsv = to == OutputForm::csv && isEnding(endingOf(nameOfOutput()), ".tsv");
  if (!isFromCsv && !setup.delimiter) return isTsv ? '\t' : ',';
  const char separator = isFromCsv ? schema.separator : *setup.delimiter;
  if (isTsv && separator != '\t')
    throw UsageError(std::string(nameOfOutput()) +
                     ": the output has the input's separator or --delimiter's, and that is not a tab; name it .csv");
  return separator;
}

/// Options for something that these formats do not have are errors, not ignored.
void requireUse(const WriterSetup& setup, Form form) {
  const StreamSetup& stream = setup.stream;
  if (stream.delimiter && form != Form::csv && setup.form != OutputForm::csv)
    throw UsageError("--delimiter is for CSV, but neither input nor output is CSV; --from csv reads the input as CSV");
  if (setup.form == OutputForm::f64 && isTerminal(kStandardOutput))
    throw UsageError("f64 is binary, and standard output is a terminal; -o FILE writes it to a file, | cat shows it");
  requireRoom(setup.rows, setup.form);
  if ((stream.namesCameras || stream.visibleOnly) && hasNumbersOnly(setup.form))
    throw UsageError(std::string(stream.namesCameras ? "--each-camera" : "--visible") +
                     " needs records with names, and text and f64 have numbers only; use JSON or CSV");
  if (!stream.header && !hasColumns(setup.form))
    throw UsageError("--no-header is for CSV and tables, and the output has no header; leave it out, or add --to csv");
  if (stream.digits > 0 && setup.form == OutputForm::f64)
    throw UsageError("--digits rounds numbers in text, and f64 is binary; leave it out, or add --to text");
  if (!stream.prefix.empty() && hasNumbersOnly(setup.form))
    throw UsageError("--prefix is for the names of results, and text and f64 have none; leave it out, or add --to csv");
}

std::unique_ptr<RecordWriter> makeWriter(const WriterSetup& setup, CsvColumns& columns, TextBuffer& out) {
  switch (setup.form) {
    case OutputForm::csv:
    case OutputForm::table:
      return makeCsvWriter(setup, columns, out);
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

/// Of CSV columns that become fields of JSON.
void requireJsonNames(const RecordView& header, const ResultRows& rows, const std::string& prefix) {
  if (!isUtf8(header.text) && header.schema->hasHeader)
    throw RecordError(0, "has a column name that is not UTF-8, as iconv -f LATIN1 -t UTF-8 makes it");
  requireNoClash(header, rows, prefix);
}

class FilterWorker final : public BlockWorker {
 public:
  FilterWorker(const Source& source, const WriterSetup& setup, const RecordCameras& cameras, CsvColumns& columns,
               const MakeProcessor& makeProcessor, BlockResult& result)
      : setup_(setup),
        processor_(makeProcessor(setup.form)),
        reader_(source.makeReader()),
        writer_(makeWriter(setup, columns, result.out)),
        batch_(setup, cameras, *processor_, *writer_, source.binaryRecord(),
               source.schema.form == Form::f64 && setup.form == OutputForm::f64, result) {}

  void work(const Block& block, BlockResult& result) override {
    result.clear();
    writer_->beginBlock(setup_.form == OutputForm::array ? "]" : setup_.keepArrays ? block.state.closing() : "");
    batch_.begin(block);
    try {
      reader_->read(block, batch_);
      batch_.flush();
    } catch (const RecordSink::Stop&) {
    }
    if (block.bad && !result.fault) addLongRecord(*block.bad, result);
    result.closing = writer_->closing();
    result.joint = writer_->joint();
  }

 private:
  void addLongRecord(const StreamFault& bad, BlockResult& result) {
    if (!setup_.stream.keepGoing) {
      result.fault = bad;
      return;
    }
    writer_->writeBad({}, bad.position.line, bad.message);
    result.passedOver.push_back(bad);
    ++result.records;
  }

  const WriterSetup& setup_;
  std::unique_ptr<RecordProcessor> processor_;
  std::unique_ptr<RecordReader> reader_;
  std::unique_ptr<RecordWriter> writer_;
  Batch batch_;
};

/// Records that are only read, by one thread.
class ReadingWorker final : public BlockWorker, public RecordSink {
 public:
  ReadingWorker(const Source& source, const StreamSetup& setup, const RecordUse& use, BlockResult& result)
      : setup_(setup), use_(use), binaryRecord_(source.binaryRecord()), reader_(source.makeReader()), result_(result) {}

  void work(const Block& block, BlockResult& result) override {
    result.clear();
    position_.begin(block, binaryRecord_);
    try {
      reader_->read(block, *this);
      if (block.bad) addBad(*block.bad);
    } catch (const Stop&) {
    }
  }

  Plan plan(const RecordView& record) override {
    Plan plan{use_.locate(record)};
    for (const std::string& text : plan.numbers.notes) result_.note(text);
    return plan;
  }
  void take(const RecordView& record, const Plan& plan, const Numbers& numbers) override {
    use_.use(plan.numbers, numbers, record, position_.positionOf(record.text.data()).line);
    if (!numbers.seaLevel.empty()) result_.note(seaLevelNote(numbers.seaLevel));
    ++result_.records;
  }
  void bad(std::string_view text, const RecordError& error, std::span<const std::string_view>) override {
    addBad({position_.positionOf(text.data() + error.offset), error.what()});
  }
  void takeError(const RecordView& record, std::size_t field) override {
    addBad({position_.positionOf(record.text.data()), "has an error: " + plainText(record, field)});
  }

 private:
  void addBad(const StreamFault& fault) {
    if (!setup_.keepGoing) {
      result_.fault = fault;
      throw Stop{};
    }
    result_.passedOver.push_back(fault);
  }

  const StreamSetup& setup_;
  const RecordUse& use_;
  std::size_t binaryRecord_;
  std::unique_ptr<RecordReader> reader_;
  BlockResult& result_;
  PositionCounter position_;
};

OutputSetup outputSetup(const StreamSetup& setup, const Source& source, OutputForm form, char separator) {
  return {.form = form,
          .separator = separator,
          .placeOf = [&source](TextPosition position) { return source.placeOf(position); },
          .fromCommandLine = !setup.given.empty(),
          .note = setup.note};
}

}  // namespace

int runFilter(const StreamSetup& setup, const RecordCameras& cameras, const MakeProcessor& makeProcessor) {
  Source source(setup);
  const auto header = source.readHeader();
  const Schema& schema = source.schema;
  WriterSetup writing{.stream = setup, .form = formOfOutput(setup, schema.form)};
  writing.separator = separatorOfOutput(setup, schema, writing.form);
  writing.keepArrays = !setup.to && schema.form == Form::json;  // unless --to was given
  const auto processor = makeProcessor(writing.form);
  writing.rows = withCameraName(setup, processor->rows({}));
  requireUse(writing, schema.form);
  CsvColumns columns{.rows = writing.rows};
  TextBuffer start;
  if (header)
    source.failAt(*header, [&] {
      const std::vector<std::string_view> values(schema.size, header->text);
      const RecordView example{header->text, &schema, values};
      const ResultRows rows = withCameraName(setup, processor->rows(processor->locate(example)));
      if (hasColumns(writing.form))
        columns = csvColumns(writing, {schema.names, schema.hasHeader}, header->text, rows, start);
      else if (!hasNumbersOnly(writing.form))
        requireJsonNames(example, rows, setup.prefix);
    });
  BlockReader& reader = source.begin();
  OrderedOutput output(outputSetup(setup, source, writing.form, writing.separator), reader.totalBytes());
  output.begin(start.view());
  runPipeline({.jobs = setup.jobs > 0 ? setup.jobs : countProcessors(),
               .makeWorker =
                   [&](BlockResult& result) {
                     return std::make_unique<FilterWorker>(source, writing, cameras, columns, makeProcessor, result);
                   },
               .mayShare = [&] { return !hasColumns(writing.form) || columns.known; },
               .failed = setup.failed},
              reader, output);
  return output.finish();
}

int readRecords(const StreamSetup& setup, const RecordUse& use) {
  Source source(setup);
  if (const auto header = source.readHeader())
    source.failAt(*header, [&] {
      const std::vector<std::string_view> values(source.schema.size, header->text);
      (void)use.locate({header->text, &source.schema, values});
    });
  if (setup.delimiter && source.schema.form != Form::csv)
    throw UsageError("--delimiter is for CSV, but the input is not CSV; --from csv reads the input as CSV");
  BlockReader& reader = source.begin();
  OrderedOutput output(outputSetup(setup, source, OutputForm::lines, ','), reader.totalBytes());
  runPipeline(
      {.makeWorker = [&](BlockResult& result) { return std::make_unique<ReadingWorker>(source, setup, use, result); },
       .failed = setup.failed},
      reader, output);
  return output.finish();
}

RecordOutput::RecordOutput(const StreamSetup& setup, const Schema& schema, const ResultRows& rows)
    : setup_(setup),
      writing_{.stream = setup_,
               .form = formOfOutput(setup, schema.form),
               .separator = separatorOfOutput(setup, schema, formOfOutput(setup, schema.form)),
               .rows = rows},
      columns_{.rows = rows},
      output_({.form = writing_.form, .separator = writing_.separator, .placeOf = nullptr}, std::nullopt) {
  requireUse(writing_, schema.form);
  TextBuffer start;
  if (schema.form == Form::csv && hasColumns(writing_.form)) {
    std::vector<std::string> names;
    for (const std::string& name : schema.names) names.push_back(quotedIfNeeded(name, writing_.separator));
    columns_ = csvColumns(writing_, {schema.names, schema.hasHeader},
                          joined(names, std::string_view(&writing_.separator, 1)), rows, start);
  }
  output_.begin(start.view());
  writer_ = makeWriter(writing_, columns_, result_.out);
  begin();
}

void RecordOutput::begin() {
  result_.clear();
  writer_->beginBlock(writing_.form == OutputForm::array ? "]" : "");
}

void RecordOutput::write(const RecordView& record, const ResultValues& values) {
  if (record.schema != last_ && !record.schema->isArray) requireNoClash(record, writing_.rows, setup_.prefix);
  last_ = record.schema;
  writer_->write(record, writing_.rows, values);
  if (result_.out.size() > setup_.blockSize) flush();
}

void RecordOutput::flush() {
  result_.closing = writer_->closing();
  result_.joint = writer_->joint();
  output_.put({}, result_);
  begin();
}

void RecordOutput::finish() {
  flush();
  output_.finish();
}

}  // namespace viewproj::cmd
