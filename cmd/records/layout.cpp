#include "records/layout.hpp"

#include <algorithm>
#include <limits>

#include "text/csv.hpp"
#include "text/error.hpp"
#include "text/number.hpp"
#include "viewproj/geodesy.hpp"

namespace viewproj::cmd {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

std::string nameOf(const RecordParts& record, std::size_t field) {
  return record.shape.isArray ? "" : record.shape.names[field] + ": ";
}

double numberAt(const RecordParts& record, std::size_t field, std::string_view text) {
  const auto number = record.shape.form == Form::csv ? parseNumber(csvValue(text)) : parseNumber(text);
  if (number) return *number;
  throw RecordError(static_cast<std::size_t>(text.data() - record.text.data()),
                    nameOf(record, field) + inQuotes(text) + " is not a finite number" +
                        (text.find(',') == std::string_view::npos ? "" : "; decimals follow a point"));
}

bool isAbsent(std::string_view value, Form form) {
  if (form == Form::json) return value == "null";
  if (form == Form::text) return value == "NaN";
  return value.find_first_not_of(" \t\r\"") == std::string_view::npos;
}

/// What a part is of its field's value.
std::string_view innerValue(const RecordParts& record, const NumberField& part) {
  const std::string_view value = record.values[part.field];
  if (part.inner.empty() && part.items == 0) return value;
  std::size_t count = 0;
  std::string_view found;
  if (value.starts_with(part.items > 0 ? '[' : '{')) {
    JsonParts parts(value);
    for (auto item = parts.next(); item; item = parts.next(), ++count) {
      if (part.items == 0 && unescaped(item->key) == part.inner) {
        if (!found.empty())
          throw RecordError(record.offset(part.field), nameOf(record, part.field) + "has " + part.inner + " twice");
        found = item->value;
      }
      if (part.items > 0 && count == part.item) found = item->value;
    }
  }
  if (part.items > 0 ? count == part.items : !found.empty()) return found;
  throw RecordError(record.offset(part.field),
                    nameOf(record, part.field) +
                        (part.items > 0 ? "expected an array of " + std::to_string(part.items) + " points [x, y, z]"
                                        : "has no " + part.inner));
}

/// Of an array that is none, or of an object.
std::string expectedPoint(const NumberField& part) {
  if (part.point == PointForm::ofTheEarth) return kObjectsSay;
  const std::string array = "an array of " + std::to_string(part.fewest) +
                            (part.fewest == part.most ? "" : " or " + std::to_string(part.most)) + " numbers";
  return part.point == PointForm::none ? array : array + " or {\"x\": X, \"y\": Y, \"z\": Z}";
}

/// A point as an object; a place as the point that it is, whose numbers stand nowhere. texts: null, or those of its
/// slots. Returns how many numbers there are.
std::size_t readPointObject(const RecordParts& record, const NumberField& part, std::string_view value, double* numbers,
                            std::string& seaLevel, std::string_view* texts) {
  const std::string name = nameOf(record, part.field);
  const auto at = [&](std::string_view text) { return static_cast<std::size_t>(text.data() - record.text.data()); };
  std::optional<PointObject> object;
  try {
    object = pointObject(value);
  } catch (const RecordError& e) {
    throw RecordError(at(value), name + e.what());
  }
  if (!object || (object->isPlace && part.point == PointForm::vector))
    throw RecordError(at(value), name + "expected " + expectedPoint(part));
  if (object->isPlace && part.point == PointForm::point) throw RecordError(at(value), name + kNotOnEarth);
  for (std::size_t i = 0; i < object->parts.size(); ++i) {
    if (texts && !object->isPlace) texts[i] = object->parts[i];
    const auto number = parseNumber(object->parts[i]);
    if (!number)
      throw RecordError(at(object->parts[i]), name + std::string(object->names[i]) + ": " + inQuotes(object->parts[i]) +
                                                  " is not a finite number");
    numbers[i] = *number;
  }
  if (!object->isPlace) return object->parts.size();
  seaLevel = object->seaLevel;
  const Geodetic place{numbers[0], numbers[1], numbers[2]};
  if (!isPlace(place))
    throw RecordError(at(object->parts[0]),
                      name + "lat: " + inQuotes(object->parts[0]) + " is not from -90 to 90 degrees");
  const Vec3 p = geodeticToEcef(place);
  numbers[0] = p.x;
  numbers[1] = p.y;
  numbers[2] = p.z;
  return 3;
}

/// Returns how many there are.
std::size_t readArray(const RecordParts& record, const NumberField& part, std::string_view value, double* numbers,
                      std::string_view* texts) {
  const auto expected = [&] {
    return RecordError(static_cast<std::size_t>(value.data() - record.text.data()),
                       nameOf(record, part.field) + "expected " + expectedPoint(part));
  };
  if (!value.starts_with('[')) throw expected();
  std::size_t count = 0;
  JsonParts parts(value);
  while (const auto item = parts.next()) {
    const char c = item->value.empty() ? ' ' : item->value[0];
    if (count == part.most || (c != '-' && (c < '0' || c > '9'))) throw expected();
    if (texts) texts[count] = item->value;
    numbers[count++] = numberAt(record, part.field, item->value);
  }
  if (count < part.fewest) throw expected();
  if (part.point == PointForm::ofTheEarth && count == 3)
    throw RecordError(static_cast<std::size_t>(value.data() - record.text.data()),
                      nameOf(record, part.field) + bareTriple(kObjectsSay));
  return count;
}

}  // namespace

std::size_t Layout::slots() const {
  std::size_t slots = 0;
  for (const NumberField& part : parts) slots += part.most;
  return slots;
}

bool Layout::fits(const std::vector<std::string_view>& values) const {
  return std::all_of(forms.begin(), forms.end(),
                     [&](const FormOfField& form) { return form.holds(values[form.field]); });
}

void readNumbers(const RecordParts& record, const Layout& layout, Numbers& numbers, NumberTexts* texts) {
  double* slot = numbers.data();
  std::string_view* text = texts ? texts->data() : nullptr;
  for (const NumberField& part : layout.parts) {
    const std::string_view value = innerValue(record, part);
    std::size_t count = 0;
    if (part.mayBeAbsent && isAbsent(value, record.shape.form)) {
      count = 0;
    } else if (part.point != PointForm::none && value.starts_with('{') && record.shape.form == Form::json) {
      count = readPointObject(record, part, value, slot, numbers.seaLevel, text);
    } else if (part.isArray) {
      count = readArray(record, part, value, slot, text);
    } else {
      if (text) *text = value;
      slot[count++] = numberAt(record, part.field, value);
    }
    for (; count < part.most; ++count) slot[count] = kNone;
    slot += part.most;
    if (text) text += part.most;
  }
}

}  // namespace viewproj::cmd
