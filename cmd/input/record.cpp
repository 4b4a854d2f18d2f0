#include "input/record.hpp"

#include <algorithm>

#include "input/error.hpp"
#include "input/number.hpp"

namespace viewproj::cmd {
namespace {

std::string quoted(std::string_view text) {
  constexpr std::size_t kMostShown = 40;
  return "'" + std::string(text.substr(0, kMostShown)) + (text.size() > kMostShown ? "..." : "") + "'";
}

std::size_t offsetIn(std::string_view whole, std::string_view part) {
  return static_cast<std::size_t>(part.data() - whole.data());
}

}  // namespace

const Field* Record::find(std::string_view name) const {
  for (const Field& field : fields)
    if (field.name == name) return &field;
  return nullptr;
}

Record parseJsonRecord(std::string_view text, TextPosition position) {
  if (const auto fault = jsonFault(text)) throw RecordError(fault->offset, fault->message);
  Record record{Form::json, text, position, text.starts_with('['), {}};
  JsonParts parts(text);
  while (const auto part = parts.next()) {
    std::string name = unescaped(part->key);
    if (!record.isArray && record.find(name))
      throw RecordError(part->offset, "has the field " + quoted(name) + " twice");
    record.fields.push_back({std::move(name), part->value, offsetIn(text, part->value)});
  }
  return record;
}

Record parseTextRecord(std::string_view text, TextPosition position) {
  Record record{Form::text, text, position, true, {}};
  constexpr std::string_view kBlanks = " \t\r";
  for (std::size_t at = text.find_first_not_of(kBlanks); at != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(kBlanks, at), text.size());
    record.fields.push_back({"", text.substr(at, end - at), at});
    at = text.find_first_not_of(kBlanks, end);
  }
  return record;
}

std::vector<std::string_view> splitCsvLine(std::string_view text) {
  std::vector<std::string_view> fields;
  std::size_t begin = 0;
  bool inQuotes = false;
  for (std::size_t i = 0; i <= text.size(); ++i) {
    if (i == text.size() || (text[i] == ',' && !inQuotes)) {
      fields.push_back(text.substr(begin, i - begin));
      begin = i + 1;
    } else if (text[i] == '"') {
      inQuotes = !inQuotes;
    }
  }
  return fields;
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

CsvHeader readCsvHeader(std::string_view line, const std::vector<std::string>& defaults) {
  CsvHeader header;
  const auto fields = splitCsvLine(line);
  header.present = std::any_of(fields.begin(), fields.end(), [](std::string_view field) {
    const std::string value = csvValue(field);
    return value.find_first_not_of(" \t") != std::string::npos && !parseNumber(value);
  });
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (!header.present) {
      header.names.push_back(i < defaults.size() ? defaults[i] : "column" + std::to_string(i + 1));
      continue;
    }
    std::string name = csvValue(fields[i]);
    const std::size_t first = name.find_first_not_of(" \t");
    name = first == std::string::npos ? "" : name.substr(first, name.find_last_not_of(" \t") - first + 1);
    header.names.push_back(std::move(name));
  }
  return header;
}

Record parseCsvRecord(std::string_view text, TextPosition position, const CsvHeader& header) {
  Record record{Form::csv, text, position, false, {}};
  const auto fields = splitCsvLine(text);
  if (fields.size() != header.names.size())
    throw RecordError(fields.size() > header.names.size() ? offsetIn(text, fields[header.names.size()]) : text.size(),
                      "has " + std::to_string(fields.size()) + " fields; expected " +
                          std::to_string(header.names.size()) + " as the header has");
  for (std::size_t i = 0; i < fields.size(); ++i)
    record.fields.push_back({header.names[i], fields[i], offsetIn(text, fields[i])});
  return record;
}

double numberOf(const Field& field, Form form) {
  const auto number = form == Form::csv ? parseNumber(csvValue(field.value)) : parseNumber(field.value);
  if (!number)
    throw RecordError(field.offset,
                      (field.name.empty() ? "" : field.name + ": ") + quoted(field.value) + " is not a finite number");
  return *number;
}

std::vector<double> numbersOf(const Field& field, std::size_t fewest, std::size_t most) {
  const auto expected = [&] {
    return RecordError(field.offset, field.name + ": expected an array of " + std::to_string(fewest) +
                                         (fewest == most ? "" : " or " + std::to_string(most)) + " numbers");
  };
  if (!field.value.starts_with('[')) throw expected();
  std::vector<double> numbers;
  JsonParts parts(field.value);
  while (const auto part = parts.next()) {
    if (part->value.empty() || (part->value[0] != '-' && (part->value[0] < '0' || part->value[0] > '9')))
      throw expected();
    numbers.push_back(
        numberOf({field.name, part->value, field.offset + offsetIn(field.value, part->value)}, Form::json));
  }
  if (numbers.size() < fewest || numbers.size() > most) throw expected();
  return numbers;
}

bool isAbsent(const Field& field, Form form) {
  if (form == Form::json) return field.value == "null";
  return field.value.find_first_not_of(" \t\r\"") == std::string_view::npos;
}

}  // namespace viewproj::cmd
