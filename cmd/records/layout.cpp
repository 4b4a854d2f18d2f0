#include "records/layout.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "records/coordinates.hpp"
#include "text/error.hpp"
#include "text/json_scan.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

constexpr const char* kEarthObjects =
    "{\"lat\": LAT, \"lon\": LON, \"height\": HEIGHT} or {\"x\": X, \"y\": Y, \"z\": Z}";

/// An error at a part of the record's text. The message begins with the field's name.
RecordError errorAt(const RecordParts& record, const NumberField& part, std::string_view text,
                    const std::string& message) {
  const std::string name = record.shape.isArray ? "" : record.shape.names[part.field] + ": ";
  return {static_cast<std::size_t>(text.data() - record.text.data()), name + message};
}

std::string notFinite(std::string_view text) { return inQuotes(text) + " is not a finite number"; }

double numberAt(const RecordParts& record, const NumberField& part, std::string_view text) {
  const auto number = record.shape.form == Form::csv ? parseNumber(csvValue(text)) : parseNumber(text);
  if (number) return *number;
  const bool hasComma = text.find(',') != std::string_view::npos;
  throw errorAt(record, part, text, notFinite(text) + (hasComma ? "; decimals follow a point" : ""));
}

bool isAbsent(std::string_view value, Form form) {
  if (form == Form::json) return value == "null";
  if (form == Form::text) return value == "NaN";
  return value.find_first_not_of(" \t\r\"") == std::string_view::npos;
}

/// The text of a part within its field's value.
std::string_view innerValue(const RecordParts& record, const NumberField& part) {
  const std::string_view value = record.values[part.field];
  if (part.inner.empty() && part.items == 0) return value;
  std::size_t count = 0;
  std::string_view found;
  if (value.starts_with(part.items > 0 ? '[' : '{')) {
    JsonParts parts(value);
    for (auto item = parts.next(); item; item = parts.next(), ++count) {
      const bool isIt = part.items > 0 ? count == part.item : unescaped(item->key) == part.inner;
      if (isIt && !found.empty()) throw errorAt(record, part, value, "has " + part.inner + " twice");
      if (isIt) found = item->value;
    }
  }
  if (part.items > 0 ? count == part.items : !found.empty()) return found;
  throw errorAt(record, part, value,
                part.items > 0 ? "expected an array of " + std::to_string(part.items) + " points [x, y, z]"
                               : "has no " + part.inner);
}

std::string expectedArray(const NumberField& part) {
  if (part.point == PointForm::ofTheEarth) return std::string("expected ") + kEarthObjects;
  return "expected an array of " + std::to_string(part.fewest) +
         (part.fewest == part.most ? "" : " or " + std::to_string(part.most)) + " numbers" +
         (part.point == PointForm::none ? "" : " or {\"x\": X, \"y\": Y, \"z\": Z}");
}

/// An object that is a point, with members x, y, z or lat, lon, height.
class PointObject {
 public:
  explicit PointObject(std::string_view json) {
    JsonParts parts(json);
    while (const auto part = parts.next()) {
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
  std::string seaLevelName() const {
    const std::string& height = names_[*matches()[2].field];
    return isPlace() && isSeaLevelName(height) ? height : "";
  }

 private:
  const Coordinate& row() const { return isPlace() ? coordinates::place : coordinates::xyz; }
  const std::vector<PartMatch>& matches() const { return isPlace() ? place_ : xyz_; }

  std::vector<std::string> names_;
  std::vector<std::string_view> values_;
  std::vector<PartMatch> xyz_, place_;
};

/// Reads a point object into three slots. A place becomes its ECEF point, whose numbers have no text in the record.
/// texts: null, or the texts of the slots. Returns the count of numbers.
std::size_t readPointObject(const RecordParts& record, const NumberField& part, std::string_view value, double* slots,
                            std::string& seaLevel, std::string_view* texts) {
  const PointObject object(value);
  if (!object.isPoint() || (object.isPlace() && part.point == PointForm::vector))
    throw errorAt(record, part, value, expectedArray(part));
  if (const std::string fault = object.fault(); !fault.empty()) throw errorAt(record, part, value, fault);
  if (object.isPlace() && part.point == PointForm::point) throw errorAt(record, part, value, kNotOnEarth);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto number = parseNumber(object.value(i));
    if (!number)
      throw errorAt(record, part, object.value(i), std::string(object.name(i)) + ": " + notFinite(object.value(i)));
    slots[i] = *number;
    if (texts && !object.isPlace()) texts[i] = object.value(i);
  }
  if (!object.isPlace()) return 3;
  seaLevel = object.seaLevelName();
  const Geodetic place{slots[0], slots[1], slots[2]};
  if (const std::string fault = faultOf(place); !fault.empty())
    throw errorAt(record, part, object.value(isPlace(place) ? 1 : 0), fault);
  const Vec3 point = geodeticToEcef(place);
  for (std::size_t i = 0; i < 3; ++i) slots[i] = point[i];
  return 3;
}

/// Returns the count of numbers.
std::size_t readArray(const RecordParts& record, const NumberField& part, std::string_view value, double* slots,
                      std::string_view* texts) {
  const auto expected = [&] { return errorAt(record, part, value, expectedArray(part)); };
  if (!value.starts_with('[')) throw expected();
  std::size_t count = 0;
  JsonParts parts(value);
  while (const auto item = parts.next()) {
    if (count == part.most || item->value.empty() || !beginsJsonNumber(item->value[0])) throw expected();
    if (texts) texts[count] = item->value;
    slots[count++] = numberAt(record, part, item->value);
  }
  if (count < part.fewest) throw expected();
  if (part.point == PointForm::ofTheEarth && count == 3) throw errorAt(record, part, value, bareTriple(kEarthObjects));
  return count;
}

}  // namespace

bool FormOfField::holds(std::string_view value) const {
  return (first == kPoint ? isPointValue(value) : value.starts_with(first)) == is;
}

std::size_t Layout::slots() const {
  std::size_t slots = 0;
  for (const NumberField& part : parts) slots += part.most;
  return slots;
}

bool Layout::fits(const std::vector<std::string_view>& values) const {
  return std::all_of(forms.begin(), forms.end(),
                     [&](const FormOfField& form) { return form.holds(values[form.field]); });
}

void Layout::append(const Layout& more) {
  parts.insert(parts.end(), more.parts.begin(), more.parts.end());
  notes.insert(notes.end(), more.notes.begin(), more.notes.end());
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
      slot[count++] = numberAt(record, part, value);
    }
    for (; count < part.most; ++count) slot[count] = kNone;
    slot += part.most;
    if (text) text += part.most;
  }
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
    if (part->value.empty() || !beginsJsonNumber(part->value[0]) || ++count > coordinates::position.most) return false;
  return count >= coordinates::position.fewest;
}

std::string bareTriple(const std::string& way) {
  return "three numbers without names may be a place or metres from the Earth's centre; say which: " + way;
}

}  // namespace viewproj::cmd
