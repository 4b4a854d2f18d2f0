#include <algorithm>
#include <cmath>
#include <functional>
#include <unordered_map>

#include "output/record_writer.hpp"
#include "output/results.hpp"
#include "records/coordinates.hpp"
#include "text/csv.hpp"
#include "text/error.hpp"
#include "text/json_scan.hpp"
#include "text/json_text.hpp"
#include "text/names.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {
namespace {

constexpr int kTableDigits = 9;
/// Bytes of bad records' rows that wait for the first good record.
constexpr std::size_t kMostEarly = 16 << 20;

/// A cell of a record that was not read as CSV.
struct OwnCell {
  std::string column;
  std::string text;        ///< as it is written
  std::string field = {};  ///< of a null, whose column or columns the first record has named
};

/// How many numbers a field has that is a vector of this tool: one of the results, or of what is read. 0: it is none.
std::size_t sizeOfVector(std::string_view name) {
  if (const ResultRow* row = findResult(name)) return row->kind == ResultKind::vector ? row->size : 0;
  for (const Coordinate* row : allCoordinates())
    if (row->name == name && row->form == CoordinateForm::array) return row->fewest;
  return 0;
}

/// The cells of a field: two to four numbers, or as many nulls, have a column each; in a table one.
void appendCells(std::vector<OwnCell>& cells, const std::string& name, std::string_view json,
                 const WriterSetup& setup) {
  const bool isNull = json == "null";
  std::vector<std::string_view> items(isNull ? sizeOfVector(name) : 0, "null");
  if (json.starts_with('[')) {
    JsonParts parts(json);
    while (const auto part = parts.next()) items.push_back(part->value);
  }
  const auto all = [&](const auto& is) { return std::all_of(items.begin(), items.end(), is); };
  const bool nulls = all([](std::string_view item) { return item == "null"; });
  if (items.size() >= 2 && items.size() <= 4 && (nulls || all([](auto item) { return beginsJsonNumber(item[0]); }))) {
    if (setup.table)
      cells.push_back({name, nulls ? "" : joined(items, " "), nulls ? name : ""});
    else
      for (std::size_t i = 0; i < items.size(); ++i)
        cells.push_back(
            {name + std::string(kColumnSuffixes[i]), std::string(nulls ? "" : items[i]), nulls ? name : std::string()});
  } else {
    const bool isText = json.starts_with('"');
    const std::string text = isText ? unescaped(json.substr(1, json.size() - 2)) : std::string(isNull ? "" : json);
    cells.push_back({name, quotedIfNeeded(text, setup.separator), isNull ? name : std::string()});
  }
}

/// A record that is not CSV as cells.
std::vector<OwnCell> ownCells(const Record& record, const WriterSetup& setup) {
  std::vector<OwnCell> cells;
  if (record.shape->form == Form::json && !record.shape->isArray) {
    const auto values = valuesOf(record);
    for (std::size_t i = 0; i < values.size(); ++i) appendCells(cells, record.shape->names[i], values[i], setup);
  } else {
    for (const NamedJson& field : asJsonFields(record, setup)) appendCells(cells, field.name, field.json, setup);
  }
  if (const auto again = firstRepeated(cells, [](const OwnCell& cell) -> std::string_view { return cell.column; }))
    throw RecordError(0, "would fill the column '" + cells[*again].column + "' twice");
  return cells;
}

/// The columns after the record's own.
std::vector<std::string> addedColumns(const WriterSetup& setup, const Results& results) {
  std::vector<std::string> columns = columnsOf(results, setup.prefix, setup.table);
  if (setup.keepGoing) columns.push_back(setup.prefix + std::string(kErrorName));
  return columns;
}

void requireNoClash(const std::vector<std::string>& own, const std::vector<std::string>& added) {
  for (const std::string& column : added)
    if (std::find(own.begin(), own.end(), column) != own.end())
      throw RecordError(0, "already has a column '" + column + "'; --prefix P puts P in front of the results' names");
}

/// The header line of records that are not CSV.
std::string headerLine(const WriterSetup& setup, const CsvColumns& columns) {
  if (!setup.header) return "";
  std::vector<std::string> names = columns.own;
  for (std::string& name : addedColumns(setup, columns.results)) names.push_back(std::move(name));
  for (std::string& name : names) name = quotedIfNeeded(name, setup.separator);
  return joined(names, std::string_view(&setup.separator, 1)) + "\n";
}

/// A cell of CSV under another separator. One that is no whole cell keeps its bytes, in quotes.
std::string recast(std::string_view cell, char from, char to) {
  const bool isWhole = isWholeField(cell);
  if (isWhole && from == to && cell.starts_with('"')) return std::string(cell);
  return quotedIfNeeded(isWhole ? csvValue(cell) : cell, to);
}

class CsvWriter final : public RecordWriter {
 public:
  CsvWriter(const WriterSetup& setup, CsvColumns& columns, TextBuffer& out)
      : RecordWriter(out), setup_(setup), columns_(columns) {}

  void beginRecord(const Record& record, const Results& results) override {
    start_ = out_.size();
    if (columns_.known && results != columns_.results)
      throw RecordError(0, "has other results than the first record; CSV has the columns of the first");
    if (columns_.fromCsv) {
      appendRow(record);
      return;
    }
    const auto cells = ownCells(record, setup_);
    if (!columns_.known) {
      columns_.own.clear();
      for (const OwnCell& cell : cells) columns_.own.push_back(cell.column);
      columns_.results = results;
      requireNoClash(columns_.own, addedColumns(setup_, results));
    }
    appendInOrder(cells);
  }

  void endRecord() override {
    if (setup_.keepGoing) cell(std::string_view());
    out_ += '\n';
    ++records_;
    if (columns_.known) return;
    const std::string row(out_.view().substr(start_));
    out_.truncate(start_);
    out_ += headerOfBadRecords(setup_, columns_);
    out_ += row;
    columns_.early.clear();
    columns_.known = true;
  }

  void cancelRecord() override {
    RecordWriter::cancelRecord();
    if (!columns_.known) columns_.own.clear();
  }

  /// A row of CSV keeps its own cells; of other records the message tells the line.
  void badRecord(std::string_view text, std::size_t line, const std::string& message) override {
    ++records_;
    std::vector<std::string_view> cells;
    if (columns_.fromCsv) splitCsvLine(text, cells, columns_.separator, columns_.own.size() + 1);
    const std::string full = columns_.fromCsv ? message : "line " + std::to_string(line) + ": " + message;
    if (!columns_.known) {
      columns_.early += full + '\0';
      if (columns_.early.size() > kMostEarly)
        throw InputError("no good record among so many bad ones; the first good one names the columns of CSV");
      return;
    }
    out_ += badRow(cells, full, setup_, columns_);
  }

  static std::string badRow(const std::vector<std::string_view>& cells, const std::string& message,
                            const WriterSetup& setup, const CsvColumns& columns) {
    std::string row;
    for (std::size_t i = 0; i < columns.own.size(); ++i)
      row += recast(i < cells.size() ? cells[i] : "", columns.separator, setup.separator) + setup.separator;
    row.append(addedColumns(setup, columns.results).size() - 1, setup.separator);
    return row + quotedIfNeeded(message, setup.separator) + "\n";
  }

  bool hasFixedColumns() const override { return true; }
  void number(const ResultRow&, double value) override { cell(value); }

  void vector(const ResultRow&, std::span<const double> values) override {
    const bool finite = std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
    if (!setup_.table) {
      for (const double value : values) cell(finite ? value : NAN);
      return;
    }
    std::string text;
    for (std::size_t i = 0; finite && i < values.size(); ++i)
      text += (i > 0 ? " " : "") + formatDigits(values[i], tableDigits());
    cell(std::string_view(text));
  }

  void flag(const ResultRow&, bool value) override {
    out_ += setup_.separator;
    out_ += value ? std::string_view("true") : std::string_view("false");
  }

  void text(const ResultRow& row, std::span<const std::string_view> words) override {
    if (row.kind == ResultKind::json && !words.empty() && words[0].starts_with('"'))
      cell(unescaped(words[0].substr(1, words[0].size() - 2)));
    else
      cell(words.size() == 1 ? words[0] : std::string_view(joined(words, " ")));
  }

 private:
  /// A line of CSV, in the output's format.
  void appendRow(const Record& record) {
    if (columns_.separator == setup_.separator) {
      out_ += record.text;
      return;
    }
    const auto cells = valuesOf(record);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (i > 0) out_ += setup_.separator;
      out_ += recast(cells[i], columns_.separator, setup_.separator);
    }
  }

  /// Under the columns of the first record, which may have other fields and another order.
  void appendInOrder(const std::vector<OwnCell>& cells) {
    const bool same = std::equal(cells.begin(), cells.end(), columns_.own.begin(), columns_.own.end(),
                                 [](const OwnCell& cell, const std::string& column) { return cell.column == column; });
    if (!same) findPlaces(cells);
    for (std::size_t i = 0; i < columns_.own.size(); ++i) {
      if (i > 0) out_ += setup_.separator;
      const OwnCell* const cell = same ? &cells[i] : inOrder_[i];
      if (cell) out_ += cell->text;
    }
  }

  void findPlaces(const std::vector<OwnCell>& cells) {
    inOrder_.assign(columns_.own.size(), nullptr);
    if (places_.empty())
      for (std::size_t i = 0; i < columns_.own.size(); ++i) places_.emplace(columns_.own[i], i);
    for (const OwnCell& cell : cells) {
      const auto place = places_.find(cell.column);
      if (place != places_.end())
        inOrder_[place->second] = &cell;
      else if (cell.field.empty() ||
               (!places_.contains(cell.field) && !places_.contains(cell.field + std::string(kColumnSuffixes[0]))))
        throw RecordError(0, "has '" + (cell.field.empty() ? cell.column : cell.field) +
                                 "', which the first record has not; CSV columns are the first record's");
    }
  }

  int tableDigits() const { return setup_.digits > 0 ? setup_.digits : kTableDigits; }

  void cell(double value) {
    if (!std::isfinite(value)) {
      cell(std::string_view());
    } else {
      out_ += setup_.separator;
      if (setup_.table)
        out_ += formatDigits(value, tableDigits());
      else
        appendNumber(out_, toDigits(value, setup_.digits));
    }
  }

  void cell(std::string_view text) {
    out_ += setup_.separator;
    if (!text.empty()) out_ += quotedIfNeeded(text, setup_.separator);
  }

  const WriterSetup& setup_;
  CsvColumns& columns_;
  std::unordered_map<std::string_view, std::size_t> places_;  ///< of the columns, once they are needed by name
  std::vector<const OwnCell*> inOrder_;
};

}  // namespace

CsvColumns csvColumns(const WriterSetup& setup, const CsvHeader& header, std::string_view line, char separator,
                      const Results& results, TextBuffer& out) {
  CsvColumns columns;
  columns.known = columns.fromCsv = true;
  columns.own = header.names;
  columns.results = results;
  columns.separator = separator;
  if (!header.present) return columns;
  const std::vector<std::string> added = addedColumns(setup, results);
  requireNoClash(columns.own, added);
  if (!setup.header) return columns;
  std::vector<std::string_view> cells;
  splitCsvLine(line, cells, separator);
  for (std::size_t i = 0; i < cells.size(); ++i)
    out += (i > 0 ? std::string(1, setup.separator) : "") + recast(cells[i], separator, setup.separator);
  for (const std::string& column : added) out += setup.separator + column;
  out += '\n';
  return columns;
}

std::string headerOfBadRecords(const WriterSetup& setup, const CsvColumns& columns) {
  std::string lines = headerLine(setup, columns);
  for (std::size_t at = 0, end; at < columns.early.size(); at = end + 1) {
    end = columns.early.find('\0', at);
    lines += CsvWriter::badRow({}, columns.early.substr(at, end - at), setup, columns);
  }
  return lines;
}

std::unique_ptr<RecordWriter> makeCsvWriter(const WriterSetup& setup, CsvColumns& columns, TextBuffer& out) {
  return std::make_unique<CsvWriter>(setup, columns, out);
}

}  // namespace viewproj::cmd
