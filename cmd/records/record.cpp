#include "records/record.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>

#include "text/csv.hpp"
#include "text/error.hpp"
#include "text/json_scan.hpp"
#include "text/json_text.hpp"
#include "text/number.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

const char* passAndRead(const char* at, const char* end, double& number) {
  number = kNoNumber;
  const char* const after = passJsonNumber(at, end, number);
  if (after && std::isnan(number)) (void)readNumber(at, after, number);
  return after;
}

}  // namespace

std::optional<std::size_t> Schema::find(std::string_view name) const {
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == name) return i;
  return std::nullopt;
}

const char* passPoint(const char* at, const char* end, ScannedPoint& point) {
  point.isObject = *at == '{';
  unsigned found = 0;
  for (point.count = 0; point.count < 3;) {
    at = passJsonSpace(at + 1, end);
    std::size_t axis = point.count;
    if (point.isObject) {
      if (end - at < 3 || at[0] != '"' || at[2] != '"') return nullptr;
      axis = static_cast<std::size_t>((at[1] | 0x20) - 'x');
      at = passJsonSpace(at + 3, end);
      if (axis > 2 || at == end || *at != ':') return nullptr;
      at = passJsonSpace(at + 1, end);
    }
    at = passAndRead(at, end, point.numbers[axis]);
    if (!at) return nullptr;
    found |= 1u << axis;
    ++point.count;
    at = passJsonSpace(at, end);
    if (at == end) return nullptr;
    if (*at != ',') break;
  }
  if (*at != (point.isObject ? '}' : ']')) return nullptr;
  return (point.isObject ? found == 7 : point.count > 1) ? at + 1 : nullptr;
}

std::size_t JsonFields::split(std::string_view text, bool anywhere) {
  keys.clear();
  values.clear();
  numbers.clear();
  points.clear();
  const char* at = text.data();
  const char* const end = at + text.size();
  if (at == end || !opensJson(*at)) return 0;
  isArray = *at == '[';
  const char closing = isArray ? ']' : '}';
  at = passJsonSpace(at + 1, end);
  if (at < end && *at == closing) return anywhere || !isArray ? static_cast<std::size_t>(at + 1 - text.data()) : 0;
  for (;; at = passJsonSpace(at + 1, end)) {
    if (!isArray) {
      const char* const after = passJsonString(at, end);
      if (!after) return 0;
      keys.emplace_back(at + 1, after - 1);
      at = passJsonSpace(after, end);
      if (at == end || *at != ':') return 0;
      at = passJsonSpace(at + 1, end);
    }
    double number = kNoNumber;
    const char* after = nullptr;
    if (at < end && beginsNumber(*at)) {
      after = passJsonNumber(at, end, number);
    } else if (isArray && !anywhere) {
      after = passJsonScalar(at, end);
    } else {
      ScannedPoint point{values.size()};
      if (at < end && opensJson(*at)) after = passPoint(at, end, point);
      if (after) points.push_back(point);
      if (!after) after = passJson(at, end, kDeepestJson - 1);
    }
    if (!after) return 0;
    values.emplace_back(at, after);
    numbers.push_back(number);
    if (values.size() > kMostFields) return 0;
    at = passJsonSpace(after, end);
    if (at == end) return 0;
    if (*at == closing) break;
    if (*at != ',') return 0;
  }
  // A key with escapes may be that of a document.
  const auto mayBeginDocument = [&] {
    return keys[0] == kRecordsField || keys[0].find('\\') != std::string_view::npos;
  };
  if (!anywhere && !isArray && mayBeginDocument()) return 0;
  return static_cast<std::size_t>(at + 1 - text.data());
}

void JsonFields::splitWhole(std::string_view text) {
  if (split(text, true) == text.size()) return;
  if (const auto fault = jsonFault(text)) throw RecordError(fault->offset, fault->message);
  requireFewFields(text, values);
  throw RecordError(0, kNoRecord);
}

Schema JsonFields::schema(std::string_view text) const {
  Schema schema{Form::json, isArray, values.size(), {}};
  for (const std::string_view key : keys) schema.names.push_back(unescaped(key));
  if (const auto again = firstRepeated(schema.names, std::identity()))
    throw RecordError(static_cast<std::size_t>(keys[*again].data() - text.data()) - 1,
                      "has the field " + inQuotes(schema.names[*again]) + " twice");
  return schema;
}

void splitText(std::string_view line, std::vector<std::string_view>& words) {
  const auto isSpace = [](char c) { return c == ' ' || c == '\t'; };
  words.clear();
  if (const std::size_t alone = line.find('\r'); alone != std::string_view::npos) throw RecordError(alone, kLoneReturn);
  auto at = std::find_if_not(line.begin(), line.end(), isSpace);
  while (at != line.end() && words.size() <= kMostFields) {
    const auto end = std::find_if(at, line.end(), isSpace);
    words.emplace_back(at, end);
    at = std::find_if_not(end, line.end(), isSpace);
  }
  requireFewFields(line, words);
}

void requireFewFields(std::string_view text, std::span<const std::string_view> values) {
  if (values.size() > kMostFields)
    throw RecordError(static_cast<std::size_t>(values[kMostFields].data() - text.data()),
                      "has more than " + std::to_string(kMostFields) + " fields");
}

std::vector<double> binaryNumbers(Form form, std::string_view bytes) {
  const std::size_t count = bytes.size() / bytesOf(form);
  std::vector<double> numbers(count);
  if (form == Form::f32) {
    std::vector<float> floats(count);
    std::memcpy(floats.data(), bytes.data(), count * sizeof(float));
    std::copy(floats.begin(), floats.end(), numbers.begin());
  } else {
    std::memcpy(numbers.data(), bytes.data(), count * sizeof(double));
  }
  return numbers;
}

std::string fieldsNote(const Schema& schema) {
  constexpr std::size_t kMostShown = 60;
  if (schema.isArray || !schema.hasHeader || schema.names.empty()) return "";
  const bool csv = schema.form == Form::csv;
  std::string all;
  for (const std::string& name : schema.names) {
    if (all.size() > kMostShown) break;
    if (!all.empty()) all += csv ? std::string(1, schema.separator) : ", ";
    all += name;
  }
  return (csv ? "; the header is " : "; its fields are ") + inQuotes(all, kMostShown);
}

std::string nameOfColumn(const std::vector<std::string>& names, std::size_t column) {
  return column < names.size() && !names[column].empty() ? names[column] : "column" + std::to_string(column + 1);
}

CsvHeader readCsvHeader(std::span<const std::string_view> fields, const std::vector<std::string>& defaults,
                        const std::vector<std::size_t>& numbered) {
  CsvHeader header;
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
