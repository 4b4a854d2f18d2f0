#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "output/record_writer.hpp"
#include "text/csv.hpp"
#include "text/error.hpp"
#include "text/json_scan.hpp"
#include "text/json_text.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {
namespace {

/// A finite number as JSON writes it.
bool isJsonNumber(std::string_view text) {
  const char* const end = text.data() + text.size();
  return !text.empty() && beginsJsonNumber(text[0]) && passJson(text.data(), end, 0) == end;
}

/// A text line's number: as written if that is a JSON number, otherwise formatted anew ("+1", ".5"), or null ("NaN").
std::string jsonNumber(std::string_view written) {
  if (isJsonNumber(written)) return std::string(written);
  const auto number = parseNumber(written);
  return number ? formatNumber(*number) : "null";
}

/// Throws RecordError where text is not UTF-8.
void appendString(TextBuffer& out, std::string_view text) {
  const auto isPlain = [](unsigned char c) { return c >= ' ' && c < 0x7f && c != '"' && c != '\\'; };
  if (std::all_of(text.begin(), text.end(), isPlain)) {
    out += '"';
    out += text;
    out += '"';
    return;
  }
  try {
    out += nlohmann::json(text).dump();
  } catch (const nlohmann::json::type_error&) {
    throw RecordError(0, "has text that is not UTF-8");
  }
}

/// A CSV cell: numbers, true and false as JSON writes them, an empty cell as null, anything else ("007") as a string.
void appendCell(TextBuffer& out, std::string_view cell) {
  if (isJsonNumber(cell) || cell == "true" || cell == "false")
    out += cell;
  else if (const std::string value = csvValue(cell); trimmed(value).empty())
    out += "null";
  else
    appendString(out, value);
}

/// Valid JSON has line breaks only between its tokens.
std::string onOneLine(std::string_view json) {
  std::string line(json);
  std::erase_if(line, [](char c) { return c == '\n' || c == '\r'; });
  return line;
}

/// The values of a record without names, as JSON.
std::vector<std::string> jsonValues(const Record& record) {
  std::vector<std::string> values;
  if (record.shape->form == Form::f64) {
    for (const double number : binaryNumbers(record.text)) values.push_back(formatNumber(number));
    return values;
  }
  for (const std::string_view value : valuesOf(record)) {
    const bool isWord = record.shape->form != Form::json && value != "NaN" && !parseNumber(value);
    TextBuffer cell;
    if (isWord) appendCell(cell, value);
    values.push_back(isWord                             ? std::string(cell.view())
                     : record.shape->form == Form::json ? onOneLine(value)
                                                        : jsonNumber(value));
  }
  return values;
}

class JsonWriter final : public RecordWriter {
 public:
  JsonWriter(const WriterSetup& setup, TextBuffer& out) : RecordWriter(out), setup_(setup) {}

  void beginBlock(std::string_view closing) override {
    RecordWriter::beginBlock(closing);
    frame_ = {.closing = std::string(closing)};
    goesOn_ = !closing.empty();
  }

  ArrayFrame endBlock() override {
    if (goesOn_) leaveFirstArray();
    return frame_;
  }

  void beginArray(std::string_view asWritten) override {
    if (!setup_.keepArrays) return;
    out_ += asWritten;
    frame_.closing = asWritten.starts_with('{') ? "]}" : "]";
    frame_.open = 0;
  }

  void endArray(std::string_view asWritten) override {
    if (!setup_.keepArrays) return;
    if (goesOn_)
      leaveFirstArray();  // whether it is empty is not known here
    else if (frame_.open > 0)
      out_ += '\n';
    out_ += asWritten.empty() ? std::string_view(frame_.closing) : asWritten;
    out_ += '\n';
    frame_.closing.clear();
    frame_.open = 0;
    goesOn_ = false;
  }

  void beginRecord(const Record& record, const Results&) override {
    start_ = out_.size();
    nextLabel_ = 0;
    depth_ = 0;
    beginItem();
    if (record.shape->form == Form::csv) {
      writeRow(record);
    } else if (record.shape->form != Form::json || record.shape->isArray) {
      out_ += '{';
      for (const NamedJson& field : asJsonFields(record, setup_)) {
        if (out_.back() != '{') out_ += ',';
        appendString(out_, field.name);
        out_ += ':';
        out_ += field.json;
      }
    } else {
      // As written, without the closing brace.
      std::size_t end = record.text.size() - 1;
      while (isJsonSpace(record.text[end - 1])) --end;
      const std::string_view json = record.text.substr(0, end);
      if (json.find('\n') == std::string_view::npos && json.find('\r') == std::string_view::npos)
        out_ += json;
      else
        out_ += onOneLine(json);
    }
  }

  void endRecord() override {
    out_ += '}';
    finishItem();
  }

  void badRecord(std::string_view, std::size_t line, const std::string& message) override {
    beginItem();
    out_ += "{\"line\":" + std::to_string(line) + ",\"" + setup_.prefix + std::string(kErrorName) +
            "\":" + nlohmann::json(message).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    out_ += '}';
    finishItem();
  }

  void number(const ResultRow& row, double value) override {
    beginField(row);
    appendNumber(out_, toDigits(value, setup_.digits));
  }

  void vector(const ResultRow& row, std::span<const double> values) override {
    beginField(row);
    for (const double value : values)
      if (!std::isfinite(value)) {
        out_ += "null";
        return;
      }
    char before = '[';
    for (const double value : values) {
      out_ += before;
      appendNumber(out_, toDigits(value, setup_.digits));
      before = ',';
    }
    out_ += ']';
  }

  void flag(const ResultRow& row, bool value) override {
    beginField(row);
    out_ += value ? std::string_view("true") : std::string_view("false");
  }

  void text(const ResultRow& row, std::span<const std::string_view> words) override {
    beginField(row);
    if (row.kind == ResultKind::names) {
      out_ += '[';
      for (const std::string_view word : words) {
        if (out_.back() != '[') out_ += ',';
        out_ += '"';
        out_ += word;
        out_ += '"';
      }
      out_ += ']';
    } else if (words.empty()) {
      out_ += "null";
    } else if (row.kind == ResultKind::json) {
      out_ += words[0];
    } else {
      appendString(out_, words[0]);
    }
  }

  void object(const ResultRow& row, std::size_t count, const WriteParts& write) override {
    beginField(row);
    const bool isList = row.kind == ResultKind::list;
    if (count == 0 && !isList) {
      out_ += "null";
      return;
    }
    ++depth_;
    if (isList) out_ += '[';
    for (std::size_t i = 0; i < count; ++i) {
      out_ += i > 0 ? std::string_view(",{") : std::string_view("{");
      write(*this, i);
      out_ += '}';
    }
    if (isList) out_ += ']';
    --depth_;
  }

 private:
  void leaveFirstArray() {
    frame_.size = out_.size();
    frame_.records = frame_.open;
    frame_.open = 0;
  }

  void beginItem() {
    if (frame_.closing.empty()) return;
    // What stands before the first of an array that goes on, only the one who knows the block before can tell.
    if (frame_.open > 0)
      out_ += ",\n";
    else if (!goesOn_)
      out_ += '\n';
  }

  void finishItem() {
    ++records_;
    if (frame_.closing.empty())
      out_ += '\n';
    else
      ++frame_.open;
  }

  /// A line of CSV, whose columns are the same in all.
  void writeRow(const Record& record) {
    cells_.clear();
    splitCsvLine(record.text, cells_, record.shape->separator);
    for (std::size_t i = columnLabels_.size(); i < cells_.size(); ++i) {
      TextBuffer label;
      label += i > 0 ? ',' : '{';
      appendString(label, record.shape->names[i]);
      columnLabels_.emplace_back(std::string(label.view()) + ':');
    }
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      out_ += columnLabels_[i];
      appendCell(out_, cells_[i]);
    }
  }

  /// The result's name as it stands after the record's fields: results come in the same order again and again.
  void beginField(const ResultRow& row) {
    if (depth_ > 0) {
      if (out_.back() != '{') out_ += ',';
      out_ += '"';
      out_ += row.name;
      out_ += "\":";
      return;
    }
    while (nextLabel_ < labels_.size() && labels_[nextLabel_].first != &row) ++nextLabel_;
    if (nextLabel_ == labels_.size()) labels_.emplace_back(&row, ",\"" + setup_.prefix + std::string(row.name) + "\":");
    std::string_view label = labels_[nextLabel_++].second;
    if (out_.back() == '{') label.remove_prefix(1);
    out_ += label;
  }

  const WriterSetup& setup_;
  ArrayFrame frame_;     ///< of the block, as far as it goes
  bool goesOn_ = false;  ///< still in the array that stood open before the block
  std::vector<std::pair<const ResultRow*, std::string>> labels_;
  std::size_t nextLabel_ = 0;
  int depth_ = 0;  ///< of objects within the results
  std::vector<std::string_view> cells_;
  std::vector<std::string> columnLabels_;
};

}  // namespace

std::vector<NamedJson> asJsonFields(const Record& record, const WriterSetup& setup) {
  const std::size_t size = record.shape->size, inArray = setup.arraySize == 0 ? size : std::min(size, setup.arraySize);
  std::vector<NamedJson> fields;
  if (setup.numberNames.empty() && record.shape->form == Form::json && inArray == size) {
    fields.push_back({setup.arrayName, onOneLine(record.text)});
    return fields;
  }
  std::vector<std::string> values = jsonValues(record);
  if (setup.numberNames.empty()) {
    const auto rest = values.begin() + static_cast<std::ptrdiff_t>(inArray);
    fields.push_back({setup.arrayName, "[" + joined(std::vector(values.begin(), rest), ",") + "]"});
    if (inArray < size) fields.push_back({setup.extraName, *rest});
    return fields;
  }
  for (std::size_t i = 0; i < values.size(); ++i)
    fields.push_back({nameOfColumn(setup.numberNames, i), std::move(values[i])});
  return fields;
}

std::unique_ptr<RecordWriter> makeJsonWriter(const WriterSetup& setup, TextBuffer& out) {
  return std::make_unique<JsonWriter>(setup, out);
}

}  // namespace viewproj::cmd
