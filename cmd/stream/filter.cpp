#include "stream/filter.hpp"

#include <cstdio>

#include "input/error.hpp"
#include "input/file.hpp"
#include "output/output_file.hpp"
#include "stream/splitter.hpp"

namespace viewproj::cmd {
namespace {

constexpr std::size_t kFlushAt = 64 << 10;
constexpr std::string_view kBom = "\xEF\xBB\xBF";

/// The bytes of a file, or given ones, not yet taken by the splitter.
class Source {
 public:
  explicit Source(const FilterSetup& setup) {
    if (setup.given.empty()) {
      file_.emplace(setup.file);
      name_ = file_->name();
      return;
    }
    for (const GivenRecord& record : setup.given) buffer_ += record.json + "\n";
    atEnd_ = true;
  }

  /// Reads until the form can be told: to the end of the first line that is not blank, or a bracket at its start.
  void readFirstLine() {
    constexpr std::size_t kLongEnough = 64 << 10;
    while (!atEnd_ && buffer_.size() < kLongEnough) {
      const std::size_t first = buffer_.find_first_not_of(" \t\r\n");
      const bool mayBeBom =
          kBom.starts_with(std::string_view(buffer_).substr(0, kBom.size())) && buffer_.size() < kBom.size();
      if (first != std::string::npos && !mayBeBom &&
          (buffer_[first] == '{' || buffer_[first] == '[' || buffer_.find('\n', first) != std::string::npos))
        break;
      more();
    }
    if (buffer_.starts_with(kBom)) buffer_.erase(0, kBom.size());
  }

  /// Reads another block. The bytes at hand move: views into them end here.
  void more() {
    buffer_.erase(0, begin_);
    begin_ = 0;
    atEnd_ = !file_->readInto(buffer_);
  }

  std::string_view rest() const { return std::string_view(buffer_).substr(begin_); }
  void take(std::size_t bytes) { begin_ += bytes; }
  bool atEnd() const { return atEnd_; }
  bool wouldWait() const { return file_ && !file_->isReady(); }
  const std::string& name() const { return name_; }

 private:
  std::string name_;
  std::optional<InputFile> file_;
  std::string buffer_;
  std::size_t begin_ = 0;
  bool atEnd_ = false;
};

OutputForm formOfInput(Form form) {
  return form == Form::csv ? OutputForm::csv : form == Form::text ? OutputForm::text : OutputForm::lines;
}

std::unique_ptr<RecordWriter> makeWriter(OutputForm form, const WriterSetup& setup, std::string& out) {
  switch (form) {
    case OutputForm::csv:
      return makeCsvWriter(setup, out);
    case OutputForm::text:
      return makeTextWriter(setup, out);
    case OutputForm::lines:
      return makeJsonWriter(false, setup, out);
    case OutputForm::array:
      return makeJsonWriter(true, setup, out);
  }
  return nullptr;
}

bool isBlank(std::string_view line) { return line.find_first_not_of(" \t\r") == std::string_view::npos; }

/// Drops all that it is told to write.
class NoWriter final : public RecordWriter {
 public:
  void beginRecord(const Record&) override {}
  void endRecord() override {}
  void cancelRecord() override {}
  void badRecord(std::string_view, std::size_t, const std::string&) override {}
  void number(std::string_view, double) override {}
  void vector(std::string_view, std::span<const double>) override {}
  void flag(std::string_view, bool) override {}
  void names(std::string_view, std::span<const std::string_view>, bool) override {}
};

class Filter {
 public:
  Filter(const FilterSetup& setup, const RecordWork& work, bool writes)
      : setup_(setup), work_(work), writes_(writes), source_(setup) {}

  int run() {
    source_.readFirstLine();
    form_ = !setup_.given.empty() ? Form::json
            : setup_.from         ? *setup_.from
                                  : formOfName(setup_.file).value_or(formOfBytes(source_.rest()));
    // JSON keeps its own arrangement, arrays included, unless an arrangement was asked for.
    keepArrays_ = writes_ && !setup_.to && form_ == Form::json;
    const OutputForm outputForm = setup_.to.value_or(formOfInput(form_));
    writer_ = writes_ ? makeWriter(outputForm, setup_.writer, out_) : std::make_unique<NoWriter>();
    Splitter splitter(form_);
    if (outputForm == OutputForm::array) openArray();
    try {
      while (step(splitter)) {
      }
    } catch (const InputError&) {
      closeArray();
      flush();
      throw;
    }
    closeArray();
    writer_->finish();
    flush();
    return passedOver_ ? 1 : 0;
  }

 private:
  /// One piece of the input; false at its end.
  bool step(Splitter& splitter) {
    Piece piece;
    try {
      piece = splitter.next(source_.rest(), source_.atEnd());
    } catch (const RecordError& e) {
      if (!setup_.keepGoing || splitter.insideArray()) failAt(splitter.position(), source_.rest(), e);
      return passOverLine(splitter, e);
    }
    if (piece.event == Event::needMore) {
      if (source_.wouldWait()) flush();
      source_.more();
      return true;
    }
    switch (piece.event) {
      case Event::record:
        doRecord(piece);
        break;
      case Event::beginArray:
        if (keepArrays_) openArray(piece.text);
        break;
      case Event::endArray:
        if (keepArrays_) closeArray(piece.text);
        break;
      default:
        return false;
    }
    source_.take(splitter.taken(source_.rest()));
    if (out_.size() >= kFlushAt) flush();
    return true;
  }

  void doRecord(const Piece& piece) {
    if (form_ != Form::json && isBlank(piece.text)) return;
    if (form_ == Form::csv && header_.names.empty()) {
      header_ = readCsvHeader(piece.text, setup_.csvDefaults);
      try {
        requireUsable(header_, piece);
        writer_->header(header_, piece.text);
      } catch (const RecordError& e) {
        failAt(piece.position, piece.text, e);
      }
      if (header_.present) return;
    }
    bool begun = false;
    try {
      const Record record = parse(piece);
      begun = true;
      writer_->beginRecord(record);
      work_(record, *writer_);
      writer_->endRecord();
    } catch (const RecordError& e) {
      if (begun) writer_->cancelRecord();
      if (!setup_.keepGoing) failAt(piece.position, piece.text, e);
      passOver(piece.text, piece.position, e);
    }
  }

  void passOver(std::string_view text, TextPosition start, const RecordError& e) {
    const TextPosition at = positionAt(text, e.offset, start);
    writer_->badRecord(text, at.line, e.what());
    std::fprintf(stderr, "viewproj: %s: %s\n", placeOf(at).c_str(), e.what());
    passedOver_ = true;
  }

  /// --keep-going where no record can be made out: the line counts as one, and the next begins afresh.
  bool passOverLine(Splitter& splitter, const RecordError& e) {
    const std::string_view rest = source_.rest();
    const std::size_t begin = std::min(rest.find_first_not_of(" \t\r\n"), rest.size());
    const std::size_t end = std::min(rest.find('\n', begin), rest.size());
    const std::size_t at = std::min(std::max(e.offset, begin), end);
    passOver(rest.substr(begin, end - begin), positionAt(rest, begin, splitter.position()),
             RecordError(at - begin, e.what()));
    source_.take(splitter.skip(rest, end));
    return true;
  }

  /// Columns must have different names, and those of the coordinates must be among them.
  void requireUsable(const CsvHeader& header, const Piece& piece) const {
    Record record{Form::csv, piece.text, piece.position, false, {}};
    for (const std::string& name : header.names) {
      if (!name.empty() && record.find(name)) throw RecordError(0, "has the column '" + name + "' twice");
      record.fields.push_back({name, "1"});
    }
    setup_.checkHeader(record);
  }

  std::string placeOf(TextPosition position) const {
    return setup_.given.empty() ? place(source_.name(), position) : setup_.given[position.line - 1].option;
  }

  Record parse(const Piece& piece) const {
    switch (form_) {
      case Form::csv:
        return parseCsvRecord(piece.text, piece.position, header_);
      case Form::text:
        return parseTextRecord(piece.text, piece.position);
      case Form::json:
        break;
    }
    return parseJsonRecord(piece.text, piece.position);
  }

  /// Writes all that came before, then throws.
  [[noreturn]] void failAt(TextPosition start, std::string_view text, const RecordError& e) {
    closeArray();
    flush();
    const std::string message = placeOf(positionAt(text, e.offset, start)) + ": " + e.what();
    if (!setup_.given.empty()) throw UsageError(message);
    throw InputError(message);
  }

  void openArray(std::string_view asWritten = "[") {
    out_.append(asWritten, 0, asWritten.size() - 1);
    writer_->beginArray();
    open_ = true;
    closing_ = asWritten.starts_with('{') ? "}" : "";
  }

  /// asWritten: the closing bracket and what a document has behind it.
  void closeArray(std::string_view asWritten = "") {
    if (!open_) return;
    writer_->endArray();
    open_ = false;
    const std::string_view behind = asWritten.empty() ? std::string_view(closing_) : asWritten.substr(1);
    if (!behind.empty()) {
      out_.pop_back();  // the line break
      out_ += behind;
      out_ += '\n';
    }
  }

  void flush() {
    writeOutput(out_);
    out_.clear();
  }

  const FilterSetup& setup_;
  const RecordWork& work_;
  const bool writes_;
  Source source_;
  Form form_ = Form::json;
  bool keepArrays_ = false;
  bool open_ = false;
  std::string closing_;
  CsvHeader header_;
  std::string out_;
  std::unique_ptr<RecordWriter> writer_;
  bool passedOver_ = false;
};

}  // namespace

int runFilter(const FilterSetup& setup, const RecordWork& work) { return Filter(setup, work, true).run(); }

void readRecords(const FilterSetup& setup, const std::function<void(const Record&)>& visit) {
  Filter(
      setup, [&](const Record& record, ResultSink&) { visit(record); }, false)
      .run();
}

}  // namespace viewproj::cmd
