#include "records/number_plan.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "camera/sea_level.hpp"
#include "records/coordinates.hpp"
#include "text/csv.hpp"
#include "text/error.hpp"
#include "text/json_scan.hpp"
#include "text/json_text.hpp"
#include "text/number.hpp"
#include "text/utf8.hpp"
#include "viewproj/geodesy.hpp"

namespace viewproj::cmd {
namespace {

constexpr const char* kEarthObjects =
    "{\"lat\": LAT, \"lon\": LON, \"height\": HEIGHT} or {\"x\": X, \"y\": Y, \"z\": Z}";

// ---- What most records have, read at once

/// A number that needs no trimming or unquoting.
const char* readPlain(const char* at, const char* end, double& number) {
  at = readNumber(at, end, number);
  return at && std::isfinite(number) ? at : nullptr;
}

/// False does not mean that the numbers are wrong.
bool readPlainNumbers(const RecordView& record, const NumberPlan& plan, double* slot) {
  for (const NumberField& field : plan.fields) {
    if (!field.inner.empty() || field.items > 0) return false;
    if (!field.isArray) {
      *slot = field.field < record.numbers.size() ? record.numbers[field.field] : kNoNumber;
      const std::string_view value = record.values[field.field];
      const char* const end = value.data() + value.size();
      if (std::isnan(*slot) && readPlain(value.data(), end, *slot) != end) return false;
      ++slot;
      continue;
    }
    const auto point = std::find_if(record.points.begin(), record.points.end(),
                                    [&](const ScannedPoint& one) { return one.field == field.field; });
    if (point == record.points.end() || point->count < field.fewest || point->count > field.most) return false;
    if (point->isObject ? field.point == PointForm::none : field.point == PointForm::ofTheEarth && point->count == 3)
      return false;
    std::copy_n(point->numbers.begin(), point->count, slot);
    std::fill(slot + point->count, slot + field.most, kNoNumber);
    slot += field.most;
  }
  return true;
}

// ---- All others, and what is wrong with them

/// An error at a part of the record's text. The message begins with the field's name.
RecordError errorAt(const RecordView& record, const NumberField& field, std::string_view text,
                    const std::string& message) {
  const std::string name = record.schema->isArray ? "" : record.schema->names[field.field] + ": ";
  return {static_cast<std::size_t>(text.data() - record.text.data()), name + message};
}

std::string notFinite(std::string_view text) { return inQuotes(text) + " is not a finite number"; }

double numberAt(const RecordView& record, const NumberField& field, std::string_view text) {
  const auto number = record.schema->form == Form::csv ? parseNumber(csvValue(text)) : parseNumber(text);
  if (number) return *number;
  const char* const comma = text.find(',') == std::string_view::npos ? ""
                            : record.schema->form == Form::text      ? "; numbers with commas: --from csv"
                                                                     : "; decimals follow a point";
  throw errorAt(record, field, text, notFinite(text) + comma);
}

bool isAbsent(std::string_view value, Form form) {
  if (form == Form::json) return value == "null";
  if (form == Form::text) return value == "NaN";
  return value.find_first_not_of(" \t\r\"") == std::string_view::npos;
}

bool isKey(std::string_view written, std::string_view name) {
  return written.find('\\') == std::string_view::npos ? written == name : unescaped(written) == name;
}

/// A member of an object, or an item of an array by its number, from 0.
std::string_view memberOf(const RecordView& record, const NumberField& field, std::string_view value,
                          std::string_view name) {
  std::string_view found;
  const bool isList = value.starts_with('[');
  if (isList || value.starts_with('{')) {
    JsonParts parts(value);
    std::size_t count = 0;
    for (auto part = parts.next(); part; part = parts.next(), ++count) {
      if (isList ? std::to_string(count) != name : !isKey(part->key, name)) continue;
      if (!found.empty()) throw errorAt(record, field, value, "has " + std::string(name) + " twice");
      found = part->value;
    }
  }
  if (found.empty()) throw errorAt(record, field, value, "has no " + std::string(name));
  return found;
}

/// The text of a part within its field's value.
std::string_view innerValue(const RecordView& record, const NumberField& field) {
  std::string_view value = record.values[field.field], path = field.inner;
  while (!path.empty()) {
    const std::size_t dot = std::min(path.find('.'), path.size());
    value = memberOf(record, field, value, path.substr(0, dot));
    path.remove_prefix(std::min(dot + 1, path.size()));
  }
  if (field.items == 0) return value;
  std::size_t count = 0;
  std::string_view found;
  if (value.starts_with('[')) {
    JsonParts parts(value);
    for (auto item = parts.next(); item; item = parts.next(), ++count)
      if (count == field.item) found = item->value;
  }
  if (count == field.items) return found;
  throw errorAt(record, field, value, "expected an array of " + std::to_string(field.items) + " points [x, y, z]");
}

std::string expectedArray(const NumberField& field) {
  if (field.point == PointForm::ofTheEarth) return std::string("expected ") + kEarthObjects;
  return "expected an array of " + std::to_string(field.fewest) +
         (field.fewest == field.most ? "" : " or " + std::to_string(field.most)) + " numbers" +
         (field.point == PointForm::none ? "" : " or {\"x\": X, \"y\": Y, \"z\": Z}");
}

/// An object that is a point, with members x, y, z or lat, lon, height.
class PointObject {
 public:
  explicit PointObject(std::string_view json) {
    JsonParts parts(json);
    while (const auto part = parts.next()) {
      keys_.push_back(part->key);
      names_.push_back(unescaped(part->key));
      values_.push_back(part->value);
    }
    xyz_ = matchParts(names_, coordinates::xyz.required());
    place_ = matchParts(names_, coordinates::place.required());
  }

  bool isPoint() const { return isWhole(xyz_) || isPlace(); }
  bool isPlace() const { return isWhole(place_); }
  /// Why it is unclear which numbers the object has; empty if it is clear.
  std::string fault() const {
    if (isWhole(xyz_) && isPlace()) return "has both x, y, z and lat, lon, height; keep one of them";
    for (const PartMatch& match : matches())
      if (match.also)
        return "has both " + inQuotes(names_[*match.field]) + " and " + inQuotes(names_[*match.also]) +
               "; keep one of them";
    return "";
  }
  std::string_view name(std::size_t part) const { return row().parts[part].name; }
  std::string_view value(std::size_t part) const { return values_[*matches()[part].field]; }
  std::string_view seaLevelName() const {
    const std::size_t height = *place_[2].field;
    return isSeaLevelName(names_[height]) ? keys_[height] : "";
  }

 private:
  const Coordinate& row() const { return isPlace() ? coordinates::place : coordinates::xyz; }
  const std::vector<PartMatch>& matches() const { return isPlace() ? place_ : xyz_; }

  std::vector<std::string_view> keys_, values_;
  std::vector<std::string> names_;
  std::vector<PartMatch> xyz_, place_;
};

/// Reads a point object into three slots. A place becomes its ECEF point.
void readPointObject(const RecordView& record, const NumberField& field, std::string_view value, double* slots,
                     std::string_view& seaLevel) {
  ScannedPoint plain;
  if (passPoint(value.data(), value.data() + value.size(), plain)) {
    std::copy(plain.numbers.begin(), plain.numbers.end(), slots);
    return;
  }
  const PointObject object(value);
  if (!object.isPoint() || (object.isPlace() && field.point == PointForm::vector))
    throw errorAt(record, field, value, expectedArray(field));
  if (const std::string fault = object.fault(); !fault.empty()) throw errorAt(record, field, value, fault);
  if (object.isPlace() && field.point == PointForm::point) throw errorAt(record, field, value, kNotOnEarth);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto number = parseNumber(object.value(i));
    if (!number)
      throw errorAt(record, field, object.value(i), std::string(object.name(i)) + ": " + notFinite(object.value(i)));
    slots[i] = *number;
  }
  if (!object.isPlace()) return;
  const std::string_view name = object.seaLevelName();
  if (!hasGeoid()) seaLevel = name;
  Geodetic place{slots[0], slots[1], slots[2]};
  if (const std::string fault = faultOf(place); !fault.empty())
    throw errorAt(record, field, object.value(isPlace(place) ? 1 : 0), fault);
  if (hasGeoid() && !name.empty()) place.height += seaLevelAt(place.lat, place.lon);
  const Vec3 point = geodeticToEcef(place);
  for (std::size_t i = 0; i < 3; ++i) slots[i] = point[i];
}

/// Returns the count of numbers.
std::size_t readArray(const RecordView& record, const NumberField& field, std::string_view value, double* slots) {
  const auto expected = [&] { return errorAt(record, field, value, expectedArray(field)); };
  if (!value.starts_with('[')) throw expected();
  std::size_t count = 0;
  JsonParts parts(value);
  while (const auto item = parts.next()) {
    if (count == field.most || item->value.empty() || !beginsNumber(item->value[0])) throw expected();
    slots[count++] = numberAt(record, field, item->value);
  }
  if (count < field.fewest) throw expected();
  if (field.point == PointForm::ofTheEarth && count == 3)
    throw errorAt(record, field, value, bareTriple(kEarthObjects));
  return count;
}

/// Of a binary record.
void readBinary(const RecordView& record, const NumberPlan& plan, Numbers& numbers) {
  const Form form = record.schema->form;
  const std::vector<double> values = binaryNumbers(form, record.text);
  double* slot = numbers.data();
  std::size_t absent = 0;
  for (const NumberField& field : plan.fields) absent += field.mayBeAbsent && std::isnan(values[field.field]);
  numbers.isNull = plan.together > 0 && absent >= plan.together && std::isnan(values[plan.fields[0].field]);
  for (std::size_t i = 0; i < plan.fields.size(); ++i) {
    const NumberField& field = plan.fields[i];
    const double value = values[field.field];
    const bool mayBeNone = field.mayBeAbsent && (i >= plan.together || numbers.isNull);
    if (!std::isfinite(value) && !(mayBeNone && std::isnan(value)))
      throw RecordError(field.field * bytesOf(form),
                        std::string(std::isnan(value) ? "NaN" : "infinity") + " is not a finite number");
    *slot++ = value;
  }
}

}  // namespace

bool Condition::holds(std::string_view value) const {
  return (first == kPoint ? isPointValue(value) : value.starts_with(first)) == is;
}

std::size_t NumberPlan::slots() const {
  std::size_t slots = 0;
  for (const NumberField& field : fields) slots += field.most;
  return slots;
}

bool NumberPlan::fits(std::span<const std::string_view> values) const {
  return std::all_of(conditions.begin(), conditions.end(),
                     [&](const Condition& condition) { return condition.holds(values[condition.field]); });
}

void NumberPlan::append(const NumberPlan& more) {
  fields.insert(fields.end(), more.fields.begin(), more.fields.end());
  notes.insert(notes.end(), more.notes.begin(), more.notes.end());
}

void readNumbers(const RecordView& record, const NumberPlan& plan, Numbers& numbers) {
  if (isBinary(record.schema->form)) return readBinary(record, plan, numbers);
  if (readPlainNumbers(record, plan, numbers.data())) return;
  const Form form = record.schema->form;
  double* slot = numbers.data();
  std::size_t absent = 0;
  for (std::size_t i = 0; i < plan.fields.size(); ++i) {
    const NumberField& field = plan.fields[i];
    const std::string_view value = innerValue(record, field);
    std::size_t count = 0;
    if (field.mayBeAbsent && isAbsent(value, form)) {
      absent += i < plan.together;
    } else if (field.point != PointForm::none && value.starts_with('{') && form == Form::json) {
      readPointObject(record, field, value, slot, numbers.seaLevel);
      count = 3;
    } else if (field.isArray) {
      count = readArray(record, field, value, slot);
    } else {
      slot[count++] = numberAt(record, field, value);
    }
    std::fill(slot + count, slot + field.most, kNoNumber);
    slot += field.most;
  }
  if (absent == 0) return;
  numbers.isNull = absent == plan.together;
  for (std::size_t i = 0; i < plan.together && !numbers.isNull; ++i)
    if (const std::string_view value = innerValue(record, plan.fields[i]); isAbsent(value, form))
      throw errorAt(record, plan.fields[i], value, notFinite(value));
}

void noteSeaLevel(std::string_view name, NumberPlan& plan) {
  if (!isSeaLevelName(name)) return;
  plan.isAboveSea = hasGeoid();
  if (!plan.isAboveSea) plan.notes.push_back(seaLevelNote(name));
}

std::string faultOf(const Geodetic& place) {
  if (!isPlace(place)) return "lat: " + formatNumber(place.lat) + " is not from -90 to 90 degrees";
  if (!(std::fabs(place.lon) <= 360)) return "lon: " + formatNumber(place.lon) + " is not from -360 to 360 degrees";
  return {};
}

bool isPointValue(std::string_view json) {
  if (json.starts_with('{')) return PointObject(json).isPoint();
  if (!json.starts_with('[')) return false;
  std::size_t count = 0;
  JsonParts parts(json);
  while (const auto part = parts.next())
    if (part->value.empty() || !beginsNumber(part->value[0]) || ++count > coordinates::position.most) return false;
  return count >= coordinates::position.fewest;
}

std::string bareTriple(const std::string& way) {
  return "three numbers without names may be a place or metres from the Earth's centre; say which: " + way;
}

}  // namespace viewproj::cmd
