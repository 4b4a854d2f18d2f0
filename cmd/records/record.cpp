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

constexpr std::string_view kBlanks = " \t\r";

void splitText(std::string_view text, std::vector<std::string_view>& values) {
  for (std::size_t at = text.find_first_not_of(kBlanks);
       at != std::string_view::npos && values.size() <= kMostFields;) {
    const std::size_t end = std::min(text.find_first_of(kBlanks, at), text.size());
    values.push_back(text.substr(at, end - at));
    at = text.find_first_not_of(kBlanks, end);
  }
}

/// To the quote that closes, if one opens here; two are one of the field's own.
void passQuotes(const char*& at, const char* end) {
  if (at == end || *at != '"') return;
  for (++at; at < end && (*at != '"' || (at + 1 < end && at[1] == '"')); ++at)
    if (*at == '"') ++at;
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
  RecordParts record{text, {Form::text, true, 0, {}}, {}};
  splitText(text, record.values);
  requireFewFields(text, record.values);
  record.shape.size = record.values.size();
  return record;
}

RecordParts csvParts(std::string_view text, const Shape& header) {
  RecordParts record{text, header, {}};
  splitCsvLine(text, record.values, header.csv, kMostFields + 1);
  requireFewFields(text, record.values);
  requireNoLoneReturn(text, record.values);
  requireClosedFields(text, record.values, header.csv);
  const std::size_t size = record.values.size(), expected = header.size;
  if (size != expected)
    throw RecordError(size > expected ? record.offset(expected) : text.size(),
                      "has " + std::to_string(size) + (size == 1 ? " field" : " fields") + "; expected " +
                          std::to_string(expected) +
                          (header.hasHeader ? " as the header has" : " as the first line has"));
  return record;
}

std::size_t afterClosingQuote(std::string_view field) {
  constexpr std::size_t npos = std::string_view::npos;
  if (!field.starts_with('"')) return npos;
  std::size_t close = field.find('"', 1);
  while (close != npos && close + 1 < field.size() && field[close + 1] == '"') close = field.find('"', close + 2);
  return close == npos || close + 1 == field.size() ? npos : close + 1;
}

void requireNoLoneReturn(std::string_view record, const std::vector<std::string_view>& fields) {
  for (const std::string_view field : fields)
    if (const std::size_t at = field.find('\r'); at != std::string_view::npos && !field.starts_with('"'))
      throw RecordError(static_cast<std::size_t>(field.data() - record.data()) + at, kLoneReturn);
}

void requireClosedFields(std::string_view record, const std::vector<std::string_view>& fields,
                         const CsvFormat& format) {
  const std::string_view name = nameOfSeparator(format.separator);
  for (const std::string_view field : fields)
    if (const std::size_t at = afterClosingQuote(field); at != std::string_view::npos)
      throw RecordError(
          static_cast<std::size_t>(field.data() - record.data()) + at,
          "text after the quote that closes; expected " +
              (name.empty() ? inQuotes(std::string_view(&format.separator, 1)) : "a " + std::string(name)) +
              " or the end of the line");
}

std::vector<std::string_view> valuesOf(const Record& record) {
  std::vector<std::string_view> values;
  const Form form = record.shape->form;
  if (form == Form::json) {
    JsonParts parts(record.text);
    while (const auto part = parts.next()) values.push_back(part->value);
  }
  if (form == Form::csv) splitCsvLine(record.text, values, record.shape->csv);
  if (form == Form::text) splitText(record.text, values);
  return values;
}

std::vector<double> binaryNumbers(std::string_view bytes) {
  std::vector<double> numbers(bytes.size() / sizeof(double));
  std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(double));
  return numbers;
}

void splitCsvLine(std::string_view line, std::vector<std::string_view>& fields, const CsvFormat& format,
                  std::size_t most) {
  const char* at = line.data();
  const char* const end = at + line.size();
  if (format.isBlanks()) {
    const auto pass = [&] {
      while (at < end && format.separates(*at)) ++at;
    };
    for (pass(); at < end && fields.size() < most; pass()) {
      const char* const begin = at;
      passQuotes(at, end);
      while (at < end && !format.separates(*at)) ++at;
      fields.emplace_back(begin, at - begin);
    }
    return;
  }
  const char separator = format.separator;
  for (const char* begin = at;; begin = ++at) {
    passQuotes(at, end);
    while (at < end && *at != separator) ++at;
    fields.emplace_back(begin, at - begin);
    if (at == end || fields.size() == most) return;
  }
}

void requireFewFields(std::string_view text, const std::vector<std::string_view>& values) {
  if (values.size() > kMostFields)
    throw RecordError(static_cast<std::size_t>(values.back().data() - text.data()),
                      "has more than " + std::to_string(kMostFields) + " fields");
}

std::string csvValue(std::string_view field) {
  if (field.size() < 2 || field.front() != '"' || field.back() != '"') return std::string(field);
  std::string value;
  for (std::size_t i = 1; i + 1 < field.size(); ++i) {
    if (field[i] == '"' && field[i + 1] == '"' && i + 2 < field.size()) ++i;
    value += field[i];
  }
  return value;
}

std::optional<std::string> otherSeparator(const Shape& header) {
  if (header.form != Form::csv || header.names.size() != 1) return std::nullopt;
  for (const SeparatorName& other : kSeparators)
    if (header.names[0].find(other.separator) != std::string::npos)
      return "--delimiter " + std::string(other.name) + " separates columns by the " + std::string(other.plural) +
             " that stand here";
  return std::nullopt;
}

std::string whatIsThere(const Shape& shape) {
  constexpr std::size_t kMostShown = 60;
  if (shape.isArray || !shape.hasHeader || shape.names.empty()) return "";
  const bool csv = shape.form == Form::csv;
  std::string all;
  for (const std::string& name : shape.names) {
    if (all.size() > kMostShown) break;
    if (!all.empty()) all += csv ? std::string(1, shape.csv.separator) : ", ";
    all += name;
  }
  return (csv ? "; the header is " : "; its fields are ") + inQuotes(all, kMostShown);
}

std::string nameOfColumn(const std::vector<std::string>& names, std::size_t column) {
  return column < names.size() && !names[column].empty() ? names[column] : "column" + std::to_string(column + 1);
}

CsvHeader readCsvHeader(std::string_view line, const std::vector<std::string>& defaults,
                        const std::vector<std::size_t>& numbered, const CsvFormat& format) {
  CsvHeader header;
  std::vector<std::string_view> fields;
  splitCsvLine(line, fields, format, kMostFields + 1);
  const auto isWord = [&](std::string_view field) {
    const std::string value = csvValue(field);
    return value.find_first_not_of(" \t") != std::string::npos && !parseNumber(value);
  };
  if (numbered.empty()) {
    header.present = std::any_of(fields.begin(), fields.end(), isWord);
  } else {
    // A record with a bad number has good ones beside it; a header has none.
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
    std::string name = csvValue(fields[i]);
    const std::size_t first = name.find_first_not_of(" \t");
    name = first == std::string::npos ? "" : name.substr(first, name.find_last_not_of(" \t") - first + 1);
    if (name.empty()) name = nameOfColumn(header.names, i);
    header.names.push_back(std::move(name));
  }
  return header;
}

}  // namespace viewproj::cmd
