#include <algorithm>
#include <cmath>

#include "input/error.hpp"
#include "output/columns.hpp"
#include "output/number.hpp"
#include "output/record_writer.hpp"

namespace viewproj::cmd {
namespace {

std::string quotedIfNeeded(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

/// Collects the column names of results.
class ColumnCollector final : public ResultSink {
 public:
  explicit ColumnCollector(std::string prefix) : prefix_(std::move(prefix)) {}

  void number(std::string_view name, double) override { add(name, ""); }
  void vector(std::string_view name, std::span<const double> values) override {
    for (std::size_t i = 0; i < values.size(); ++i) add(name, kColumnSuffixes[i]);
  }
  void flag(std::string_view name, bool) override { add(name, ""); }
  void names(std::string_view name, std::span<const std::string_view>, bool) override { add(name, ""); }

  bool hasFixedColumns() const override { return true; }

  std::vector<std::string> columns;

 private:
  void add(std::string_view name, std::string_view suffix) {
    columns.push_back(prefix_ + columnName(name) + std::string(suffix));
  }
  std::string prefix_;
};

/// A cell of a record that was not read as CSV.
struct OwnCell {
  std::string column;
  std::string text;
};

bool isNumber(std::string_view json) { return !json.empty() && (json[0] == '-' || (json[0] >= '0' && json[0] <= '9')); }

void appendCells(std::vector<OwnCell>& cells, const std::string& name, std::string_view json) {
  if (json.starts_with('[')) {
    std::vector<std::string_view> items;
    JsonParts parts(json);
    while (const auto part = parts.next()) items.push_back(part->value);
    if (items.size() >= 2 && items.size() <= 4 && std::all_of(items.begin(), items.end(), isNumber)) {
      for (std::size_t i = 0; i < items.size(); ++i)
        cells.push_back({name + std::string(kColumnSuffixes[i]), std::string(items[i])});
      return;
    }
  }
  std::string text = json == "null" ? "" : std::string(json);
  if (json.starts_with('"')) text = unescaped(json.substr(1, json.size() - 2));
  cells.push_back({name, quotedIfNeeded(text)});
}

/// A record of another form as cells: arrays of two to four numbers spread over columns.
std::vector<OwnCell> ownCells(const Record& record, const WriterSetup& setup) {
  std::vector<OwnCell> cells;
  if (record.form == Form::json && !record.isArray)
    for (const Field& field : record.fields) appendCells(cells, field.name, field.value);
  else
    for (const NamedJson& field : asJsonFields(record, setup)) appendCells(cells, field.name, field.json);
  for (std::size_t i = 0; i < cells.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (cells[i].column == cells[j].column)
        throw RecordError(0, "would fill the column '" + cells[i].column + "' twice");
  return cells;
}

class CsvWriter final : public RecordWriter {
 public:
  CsvWriter(WriterSetup setup, std::string& out) : setup_(std::move(setup)), out_(out) {
    ColumnCollector collector(setup_.prefix);
    setup_.exampleResults(collector);
    resultColumns_ = collector.columns;
    if (setup_.keepGoing) resultColumns_.push_back("error");
  }

  void header(const CsvHeader& input, std::string_view line) override {
    fromCsv_ = true;
    ownColumns_ = input.names;
    if (!input.present) return;
    requireNoClash();
    out_ += line;
    for (const std::string& column : resultColumns_) out_ += "," + column;
    out_ += '\n';
  }

  void beginRecord(const Record& record) override {
    start_ = out_.size();
    if (record.form == Form::csv) {
      out_ += record.text;
      return;
    }
    const auto cells = ownCells(record, setup_);
    headerIsNew_ = ownColumns_.empty();
    if (headerIsNew_) {
      for (const OwnCell& cell : cells) ownColumns_.push_back(cell.column);
      requireNoClash();
      writeHeader();
    }
    for (const OwnCell& cell : cells)
      if (std::find(ownColumns_.begin(), ownColumns_.end(), cell.column) == ownColumns_.end())
        throw RecordError(
            0, "has '" + cell.column + "', which the first record has not; CSV columns are the first record's");
    for (const std::string& column : ownColumns_) {
      if (&column != &ownColumns_.front()) out_ += ',';
      for (const OwnCell& cell : cells)
        if (cell.column == column) out_ += cell.text;
    }
  }

  void endRecord() override {
    out_ += setup_.keepGoing ? ",\n" : "\n";
    headerIsNew_ = false;
    early_.clear();
  }

  void finish() override {
    if (!early_.empty()) writeHeader();
  }

  void cancelRecord() override {
    out_.resize(start_);
    if (headerIsNew_) ownColumns_.clear();
  }

  /// As many own cells as there are columns, so that the message stands in its own.
  void badRecord(std::string_view text, std::size_t, const std::string& message) override {
    if (!fromCsv_) {
      if (ownColumns_.empty())
        early_.push_back(message);
      else
        writeBadCells(message);
      return;
    }
    const auto cells = splitCsvLine(text);
    for (std::size_t i = 0; i < ownColumns_.size(); ++i) {
      if (i > 0) out_ += ',';
      if (i < cells.size()) out_ += cells[i];
    }
    out_.append(resultColumns_.size(), ',');
    out_ += quotedIfNeeded(message) + "\n";
  }

  bool hasFixedColumns() const override { return true; }
  void number(std::string_view, double value) override { cell(value); }

  void vector(std::string_view, std::span<const double> values) override {
    const bool finite = std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
    for (double value : values) cell(finite ? value : NAN);
  }

  void flag(std::string_view, bool value) override { out_ += value ? ",true" : ",false"; }

  void names(std::string_view, std::span<const std::string_view> values, bool) override {
    out_ += ',';
    for (const std::string_view& value : values) {
      if (&value != values.data()) out_ += ' ';
      out_ += value;
    }
  }

 private:
  void cell(double value) {
    out_ += ',';
    if (std::isfinite(value)) appendNumber(out_, value);
  }

  void requireNoClash() const {
    for (const std::string& column : resultColumns_)
      if (std::find(ownColumns_.begin(), ownColumns_.end(), column) != ownColumns_.end())
        throw RecordError(0, "already has a column '" + column + "'; --prefix P puts P in front of the results' names");
  }

  /// And behind it the bad records that came before the columns were known.
  void writeHeader() {
    std::string separator;
    for (const auto* columns : {&ownColumns_, &resultColumns_})
      for (const std::string& column : *columns) {
        out_ += separator + quotedIfNeeded(column);
        separator = ",";
      }
    out_ += '\n';
    for (const std::string& message : early_) writeBadCells(message);
  }

  void writeBadCells(const std::string& message) {
    out_.append(ownColumns_.size() + resultColumns_.size() - 1, ',');
    out_ += quotedIfNeeded(message) + "\n";
  }

  WriterSetup setup_;
  std::string& out_;
  std::vector<std::string> ownColumns_, resultColumns_;
  bool fromCsv_ = false;
  bool headerIsNew_ = false;
  std::vector<std::string> early_;  ///< messages of bad records before the first good one
  std::size_t start_ = 0;
};

}  // namespace

std::unique_ptr<RecordWriter> makeCsvWriter(WriterSetup setup, std::string& out) {
  return std::make_unique<CsvWriter>(std::move(setup), out);
}

}  // namespace viewproj::cmd
