#include "records/record.hpp"

#include <algorithm>
#include <cstring>
#include <functional>

#include "text/csv.hpp"
#include "text/error.hpp"
#include "text/names.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {
namespace {

void splitText(std::string_view text, std::vector<std::string_view>& values) {
  const auto isSpace = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  auto at = std::find_if_not(text.begin(), text.end(), isSpace);
  while (at != text.end() && values.size() <= kMostFields) {
    const auto end = std::find_if(at, text.end(), isSpace);
    values.emplace_back(at, end);
    at = std::find_if_not(end, text.end(), isSpace);
  }
}

/// Throws RecordError at the first value over the limit.
void requireFewFields(std::string_view text, const std::vector<std::string_view>& values) {
  if (values.size() > kMostFields)
    throw RecordError(static_cast<std::size_t>(values.back().data() - text.data()),
                      "has more than " + std::to_string(kMostFields) + " fields");
}

}  // namespace

std::optional<std::size_t> Shape::find(std::string_view name) const {
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == name) return i;
  return std::nullopt;
}

std::size_t RecordParts::offset(std::size_t field) const {
  return static_cast<std::size_t>(values[field].data() - text.data());
}

RecordParts jsonParts(std::string_view text) {
  if (const auto fault = jsonFault(text)) throw RecordError(fault->offset, fault->message);
  if (!text.starts_with('[') && !text.starts_with('{')) throw RecordError(0, kNoRecord);
  RecordParts record{text, {Form::json, text.starts_with('['), 0, {}}, {}};
  JsonParts parts(text);
  std::vector<std::size_t> offsets;
  while (const auto part = parts.next()) {
    if (!record.shape.isArray) {
      record.shape.names.push_back(unescaped(part->key));
      offsets.push_back(part->offset);
    }
    record.values.push_back(part->value);
    requireFewFields(text, record.values);
  }
  if (const auto again = firstRepeated(record.shape.names, std::identity()))
    throw RecordError(offsets[*again], "has the field " + inQuotes(record.shape.names[*again]) + " twice");
  record.shape.size = record.values.size();
  return record;
}

RecordParts textParts(std::string_view text) {
  if (const std::size_t alone = text.find('\r'); alone != std::string_view::npos) throw RecordError(alone, kLoneReturn);
  RecordParts record{text, {Form::text, true, 0, {}}, {}};
  splitText(text, record.values);
  requireFewFields(text, record.values);
  record.shape.size = record.values.size();
  return record;
}

RecordParts csvParts(std::string_view text, const Shape& header) {
  RecordParts record{text, header, {}};
  splitCsvLine(text, record.values, header.separator, kMostFields + 1);
  requireFewFields(text, record.values);
  requireWholeFields(text, record.values, header.separator);
  const std::size_t size = record.values.size(), expected = header.size;
  if (size != expected)
    throw RecordError(size > expected ? record.offset(expected) : text.size(),
                      "has " + std::to_string(size) + (size == 1 ? " field" : " fields") + "; expected " +
                          std::to_string(expected) +
                          (header.hasHeader ? " as the header has" : " as the first line has"));
  return record;
}

std::vector<std::string_view> valuesOf(const Record& record) {
  std::vector<std::string_view> values;
  const Form form = record.shape->form;
  if (form == Form::json) {
    JsonParts parts(record.text);
    while (const auto part = parts.next()) values.push_back(part->value);
  }
  if (form == Form::csv) splitCsvLine(record.text, values, record.shape->separator);
  if (form == Form::text) splitText(record.text, values);
  return values;
}

std::vector<double> binaryNumbers(std::string_view bytes) {
  std::vector<double> numbers(bytes.size() / sizeof(double));
  std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(double));
  return numbers;
}

std::string fieldsNote(const Shape& shape) {
  constexpr std::size_t kMostShown = 60;
  if (shape.isArray || !shape.hasHeader || shape.names.empty()) return "";
  const bool csv = shape.form == Form::csv;
  std::string all;
  for (const std::string& name : shape.names) {
    if (all.size() > kMostShown) break;
    if (!all.empty()) all += csv ? std::string(1, shape.separator) : ", ";
    all += name;
  }
  return (csv ? "; the header is " : "; its fields are ") + inQuotes(all, kMostShown);
}

std::string nameOfColumn(const std::vector<std::string>& names, std::size_t column) {
  return column < names.size() && !names[column].empty() ? names[column] : "column" + std::to_string(column + 1);
}

CsvHeader readCsvHeader(std::string_view line, const std::vector<std::string>& defaults,
                        const std::vector<std::size_t>& numbered, char separator) {
  CsvHeader header;
  std::vector<std::string_view> fields;
  splitCsvLine(line, fields, separator, kMostFields + 1);
  const auto isWord = [&](std::string_view field) {
    const std::string value = csvValue(field);
    return !trimmed(value).empty() && !parseNumber(value);
  };
  if (numbered.empty()) {
    header.present = std::any_of(fields.begin(), fields.end(), isWord);
  } else {
    // A record with a wrong number still has correct ones in other columns; a header has none.
    bool hasNumber = false;
    for (const std::size_t number : numbered) {
      if (number > fields.size()) continue;
      header.present |= isWord(fields[number - 1]);
      hasNumber |= parseNumber(csvValue(fields[number - 1])).has_value();
    }
    header.present &= !hasNumber;
  }
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (!header.present) {
      header.names.push_back(nameOfColumn(defaults, i));
      continue;
    }
    const std::string name(trimmed(csvValue(fields[i])));
    header.names.push_back(name.empty() ? nameOfColumn(header.names, i) : name);
  }
  return header;
}

}  // namespace viewproj::cmd
