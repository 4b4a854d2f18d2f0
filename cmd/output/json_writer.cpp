#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "input/error.hpp"
#include "input/number.hpp"
#include "output/number.hpp"
#include "output/record_writer.hpp"

namespace viewproj::cmd {
namespace {

/// A text line's number: as written if that is a JSON number, otherwise formatted anew ("+1", ".5"), or null ("NaN").
std::string jsonNumber(std::string_view text) {
  if (nlohmann::json::accept(text.begin(), text.end())) return std::string(text);
  const auto number = parseNumber(text);
  return number ? formatNumber(*number) : "null";
}

/// A CSV cell: numbers, true and false as JSON writes them, an empty cell as null, anything else ("007") as a string.
std::string jsonCell(const Field& field) {
  const std::string value = csvValue(field.value);
  if (value.find_first_not_of(" \t") == std::string::npos) return "null";
  const bool bare =
      !field.value.starts_with('"') && value != "null" && value[0] != '[' && value[0] != '{' && value[0] != '"';
  if (bare && nlohmann::json::accept(value)) return value;
  std::string text;
  appendJsonString(text, value);
  return text;
}

/// Valid JSON has line breaks only between its tokens.
void appendOnOneLine(std::string& out, std::string_view json) {
  for (char c : json)
    if (c != '\n' && c != '\r') out += c;
}

class JsonWriter final : public RecordWriter {
 public:
  JsonWriter(bool asArray, WriterSetup setup, std::string& out)
      : setup_(std::move(setup)), out_(out), wrapAll_(asArray) {}

  void beginArray() override {
    if (wrapAll_ && inArray_) return;
    out_ += '[';
    inArray_ = true;
    items_ = 0;
  }

  void endArray() override {
    out_ += items_ == 0 ? "]\n" : "\n]\n";
    inArray_ = false;
  }

  void beginRecord(const Record& record) override {
    start_ = out_.size();
    record_ = &record;
    beginItem();
    if (record.form != Form::json || record.isArray) {
      out_ += '{';
      for (const NamedJson& field : asJsonFields(record, setup_)) {
        if (out_.back() != '{') out_ += ',';
        appendJsonString(out_, field.name);
        out_ += ':';
        out_ += field.json;
      }
      return;
    }
    // As written, without the closing brace.
    const std::string_view body =
        record.text.substr(0, record.text.find_last_not_of(" \t\r\n", record.text.size() - 2) + 1);
    appendOnOneLine(out_, body);
  }

  void endRecord() override {
    out_ += '}';
    finishItem();
  }

  void cancelRecord() override { out_.resize(start_); }

  void badRecord(std::string_view, std::size_t line, const std::string& message) override {
    beginItem();
    out_ += "{\"line\":" + std::to_string(line) +
            ",\"error\":" + nlohmann::json(message).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    out_ += '}';
    finishItem();
  }

  void number(std::string_view name, double value) override {
    beginField(name);
    appendNumber(out_, value);
  }

  void vector(std::string_view name, std::span<const double> values) override {
    beginField(name);
    if (!std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); })) {
      out_ += "null";
      return;
    }
    out_ += '[';
    for (const double& value : values) {
      if (&value != values.data()) out_ += ',';
      appendNumber(out_, value);
    }
    out_ += ']';
  }

  void flag(std::string_view name, bool value) override {
    beginField(name);
    out_ += value ? "true" : "false";
  }

  void names(std::string_view name, std::span<const std::string_view> values, bool always) override {
    if (values.empty() && !always) return;
    beginField(name);
    out_ += '[';
    for (const std::string_view& value : values) {
      if (&value != values.data()) out_ += ',';
      appendJsonString(out_, value);
    }
    out_ += ']';
  }

 private:
  void beginItem() {
    if (inArray_) out_ += items_ == 0 ? "\n" : ",\n";
  }

  void finishItem() {
    ++items_;
    if (!inArray_) out_ += '\n';
  }

  void beginField(std::string_view name) {
    const std::string full = setup_.prefix + std::string(name);
    if (const Field* own = record_->find(full))
      throw RecordError(own->offset,
                        "already has a field '" + full + "'; --prefix P puts P in front of the results' names");
    if (out_.back() != '{') out_ += ',';
    out_ += '"';
    out_ += full;
    out_ += "\":";
  }

  WriterSetup setup_;
  std::string& out_;
  bool wrapAll_;
  bool inArray_ = false;
  std::size_t items_ = 0;
  std::size_t start_ = 0;
  const Record* record_ = nullptr;
};

}  // namespace

void appendJsonString(std::string& out, std::string_view text) {
  try {
    out += nlohmann::json(text).dump();
  } catch (const nlohmann::json::type_error&) {
    throw RecordError(0, "has text that is not UTF-8");
  }
}

std::vector<NamedJson> asJsonFields(const Record& record, const WriterSetup& setup) {
  std::vector<NamedJson> fields;
  if (record.form == Form::csv) {
    for (const Field& field : record.fields) fields.push_back({field.name, jsonCell(field)});
    return fields;
  }
  const std::size_t inArray =
      setup.arraySize == 0 ? record.fields.size() : std::min(setup.arraySize, record.fields.size());
  if (record.form == Form::json) {
    std::string array;
    appendOnOneLine(array, record.text);
    return {{setup.arrayName, array}};
  }
  std::string array = "[";
  for (std::size_t i = 0; i < inArray; ++i) {
    if (i > 0) array += ',';
    array += jsonNumber(record.fields[i].value);
  }
  fields.push_back({setup.arrayName, array + "]"});
  if (inArray < record.fields.size()) fields.push_back({setup.extraName, jsonNumber(record.fields[inArray].value)});
  return fields;
}

std::unique_ptr<RecordWriter> makeJsonWriter(bool asArray, WriterSetup setup, std::string& out) {
  return std::make_unique<JsonWriter>(asArray, std::move(setup), out);
}

}  // namespace viewproj::cmd
