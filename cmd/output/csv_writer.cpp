#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "output/record_writer.hpp"
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

bool isTable(const WriterSetup& setup) { return setup.form == OutputForm::table; }

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
  if (items.size() >= 2 && items.size() <= 4 && (nulls || all([](auto item) { return beginsNumber(item[0]); }))) {
    if (isTable(setup))
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
std::vector<OwnCell> ownCells(const RecordView& record, const WriterSetup& setup) {
  std::vector<OwnCell> cells;
  if (record.schema->form == Form::json && !record.schema->isArray) {
    for (std::size_t i = 0; i < record.values.size(); ++i)
      appendCells(cells, record.schema->names[i], record.values[i], setup);
  } else {
    for (const NamedJson& field : asJsonFields(record, setup.stream)) appendCells(cells, field.name, field.json, setup);
  }
  if (const auto again = firstRepeated(cells, [](const OwnCell& cell) -> std::string_view { return cell.column; }))
    throw RecordError(0, "would fill the column '" + cells[*again].column + "' twice");
  return cells;
}

/// The columns after the record's own. Throws RecordError if one has the name of another; the one for errors may be the
/// record's own.
void addColumns(CsvColumns& columns, const ResultRows& rows, bool areNamed, const WriterSetup& setup) {
  const auto find = [&](const std::string& column) {
    return std::find(columns.own.begin(), columns.own.end(), column);
  };
  columns.rows = rows;
  columns.added = columnsOf(rows, setup.stream.prefix, isTable(setup));
  for (const std::string& column : columns.added)
    if (areNamed && find(column) != columns.own.end())
      throw RecordError(0, "already has a column '" + column + "'; --prefix P puts P in front of the results' names");
  columns.error.reset();
  if (!setup.stream.keepGoing) return;
  const std::string error = setup.stream.prefix + std::string(kErrorName);
  if (const auto own = find(error); own != columns.own.end())
    columns.error = static_cast<std::size_t>(own - columns.own.begin());
  else
    columns.added.push_back(error);
}

class CsvWriter final : public RecordWriter {
 public:
  CsvWriter(const WriterSetup& setup, CsvColumns& columns, TextBuffer& out)
      : RecordWriter(out), setup_(setup), columns_(columns) {}

  void writeBad(std::span<const std::string_view> values, std::size_t line, const std::string& message) override {
    if (!columns_.known) return;  // standard error tells it
    if (columns_.fromCsv)
      writeRow(values, message);
    else
      writeRow({}, "line " + std::to_string(line) + ": " + message);
  }

  void writeError(const RecordView& record, std::size_t line, std::size_t error) override {
    if (columns_.fromCsv)
      writeRow(record.values, "");
    else
      writeBad({}, line, plainText(record, error));
  }

 private:
  void append(const RecordView& record, const ResultRows& rows, ResultCursor values) override {
    if (columns_.known && rows != columns_.rows)
      throw RecordError(
          0, "has other results than the first record; " + std::string(formName()) + " has the columns of the first");
    if (columns_.fromCsv) {
      out_ += record.text;
    } else {
      const auto cells = ownCells(record, setup_);
      if (!columns_.known) begin(cells, rows);
      appendInOrder(cells);
    }
    for (const ResultRow* row : rows) appendResult(*row, values);
    if (setup_.stream.keepGoing && !columns_.error) appendCell("");
    out_ += '\n';
    // The first record's worker is alone; later the others only read it.
    if (!columns_.known) columns_.known = true;
  }

  std::string_view formName() const { return isTable(setup_) ? "a table" : "CSV"; }

  /// The header, of a first record that is not CSV.
  void begin(const std::vector<OwnCell>& cells, const ResultRows& rows) {
    columns_.own.clear();
    for (const OwnCell& cell : cells) columns_.own.push_back(cell.column);
    addColumns(columns_, rows, true, setup_);
    if (!setup_.stream.header) return;
    std::vector<std::string> names = columns_.own;
    names.insert(names.end(), columns_.added.begin(), columns_.added.end());
    for (std::string& name : names) name = quotedIfNeeded(name, setup_.separator);
    out_ += joined(names, std::string_view(&setup_.separator, 1));
    out_ += '\n';
  }

  /// A row without results: own cells as they are written, and more of them after the others.
  void writeRow(std::span<const std::string_view> cells, const std::string& error) {
    const std::size_t own = columns_.own.size();
    for (std::size_t i = 0; i < own; ++i) {
      if (i > 0) out_ += setup_.separator;
      if (columns_.error == i && !error.empty())
        out_ += quotedIfNeeded(error, setup_.separator);
      else if (i < cells.size())
        out_ += wholeCell(cells[i], setup_.separator);
    }
    for (std::size_t i = columns_.error ? 0 : 1; i < columns_.added.size(); ++i) out_ += setup_.separator;
    if (!columns_.error) appendCell(error);
    for (std::size_t i = own; i < cells.size(); ++i) {
      out_ += setup_.separator;
      out_ += wholeCell(cells[i], setup_.separator);
    }
    out_ += '\n';
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
    if (columnIndex_.empty())
      for (std::size_t i = 0; i < columns_.own.size(); ++i) columnIndex_.emplace(columns_.own[i], i);
    for (const OwnCell& cell : cells) {
      const auto column = columnIndex_.find(cell.column);
      if (column != columnIndex_.end())
        inOrder_[column->second] = &cell;
      else if (cell.field.empty() || (!columnIndex_.contains(cell.field) &&
                                      !columnIndex_.contains(cell.field + std::string(kColumnSuffixes[0]))))
        throw RecordError(0, "field '" + (cell.field.empty() ? cell.column : cell.field) +
                                 "' is not a field of the first record, whose fields are the columns of " +
                                 std::string(formName()));
    }
  }

  void appendResult(const ResultRow& row, ResultCursor& values) {
    switch (row.kind) {
      case ResultKind::number:
        return appendNumberCell(*values.number++);
      case ResultKind::flag:
        out_ += setup_.separator;
        out_ += flagText(*values.number++, "");
        return;
      case ResultKind::vector:
        return appendVector(row, values.vector(row.size));
      case ResultKind::names:
        if (values.skipsNone()) return (void)(out_ += setup_.separator);
        return appendNames(values.names(values.count()));
      case ResultKind::word:
        return appendCell(*values.word++);
      case ResultKind::json: {
        const std::string_view json = *values.word++;
        return appendCell(json.starts_with('"') ? unescaped(json.substr(1, json.size() - 2)) : std::string(json));
      }
      case ResultKind::group: {
        if (values.count() == 0) return appendNone(row);
        for (const ResultRow* part : row.parts) appendResult(*part, values);
        return;
      }
      case ResultKind::list:
        return;  // requireRoom refuses it
    }
  }

  void appendVector(const ResultRow& row, std::span<const double> numbers) {
    if (numbers.empty()) return appendNone(row);
    if (!isTable(setup_)) {
      for (const double number : numbers) appendNumberCell(number);
      return;
    }
    std::string text;
    for (const double number : numbers) text += (text.empty() ? "" : " ") + formatDigits(number, tableDigits());
    appendCell(text);
  }

  void appendNames(std::span<const std::string_view> names) {
    out_ += setup_.separator;
    for (const std::string_view& name : names) {
      if (&name != names.data()) out_ += ' ';
      out_ += name;
    }
  }

  void appendNone(const ResultRow& row) {
    if (row.kind == ResultKind::group) {
      for (const ResultRow* part : row.parts) appendNone(*part);
      return;
    }
    const bool isOne = row.kind != ResultKind::vector || isTable(setup_);
    for (std::size_t cells = isOne ? 1 : row.size; cells > 0; --cells) out_ += setup_.separator;
  }

  int tableDigits() const { return setup_.stream.digits > 0 ? setup_.stream.digits : kTableDigits; }

  void appendNumberCell(double value) {
    out_ += setup_.separator;
    if (std::isfinite(value))
      appendNumber(out_, toDigits(value, isTable(setup_) ? tableDigits() : setup_.stream.digits));
  }

  void appendCell(std::string_view text) {
    out_ += setup_.separator;
    if (needsQuotes(text, setup_.separator))
      out_ += quotedIfNeeded(text, setup_.separator);
    else
      out_ += text;
  }

  const WriterSetup& setup_;
  CsvColumns& columns_;
  std::unordered_map<std::string_view, std::size_t> columnIndex_;  ///< once columns are needed by name
  std::vector<const OwnCell*> inOrder_;
};

}  // namespace

CsvColumns csvColumns(const WriterSetup& setup, const CsvHeader& header, std::string_view line, const ResultRows& rows,
                      TextBuffer& out) {
  CsvColumns columns{.known = true, .fromCsv = true, .own = header.names};
  addColumns(columns, rows, header.present, setup);
  if (!header.present || !setup.stream.header) return columns;
  out += line;
  for (const std::string& column : columns.added) {
    out += setup.separator;
    out += column;
  }
  out += '\n';
  return columns;
}

std::unique_ptr<RecordWriter> makeCsvWriter(const WriterSetup& setup, CsvColumns& columns, TextBuffer& out) {
  return std::make_unique<CsvWriter>(setup, columns, out);
}

}  // namespace viewproj::cmd
