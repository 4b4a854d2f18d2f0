#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>
#include <unordered_set>

#include "output/record_writer.hpp"
#include "records/coordinates.hpp"
#include "text/csv.hpp"
#include "text/error.hpp"
#include "text/names.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {
namespace {

constexpr int kTableDigits = 9;

/// A cell of a record that was not read as CSV.
struct OwnCell {
  std::string column;
  std::string text;
  std::string emptyOf = {};  ///< a cell without a value: its field
};

bool isNumber(std::string_view json) { return !json.empty() && (json[0] == '-' || (json[0] >= '0' && json[0] <= '9')); }

/// A vector without a value: empty cells.
void appendEmptyCells(std::vector<OwnCell>& cells, const std::string& name, std::size_t size, bool table) {
  if (table || size == 0) cells.push_back({name, "", name});
  for (std::size_t i = 0; !table && i < size; ++i) cells.push_back({name + std::string(kColumnSuffixes[i]), "", name});
}

void appendCells(std::vector<OwnCell>& cells, const std::string& name, std::string_view json,
                 const WriterSetup& setup) {
  const bool table = setup.table;
  if (json.starts_with('[')) {
    std::vector<std::string_view> items;
    JsonParts parts(json);
    while (const auto part = parts.next()) items.push_back(part->value);
    const bool isShort = items.size() >= 2 && items.size() <= 4;
    if (isShort && std::all_of(items.begin(), items.end(), [](std::string_view item) { return item == "null"; })) {
      appendEmptyCells(cells, name, items.size(), table);
      return;
    }
    if (isShort && std::all_of(items.begin(), items.end(), isNumber)) {
      if (table) cells.push_back({name, ""});
      for (std::size_t i = 0; table && i < items.size(); ++i)
        cells.back().text += (i > 0 ? " " : "") + std::string(items[i]);
      if (table) return;
      for (std::size_t i = 0; i < items.size(); ++i)
        cells.push_back({name + std::string(kColumnSuffixes[i]), std::string(items[i])});
      return;
    }
  }
  std::string text = json == "null" ? "" : std::string(json);
  if (json.starts_with('"')) text = unescaped(json.substr(1, json.size() - 2));
  cells.push_back({name, quotedIfNeeded(text, setup.csv)});
}

/// How many numbers a field has that is a vector of this tool: one of the results, or of what is read. 0: it is none.
std::size_t sizeOfVector(std::string_view name) {
  if (const ResultRow* row = findResult(name)) return row->kind == ResultKind::vector ? row->size : 0;
  for (const Coordinate* row : allCoordinates())
    if (row->name == name && row->form == CoordinateForm::array) return row->fewest;
  return 0;
}

/// Into how many columns a field goes that is null: a vector of this tool into as many as it has numbers. With a prefix
/// a name is one where a result of the same prefix stands beside it. 0: no vector.
std::size_t columnsOfNull(const std::vector<std::string>& names, std::size_t field) {
  const std::string_view name = names[field];
  if (const std::size_t size = sizeOfVector(name)) return size;
  for (const ResultRow* row : allResults()) {
    if (row->kind != ResultKind::vector || !name.ends_with(row->name)) continue;
    const std::string_view prefix = name.substr(0, name.size() - row->name.size());
    if ((field > 0 && findResult(names[field - 1], prefix)) ||
        (field + 1 < names.size() && findResult(names[field + 1], prefix)))
      return row->size;
  }
  return 0;
}

/// What `project` writes before a list that it leaves out where that is empty, `outside`, and last that.
const std::vector<std::string_view>& namesUpToTheList() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> upTo;
    for (const PointResult& result : pointResults()) {
      upTo.push_back(result.row.name);
      if (result.row.kind == ResultKind::names) break;
    }
    return upTo;
  }();
  return names;
}

/// A line of CSV as one of another format.
void appendLine(std::string_view line, const CsvFormat& from, const CsvFormat& to, TextBuffer& out) {
  if (from == to) {
    out += line;
    return;
  }
  std::vector<std::string_view> cells;
  splitCsvLine(line, cells, from);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i > 0) out += to.separator;
    out += quotedIfNeeded(csvValue(cells[i]), to);
  }
}

/// Finds where that was: after the other results of a visible point.
class LeftOutFinder {
 public:
  explicit LeftOutFinder(const std::vector<std::string>& names) : names_(names) {}

  /// Its name, if it would stand after this field.
  std::optional<std::string> after(std::size_t field) {
    const auto before = std::span(namesUpToTheList()).first(namesUpToTheList().size() - 1);
    if (field + 1 < before.size() || !names_[field].ends_with(before.back())) return std::nullopt;
    const std::string prefix = names_[field].substr(0, names_[field].size() - before.back().size());
    for (std::size_t i = 0; i < before.size(); ++i)
      if (names_[field + 1 - before.size() + i] != prefix + std::string(before[i])) return std::nullopt;
    if (known_.empty()) known_.insert(names_.begin(), names_.end());
    std::string name = prefix + std::string(namesUpToTheList().back());
    return known_.contains(name) ? std::nullopt : std::optional(std::move(name));
  }

 private:
  const std::vector<std::string>& names_;
  std::unordered_set<std::string_view> known_;  ///< the names, once they are needed
};

/// A record of another form as cells: arrays of two to four numbers spread over columns.
std::vector<OwnCell> ownCells(const Record& record, const WriterSetup& setup) {
  std::vector<OwnCell> cells;
  if (record.shape->form == Form::json && !record.shape->isArray) {
    const auto values = valuesOf(record);
    const auto& names = record.shape->names;
    LeftOutFinder leftOut(names);
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (values[i] == "null")
        appendEmptyCells(cells, names[i], columnsOfNull(names, i), setup.table);
      else
        appendCells(cells, names[i], values[i], setup);
      if (values[i] != "true") continue;
      if (auto name = leftOut.after(i)) cells.push_back({std::move(*name), "", names[i]});
    }
  } else {
    for (const NamedJson& field : asJsonFields(record, setup)) appendCells(cells, field.name, field.json, setup);
  }
  if (const auto again = firstRepeated(cells, [](const OwnCell& cell) -> std::string_view { return cell.column; }))
    throw RecordError(0, "would fill the column '" + cells[*again].column + "' twice");
  return cells;
}

void requireNoClash(const std::vector<std::string>& own, const std::vector<std::string>& results) {
  for (const std::string& column : results)
    if (std::find(own.begin(), own.end(), column) != own.end())
      throw RecordError(0, "already has a column '" + column + "'; --prefix P puts P in front of the results' names");
}

void writeBadCells(const CsvColumns& columns, const std::string& message, const CsvFormat& format, TextBuffer& out) {
  for (std::size_t count = columns.own.size() + columns.results.size() - 1; count > 0; --count)
    out += quotedIfNeeded("", format) + format.separator;
  out += quotedIfNeeded(message, format) + "\n";
}

void writeHeader(const CsvColumns& columns, const CsvFormat& format, TextBuffer& out) {
  std::string separator;
  for (const auto* names : {&columns.own, &columns.results})
    for (const std::string& column : *names) {
      out += separator + quotedIfNeeded(column, format);
      separator = format.separator;
    }
  out += '\n';
}

class CsvWriter final : public RecordWriter {
 public:
  CsvWriter(const WriterSetup& setup, CsvColumns& columns, TextBuffer& out)
      : RecordWriter(out), setup_(setup), columns_(columns) {}

  void beginRecord(const Record& record) override {
    start_ = out_.size();
    headerIsNew_ = false;
    if (record.shape->form == Form::csv) {
      appendLine(record.text, record.shape->csv, setup_.csv, out_);
      return;
    }
    const auto cells = ownCells(record, setup_);
    if (!columns_.known) {
      std::vector<std::string> own;
      for (const OwnCell& cell : cells) own.push_back(cell.column);
      requireNoClash(own, columns_.results);
      columns_.own = std::move(own);
      headerIsNew_ = true;
    }
    if (std::equal(cells.begin(), cells.end(), columns_.own.begin(), columns_.own.end(),
                   [](const OwnCell& cell, const std::string& column) { return cell.column == column; })) {
      for (std::size_t i = 0; i < cells.size(); ++i) {
        if (i > 0) out_ += setup_.csv.separator;
        out_ += cells[i].text.empty() ? quotedIfNeeded("", setup_.csv) : cells[i].text;
      }
      return;
    }
    writeInOrder(cells);
  }

  void endRecord() override {
    if (setup_.keepGoing && !columns_.marks) cell(std::string_view());
    out_ += '\n';
    // From then on all workers read it. Whoever writes this block writes the header first.
    if (headerIsNew_) columns_.known = columns_.headerIsDue = true;
    ++records_;
  }

  void cancelRecord() override {
    out_.truncate(start_);
    if (headerIsNew_) columns_.own.clear();
  }

  /// As many own cells as there are columns, so that the message stands in its own. It says what there is no cell for:
  /// a record that was not CSV by its line.
  void badRecord(std::string_view text, std::size_t line, const std::string& message) override {
    ++records_;
    if (!columns_.fromCsv) {
      const std::string placed = "line " + std::to_string(line) + ": " + message;
      if (columns_.known)
        writeBadCells(columns_, placed, setup_.csv, out_);
      else
        columns_.early.add(placed);
      return;
    }
    std::vector<std::string_view> cells;
    splitCsvLine(text, cells, columns_.format, columns_.own.size() + 1);
    std::size_t unclosed = std::string_view::npos;
    (void)endOfCsvRecord(text, 0, columns_.format, &unclosed);
    // The rest of the row would be in its quotes.
    std::string_view leftOut;
    while (!cells.empty()) {
      const auto at = static_cast<std::size_t>(cells.back().data() - text.data());
      if (at < unclosed && cells.size() <= columns_.own.size()) break;
      leftOut = text.substr(at);
      cells.pop_back();
    }
    std::string full = leftOut.empty() ? message : message + "; not in this row: " + inQuotes(leftOut);
    if (columns_.marks && *columns_.marks < cells.size()) {
      const std::string before = csvValue(cells[*columns_.marks]);
      if (full.find(before) == std::string::npos) full += "; in place of " + inQuotes(before);
    }
    for (std::size_t i = 0; i < columns_.own.size(); ++i) {
      if (i > 0) out_ += setup_.csv.separator;
      if (i == columns_.marks) {
        out_ += quotedIfNeeded(full, setup_.csv);
      } else if (i >= cells.size()) {
        out_ += quotedIfNeeded("", setup_.csv);
      } else if (columns_.format == setup_.csv && cells[i].starts_with('"') &&
                 afterClosingQuote(cells[i]) == std::string_view::npos) {
        out_ += cells[i];
      } else {
        const bool closed = afterClosingQuote(cells[i]) == std::string_view::npos;
        out_ += quotedIfNeeded(closed ? csvValue(cells[i]) : std::string(cells[i]), setup_.csv);
      }
    }
    for (std::size_t i = 0; i < columns_.results.size(); ++i)
      cell(!columns_.marks && i + 1 == columns_.results.size() ? std::string_view(full) : std::string_view());
    out_ += '\n';
  }

  bool hasFixedColumns() const override { return true; }
  void number(const ResultRow&, double value) override { cell(value); }

  void vector(const ResultRow&, std::span<const double> values) override {
    const bool finite = std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
    if (!setup_.table) {
      for (double value : values) cell(finite ? value : NAN);
      return;
    }
    std::string text;
    for (std::size_t i = 0; finite && i < values.size(); ++i)
      text += (i > 0 ? " " : "") + formatDigits(values[i], tableDigits());
    cell(std::string_view(text));
  }

  void flag(const ResultRow&, bool value) override {
    out_ += setup_.csv.separator;
    out_ += value ? std::string_view("true") : std::string_view("false");
  }

  void names(const ResultRow&, std::span<const std::string_view> values, bool) override {
    if (setup_.csv.isBlanks()) {
      cell(std::string_view(joined(values, " ")));
      return;
    }
    char before = setup_.csv.separator;
    for (const std::string_view value : values) {
      out_ += before;
      out_ += value;
      before = ' ';
    }
    if (values.empty()) out_ += before;
  }

  void word(const ResultRow&, std::string_view value) override { cell(value); }

  void json(const ResultRow&, std::string_view value) override {
    if (value.starts_with('"'))
      cell(std::string_view(unescaped(value.substr(1, value.size() - 2))));
    else
      cell(value == "null" ? std::string_view() : value);
  }

  void group(const ResultRow&, bool, const std::function<void(ResultSink&)>& write) override { write(*this); }
  void list(const ResultRow&, std::size_t, const std::function<void(ResultSink&, std::size_t)>&) override {}

 private:
  /// Under the columns of the first record, which has other fields or another order.
  void writeInOrder(const std::vector<OwnCell>& cells) {
    if (places_.empty())
      for (std::size_t i = 0; i < columns_.own.size(); ++i) places_.emplace(columns_.own[i], i);
    std::vector<const OwnCell*> inOrder(columns_.own.size());
    for (const OwnCell& cell : cells) {
      const auto place = places_.find(cell.column);
      if (place != places_.end()) {
        inOrder[place->second] = &cell;
        continue;
      }
      const std::string& empty = cell.emptyOf;
      if (!empty.empty() && (places_.contains(empty) || places_.contains(empty + std::string(kColumnSuffixes[0]))))
        continue;
      throw RecordError(0, "has '" + (empty.empty() ? cell.column : empty) +
                               "', which the first record has not; CSV columns are the first record's");
    }
    for (std::size_t i = 0; i < inOrder.size(); ++i) {
      if (i > 0) out_ += setup_.csv.separator;
      if (inOrder[i] && !inOrder[i]->text.empty())
        out_ += inOrder[i]->text;
      else
        out_ += quotedIfNeeded("", setup_.csv);
    }
  }

  int tableDigits() const { return setup_.digits > 0 ? setup_.digits : kTableDigits; }

  void cell(double value) {
    if (!std::isfinite(value)) {
      cell(std::string_view());
    } else {
      out_ += setup_.csv.separator;
      if (setup_.table)
        out_ += formatDigits(value, tableDigits());
      else
        appendNumber(out_, toDigits(value, setup_.digits));
    }
  }

  void cell(std::string_view text) {
    out_ += setup_.csv.separator;
    if (text.empty() && !setup_.csv.isBlanks()) return;
    out_ += quotedIfNeeded(text, setup_.csv);
  }

  const WriterSetup& setup_;
  CsvColumns& columns_;
  std::unordered_map<std::string_view, std::size_t> places_;  ///< of the columns, once they are needed by name
  bool headerIsNew_ = false;
  std::size_t start_ = 0;
};

}  // namespace

CsvColumns csvColumns(const WriterSetup& setup, const CsvHeader* input, std::string_view line, const CsvFormat& format,
                      TextBuffer& out) {
  CsvColumns columns;
  columns.format = format;
  columns.results = columnsOf(setup.results, setup.prefix, setup.table);
  const std::string error = setup.prefix + std::string(kErrorName);
  if (setup.keepGoing && input && input->present)
    for (const ErrorColumn& own : errorColumns(input->names, setup.results))
      if (own.afterResult && input->names[own.column] == error) columns.marks = own.column;
  if (setup.keepGoing && !columns.marks) columns.results.push_back(error);
  if (!input) return columns;
  columns.known = columns.fromCsv = true;
  columns.own = input->names;
  if (!input->present) return columns;
  requireNoClash(columns.own, columns.results);
  if (!setup.header) return columns;
  appendLine(line, format, setup.csv, out);
  for (const std::string& column : columns.results) out += setup.csv.separator + column;
  out += '\n';
  return columns;
}

void writeDueHeader(CsvColumns& columns, const WriterSetup& setup, const std::function<void(std::string_view)>& write) {
  constexpr std::size_t kAtOnce = 64 << 10;
  TextBuffer out;
  if (setup.header) writeHeader(columns, setup.csv, out);
  columns.early.replay([&](const std::string& message) {
    writeBadCells(columns, message, setup.csv, out);
    if (out.size() < kAtOnce) return;
    write(out.view());
    out.clear();
  });
  write(out.view());
  columns.headerIsDue = false;
}

std::unique_ptr<RecordWriter> makeCsvWriter(const WriterSetup& setup, CsvColumns& columns, TextBuffer& out) {
  return std::make_unique<CsvWriter>(setup, columns, out);
}

}  // namespace viewproj::cmd
