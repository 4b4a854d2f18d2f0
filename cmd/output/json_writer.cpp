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

/// A text line's number: as written if that is a JSON number, otherwise formatted anew ("+1", ".5"), or null ("NaN").
std::string jsonNumber(std::string_view written) {
  if (isJson(written)) return std::string(written);
  const auto number = parseNumber(written);
  return number ? formatNumber(*number) : "null";
}

/// A CSV cell: numbers, true and false as JSON writes them, an empty cell as null, anything else ("007") as a string.
std::string jsonCell(std::string_view cell) {
  const std::string value = csvValue(cell);
  if (value.find_first_not_of(" \t") == std::string::npos) return "null";
  const char first = value[0];
  const bool bare = first == '-' || (first >= '0' && first <= '9') || value == "true" || value == "false";
  if (bare && !cell.starts_with('"') && isJson(value)) return value;
  return jsonString(value);
}

/// Valid JSON has line breaks only between its tokens.
void appendOnOneLine(TextBuffer& out, std::string_view json) {
  if (json.find('\n') == std::string_view::npos && json.find('\r') == std::string_view::npos) {
    out += json;
    return;
  }
  for (char c : json)
    if (c != '\n' && c != '\r') out += c;
}

/// Each number under a name of its own.
std::vector<NamedJson> namedNumbers(const Record& record, const std::vector<std::string>& names) {
  std::vector<std::string> values;
  const auto asJson = [&](std::string_view value) {
    if (record.shape->form != Form::json)
      return value == "NaN" || parseNumber(value) ? jsonNumber(value) : jsonCell(value);
    TextBuffer line;
    appendOnOneLine(line, value);
    return std::string(line.view());
  };
  if (record.shape->form == Form::f64)
    for (const double number : binaryNumbers(record.text)) values.push_back(formatNumber(number));
  else
    for (const std::string_view value : valuesOf(record)) values.push_back(asJson(value));
  std::vector<NamedJson> fields;
  for (std::size_t i = 0; i < values.size(); ++i) fields.push_back({nameOfColumn(names, i), std::move(values[i])});
  return fields;
}

class JsonWriter final : public RecordWriter {
 public:
  JsonWriter(const WriterSetup& setup, TextBuffer& out) : RecordWriter(out), setup_(setup) {}

  void beginArray(std::string_view asWritten) override {
    if (!setup_.keepArrays) return;
    out_ += asWritten;
    inArray_ = true;
    inThisArray_ = 0;
    inDocument_ = asWritten.starts_with('{');
  }

  void endArray(std::string_view asWritten) override {
    if (!inArray_) return;
    if (inThisArray_ > 0) out_ += '\n';
    if (asWritten.empty()) asWritten = inDocument_ ? "]}" : "]";
    out_ += asWritten;
    out_ += '\n';
    inArray_ = false;
  }

  void beginRecord(const Record& record) override {
    start_ = out_.size();
    nextLabel_ = 0;
    depth_ = 0;
    beginItem();
    if (record.shape->form != Form::json || record.shape->isArray) {
      char before = '{';
      for (const NamedJson& field : asJsonFields(record, setup_)) {
        out_ += before;
        out_ += jsonString(field.name);
        out_ += ':';
        out_ += field.json;
        before = ',';
      }
      if (before == '{') out_ += '{';
      return;
    }
    // As written, without the closing brace.
    std::size_t end = record.text.size() - 1;
    while (isJsonSpace(record.text[end - 1])) --end;
    appendOnOneLine(out_, record.text.substr(0, end));
  }

  void endRecord() override {
    out_ += '}';
    finishItem();
  }

  void cancelRecord() override { out_.truncate(start_); }

  void badRecord(std::string_view, std::size_t line, const std::string& message) override {
    beginItem();
    out_ += "{\"line\":" + std::to_string(line) + ",\"" + setup_.prefix +
            "error\":" + nlohmann::json(message).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    out_ += '}';
    finishItem();
  }

  void number(const ResultRow& row, double value) override {
    beginField(row);
    appendNumber(out_, toDigits(value, setup_.digits));
  }

  void vector(const ResultRow& row, std::span<const double> values) override {
    beginField(row);
    for (double value : values)
      if (!std::isfinite(value)) {
        out_ += "null";
        return;
      }
    char before = '[';
    for (double value : values) {
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

  void names(const ResultRow& row, std::span<const std::string_view> values, bool always) override {
    if (values.empty() && !always) return;
    beginField(row);
    char before = '[';
    for (const std::string_view value : values) {
      out_ += before;
      out_ += '"';
      out_ += value;
      out_ += '"';
      before = ',';
    }
    if (before == '[') out_ += '[';
    out_ += ']';
  }

  void word(const ResultRow& row, std::string_view value) override {
    beginField(row);
    out_ += value.empty() ? std::string("null") : jsonString(value);
  }

  void json(const ResultRow& row, std::string_view value) override {
    beginField(row);
    out_ += value;
  }

  void group(const ResultRow& row, bool present, const std::function<void(ResultSink&)>& write) override {
    beginField(row);
    if (!present) {
      out_ += "null";
      return;
    }
    ++depth_;
    out_ += '{';
    write(*this);
    out_ += '}';
    --depth_;
  }

  void list(const ResultRow& row, std::size_t count,
            const std::function<void(ResultSink&, std::size_t)>& write) override {
    beginField(row);
    ++depth_;
    out_ += '[';
    for (std::size_t i = 0; i < count; ++i) {
      out_ += i > 0 ? std::string_view(",{") : std::string_view("{");
      write(*this, i);
      out_ += '}';
    }
    out_ += ']';
    --depth_;
  }

 private:
  void beginItem() {
    if (inArray_)
      out_ += inThisArray_ == 0 ? std::string_view("\n") : std::string_view(",\n");
    else if (joined_ && records_ > 0)
      out_ += ",\n";
  }

  void finishItem() {
    ++records_;
    ++inThisArray_;
    if (!inArray_ && !joined_) out_ += '\n';
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
    for (; nextLabel_ < labels_.size() && labels_[nextLabel_].first != &row; ++nextLabel_) {
    }
    if (nextLabel_ == labels_.size()) labels_.emplace_back(&row, ",\"" + setup_.prefix + std::string(row.name) + "\":");
    std::string_view label = labels_[nextLabel_++].second;
    if (out_.back() == '{') label.remove_prefix(1);
    out_ += label;
  }

  const WriterSetup& setup_;
  bool inArray_ = false, inDocument_ = false;
  std::size_t inThisArray_ = 0;
  std::size_t start_ = 0;
  std::vector<std::pair<const ResultRow*, std::string>> labels_;
  std::size_t nextLabel_ = 0;
  int depth_ = 0;  ///< of objects within the results
};

}  // namespace

std::string jsonString(std::string_view text) {
  try {
    return nlohmann::json(text).dump();
  } catch (const nlohmann::json::type_error&) {
    throw RecordError(0, "has text that is not UTF-8");
  }
}

std::vector<NamedJson> asJsonFields(const Record& record, const WriterSetup& setup) {
  const Shape& shape = *record.shape;
  if (!setup.numberNames.empty() && shape.isArray) return namedNumbers(record, setup.numberNames);
  if (shape.form == Form::json && (setup.arraySize == 0 || shape.size <= setup.arraySize)) {
    TextBuffer array;
    appendOnOneLine(array, record.text);
    return {{setup.arrayName, std::string(array.view())}};
  }
  std::vector<NamedJson> fields;
  if (shape.form == Form::csv) {
    const auto values = valuesOf(record);
    for (std::size_t i = 0; i < values.size(); ++i) fields.push_back({shape.names[i], jsonCell(values[i])});
    return fields;
  }
  std::vector<std::string> numbers;
  if (shape.form == Form::f64)
    for (double number : binaryNumbers(record.text)) numbers.push_back(formatNumber(number));
  else
    for (std::string_view value : valuesOf(record))
      numbers.push_back(shape.form == Form::json ? std::string(value) : jsonNumber(value));
  const std::size_t inArray = setup.arraySize == 0 ? numbers.size() : std::min(setup.arraySize, numbers.size());
  std::string array = "[";
  for (std::size_t i = 0; i < inArray; ++i) array += (i > 0 ? "," : "") + numbers[i];
  fields.push_back({setup.arrayName, array + "]"});
  if (inArray < numbers.size()) fields.push_back({setup.extraName, numbers[inArray]});
  return fields;
}

std::unique_ptr<RecordWriter> makeJsonWriter(const WriterSetup& setup, TextBuffer& out) {
  return std::make_unique<JsonWriter>(setup, out);
}

}  // namespace viewproj::cmd
