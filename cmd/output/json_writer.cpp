#include <algorithm>
#include <cmath>

#include "output/record_writer.hpp"
#include "text/csv.hpp"
#include "text/error.hpp"
#include "text/json_scan.hpp"
#include "text/json_text.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

/// A finite number as JSON writes it.
bool isJsonNumber(std::string_view text) {
  return !text.empty() && beginsNumber(text[0]) &&
         passJsonScalar(text.data(), text.data() + text.size()) == text.data() + text.size();
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
  if (!isUtf8(text)) throw RecordError(0, "has text that is not UTF-8");
  out += jsonOf(text);
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

void appendOnOneLine(TextBuffer& out, std::string_view json) {
  if (json.find('\n') == std::string_view::npos && json.find('\r') == std::string_view::npos)
    out += json;
  else
    out += onOneLine(json);
}

/// The values of a record without names, as JSON.
std::vector<std::string> jsonValues(const RecordView& record) {
  std::vector<std::string> values;
  const Form form = record.schema->form;
  if (isBinary(form))
    for (const double number : binaryNumbers(form, record.text)) {
      values.emplace_back();
      if (form == Form::f32)
        appendNumber(values.back(), static_cast<float>(number));
      else
        appendNumber(values.back(), number);
    }
  for (const std::string_view value : record.values) {
    const bool isWord = form != Form::json && value != "NaN" && !parseNumber(value);
    TextBuffer cell;
    if (isWord) appendCell(cell, value);
    values.push_back(isWord ? std::string(cell.view()) : form == Form::json ? onOneLine(value) : jsonNumber(value));
  }
  return values;
}

class JsonWriter final : public RecordWriter {
 public:
  JsonWriter(const WriterSetup& setup, TextBuffer& out) : RecordWriter(out), setup_(setup) {}

  void beginBlock(std::string_view closing) override {
    closing_ = closing;
    isFirst_ = true;
    goesOn_ = !closing.empty();
    joint_ = BlockJoint::none;
  }
  std::string_view closing() const override { return closing_; }
  BlockJoint joint() const override { return joint_; }

  void beginArray(std::string_view asWritten) override {
    if (!setup_.keepArrays) return;
    out_ += asWritten;
    closing_ = asWritten.starts_with('{') ? "]}" : "]";
    isFirst_ = true;
    goesOn_ = false;
  }

  void endArray(std::string_view asWritten) override {
    if (!setup_.keepArrays) return;
    if (!isFirst_)
      out_ += '\n';
    else if (goesOn_)
      joint_ = BlockJoint::end;
    out_ += asWritten.empty() ? closing_ : asWritten;
    out_ += '\n';
    closing_ = "";
  }

  void writeBad(std::span<const std::string_view>, std::size_t line, const std::string& message) override {
    beginItem();
    out_ += "{\"line\":" + std::to_string(line) + ",\"" + setup_.stream.prefix + std::string(kErrorName) +
            "\":" + jsonOf(message) + "}";
    endItem();
  }

  void writeError(const RecordView& record, std::size_t, std::size_t) override {
    beginItem();
    appendOwn(record);
    out_ += '}';
    endItem();
  }

 private:
  void append(const RecordView& record, const ResultRows& rows, ResultCursor values) override {
    beginItem();
    appendOwn(record);
    nextLabel_ = 0;
    for (const ResultRow* row : rows) {
      std::string_view label = labelOf(*row);
      if (out_.back() == '{') label.remove_prefix(1);
      out_ += label;
      appendResult(*row, values);
    }
    out_ += '}';
    endItem();
  }

  void beginItem() {
    if (closing_.empty()) return;
    if (!isFirst_)
      out_ += ",\n";
    else if (goesOn_)
      joint_ = BlockJoint::record;
    else
      out_ += '\n';
  }
  void endItem() {
    if (closing_.empty()) out_ += '\n';
    isFirst_ = false;
  }

  /// The record as an object that is not closed.
  void appendOwn(const RecordView& record) {
    if (record.schema->form == Form::csv) {
      appendRow(record);
    } else if (record.schema->form != Form::json || record.schema->isArray) {
      out_ += '{';
      for (const NamedJson& field : asJsonFields(record, setup_.stream)) {
        if (out_.back() != '{') out_ += ',';
        appendString(out_, field.name);
        out_ += ':';
        out_ += field.json;
      }
    } else {
      std::size_t end = record.text.size() - 1;
      while (isJsonSpace(record.text[end - 1])) --end;
      appendOnOneLine(out_, record.text.substr(0, end));
    }
  }

  /// A line of CSV, whose columns are the same in all.
  void appendRow(const RecordView& record) {
    for (std::size_t i = columnLabels_.size(); i < record.values.size(); ++i) {
      TextBuffer label;
      label += i > 0 ? ',' : '{';
      appendString(label, record.schema->names[i]);
      columnLabels_.emplace_back(std::string(label.view()) + ':');
    }
    for (std::size_t i = 0; i < record.values.size(); ++i) {
      out_ += columnLabels_[i];
      appendCell(out_, record.values[i]);
    }
  }

  /// The result's name as it stands after the record's fields: results come in the same order again and again.
  std::string_view labelOf(const ResultRow& row) {
    while (nextLabel_ < labels_.size() && labels_[nextLabel_].first != &row) ++nextLabel_;
    if (nextLabel_ == labels_.size())
      labels_.emplace_back(&row, ",\"" + setup_.stream.prefix + std::string(row.name) + "\":");
    return labels_[nextLabel_++].second;
  }

  void appendResult(const ResultRow& row, ResultCursor& values) {
    switch (row.kind) {
      case ResultKind::number:
        return appendNumber(out_, toDigits(*values.number++, setup_.stream.digits));
      case ResultKind::flag:
        out_ += flagText(*values.number++, "null");
        return;
      case ResultKind::vector:
        return appendVector(values.vector(row.size));
      case ResultKind::names:
        if (values.skipsNone()) return (void)(out_ += "null");
        return appendNames(values.names(values.count()));
      case ResultKind::word:
      case ResultKind::json: {
        const std::string_view word = *values.word++;
        if (word.empty())
          out_ += "null";
        else if (row.kind == ResultKind::json)
          out_ += word;
        else
          appendString(out_, word);
        return;
      }
      case ResultKind::group:
        if (values.count() == 0)
          out_ += "null";
        else
          appendParts(row, values);
        return;
      case ResultKind::list: {
        out_ += '[';
        for (std::size_t i = 0, count = values.count(); i < count; ++i) {
          if (i > 0) out_ += ',';
          appendParts(row, values);
        }
        out_ += ']';
        return;
      }
    }
  }

  void appendVector(std::span<const double> numbers) {
    if (numbers.empty()) {
      out_ += "null";
      return;
    }
    char before = '[';
    for (const double number : numbers) {
      out_ += before;
      appendNumber(out_, toDigits(number, setup_.stream.digits));
      before = ',';
    }
    out_ += ']';
  }

  void appendNames(std::span<const std::string_view> names) {
    out_ += '[';
    for (const std::string_view name : names) {
      if (out_.back() != '[') out_ += ',';
      out_ += '"';
      out_ += name;
      out_ += '"';
    }
    out_ += ']';
  }

  void appendParts(const ResultRow& row, ResultCursor& values) {
    out_ += '{';
    for (const ResultRow* part : row.parts) {
      if (part->leftOutIfNone && !std::isfinite(*values.number)) {
        ++values.number;
        continue;
      }
      if (out_.back() != '{') out_ += ',';
      out_ += '"';
      out_ += part->name;
      out_ += "\":";
      appendResult(*part, values);
    }
    out_ += '}';
  }

  const WriterSetup& setup_;
  std::string_view closing_;  ///< of the array that is open
  bool isFirst_ = false;      ///< the next record is the first of its array, or of its block where the array goes on
  bool goesOn_ = false;       ///< the array was open before the block
  BlockJoint joint_ = BlockJoint::none;
  std::vector<std::pair<const ResultRow*, std::string>> labels_;
  std::size_t nextLabel_ = 0;
  std::vector<std::string> columnLabels_;
};

}  // namespace

std::vector<NamedJson> asJsonFields(const RecordView& record, const StreamSetup& setup) {
  const std::size_t size = record.schema->size, inArray = setup.arraySize == 0 ? size : std::min(size, setup.arraySize);
  std::vector<NamedJson> fields;
  if (setup.numberNames.empty() && record.schema->form == Form::json && inArray == size) {
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

std::string plainText(const RecordView& record, std::size_t field) {
  const std::string_view value = record.values[field];
  if (record.schema->form == Form::csv) return csvValue(value);
  return value.starts_with('"') ? unescaped(value.substr(1, value.size() - 2)) : std::string(value);
}

std::unique_ptr<RecordWriter> makeJsonWriter(const WriterSetup& setup, TextBuffer& out) {
  return std::make_unique<JsonWriter>(setup, out);
}

}  // namespace viewproj::cmd
