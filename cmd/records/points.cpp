#include "records/points.hpp"

#include <algorithm>
#include <cmath>

#include "camera/sea_level.hpp"
#include "text/error.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "text/utf8.hpp"
#include "viewproj/geodesy.hpp"
#include "viewproj/screen.hpp"

namespace viewproj::cmd {
namespace {

using Conditions = std::vector<Condition>;

/// The kind of a pixel's plan: the distances after its two numbers, in this order.
enum PixelParts : unsigned { depthKnown = 1, viewDistanceKnown = 2, rangeKnown = 4 };

bool isNameless(const Schema& schema) { return schema.isArray || (schema.form == Form::csv && !schema.hasHeader); }

/// The record's names for the parts of a plan: "x,y,z".
std::string namesIn(const NumberPlan& plan, const Schema& schema) {
  std::vector<std::string_view> names;
  for (const NumberField& part : plan.fields)
    if (names.empty() || names.back() != schema.names[part.field]) names.push_back(schema.names[part.field]);
  return visible(joined(names, ","));
}

RecordError hasBoth(std::size_t offset, const std::string& one, const std::string& other, bool choosable) {
  return {offset, "has both " + one + " and " + other +
                      (choosable ? "; keep one of them, or choose by --columns" : "; keep one of them")};
}

// Finding a row in the names of a record

/// A column or field for each part; nothing if a required one is missing.
std::optional<NumberPlan> findEach(const RecordView& record, std::span<const CoordinatePart> parts,
                                   std::size_t required, bool orNull) {
  const auto& names = record.schema->names;
  const std::vector<PartMatch> matches = matchParts(names, parts);
  if (!isWhole(std::span(matches).first(required))) return std::nullopt;
  NumberPlan plan;
  for (const auto& [field, also] : matches) {
    if (!field) break;
    if (also) throw hasBoth(record.offset(*also), inQuotes(names[*field]), inQuotes(names[*also]), true);
    if (parts.data() != std::data(coordinates::kMap)) noteSeaLevel(names[*field], plan);  // in a map's own heights
    plan.fields.push_back({*field, 1, 1, false, orNull});
  }
  return plan;
}

/// CSV columns of a row. Those of an array are NAME_x, NAME_y, ..., where NAME may be an alias; of a shape min_x, minX
/// or xmin.
std::optional<NumberPlan> findColumns(const Coordinate& row, const RecordView& record) {
  std::vector<std::vector<std::string>> spellings = {columnsOf(row)};
  for (const std::string_view alias : row.aliases) {
    spellings.emplace_back();
    for (std::size_t i = 0; i < row.most; ++i)
      spellings.back().push_back(std::string(alias) + std::string(kColumnSuffixes[i]));
  }
  if (row.form == CoordinateForm::object)
    for (const bool isAxisFirst : {false, true}) {
      std::vector<std::string> names;
      for (const CoordinatePart& part : row.parts)
        for (std::size_t i = 0; i < part.size; ++i) {
          const std::string name(part.name), axis(part.size > 1 ? 1 : 0, "xyz"[i]);
          names.push_back(isAxisFirst ? axis + name : name + axis);
        }
      spellings.push_back(std::move(names));
    }
  std::optional<NumberPlan> found;
  for (const std::vector<std::string>& names : spellings) {
    std::vector<CoordinatePart> parts;
    for (const std::string& name : names) parts.push_back({name});
    auto plan = parts.empty() ? std::nullopt : findEach(record, parts, row.fewest, row.orNull);
    if (plan && found) throw hasBoth(0, namesIn(*found, *record.schema), namesIn(*plan, *record.schema), true);
    if (plan) found = std::move(plan);
    if (found && row.isNameFirst && &names == &spellings[0]) break;
  }
  return found;
}

/// A JSON field with the row's name or alias. An array with the row's name counts whatever its value
/// is; a shape, or an alias, only if its value has the right form, which is then a condition.
std::optional<NumberPlan> findField(const Coordinate& row, const RecordView& record, Conditions& conditions) {
  const auto& names = record.schema->names;
  const CoordinatePart rowName{row.name}, rowOrAlias{row.name, 1, row.aliases};
  const bool isArray = row.form == CoordinateForm::array;
  const bool isByName = row.isNameFirst && std::any_of(names.begin(), names.end(),
                                                       [&](const auto& name) { return hasName(name, rowName); });
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!isNamed(names[i], isByName ? rowName : rowOrAlias)) continue;
    if (!isArray || !hasName(names[i], rowName)) {
      Condition condition{i, row.form == CoordinateForm::object ? '{' : isArray ? Condition::kPoint : '['};
      condition.is = condition.holds(record.values[i]);
      conditions.push_back(condition);
      if (!condition.is) continue;
    }
    if (found) throw hasBoth(record.offset(i), inQuotes(names[*found]), inQuotes(names[i]), false);
    found = i;
  }
  if (!found) return std::nullopt;
  NumberPlan plan;
  const auto add = [&](NumberField part) {
    part.field = *found;
    part.isArray = part.most > 1;
    if (part.most > 2) part.point = row.kind == kindDirection ? PointForm::vector : PointForm::point;
    plan.fields.push_back(std::move(part));
  };
  if (isArray) add({.fewest = row.fewest, .most = row.most, .mayBeAbsent = row.orNull});
  for (const CoordinatePart& part : row.parts)
    add({.fewest = part.size, .most = part.size, .inner = std::string(part.name)});
  if (row.form == CoordinateForm::points)
    for (std::size_t i = 0; i < row.fewest; ++i) add({.fewest = 3, .most = 3, .item = i, .items = row.fewest});
  return plan;
}

/// The parts of a row in a record, if all required ones are there. Throws RecordError if two fields fit a part.
std::optional<NumberPlan> find(const Coordinate& row, const RecordView& record, Conditions& conditions) {
  std::optional<NumberPlan> plan = row.form == CoordinateForm::numbers
                                       ? findEach(record, row.required(), row.fewest, row.orNull)
                                   : record.schema->form == Form::csv ? findColumns(row, record)
                                                                      : findField(row, record, conditions);
  if (plan) plan->kind = row.kind;
  if (plan && row.orNull) plan->together = plan->fields.size();
  return plan;
}

/// "has lat but no height", if a record has some parts of a row; otherwise empty.
std::string missingParts(const Coordinate& row, const Schema& schema) {
  const std::vector<PartMatch> matches = matchParts(schema.names, row.required());
  std::vector<std::string_view> there, missing;
  for (std::size_t i = 0; i < matches.size(); ++i)
    (matches[i].field ? there : missing)
        .push_back(matches[i].field ? schema.names[*matches[i].field] : row.parts[i].name);
  // A single part that is not the first one may mean anything.
  if (!matches[0].field && there.size() < 2) return "";
  return "has " + visible(together(there)) + " but no " + std::string(missing[0]) + fieldsNote(schema);
}

/// The first fields, one number each. together: so many of them have a value all, or none; 0: all have one.
NumberPlan firstFields(std::size_t count, std::size_t together) {
  NumberPlan plan;
  for (std::size_t i = 0; i < count; ++i) plan.fields.push_back({i, 1, 1, false, together > 0});
  plan.together = together;
  return plan;
}

/// Of a record with so many numbers too few or too many.
[[noreturn]] void failWithCount(const RecordView& record, const std::string& expected) {
  const Schema& schema = *record.schema;
  if (const std::size_t comma = record.text.find(','); schema.form == Form::text && comma != std::string_view::npos)
    throw RecordError(comma, "has commas between its numbers; --from csv reads them");
  for (std::size_t i = 0; schema.form == Form::text && i < schema.size; ++i)
    if (!parseNumber(record.values[i]))
      throw RecordError(record.offset(i),
                        "expected numbers, got " + inQuotes(record.values[i]) + "; --columns picks some, as in 2,3,4");
  throw RecordError(
      0, "has " + std::to_string(schema.size) + (schema.size == 1 ? " number" : " numbers") + "; expected " + expected);
}

// Points and shapes

NumberPlan findChosenPoint(const RecordView& record, const PointReading& reading) {
  NumberPlan plan = chosenFields(reading.columns, record, false);
  plan.together = 3;
  for (std::size_t i = 0; i < plan.together; ++i) plan.fields[i].mayBeAbsent = true;
  const bool isPlace = reading.columns.has("lat"), isSphere = reading.columns.has("radius");
  if (isPlace && !reading.worldIsEcef) throw RecordError(0, kNotOnEarth);
  plan.kind = isSphere ? (isPlace ? kindPlacedSphere : kindRoundPoint) : (isPlace ? kindPlace : kindPoint);
  return plan;
}

/// A point from numbers without names.
NumberPlan findBarePoint(const RecordView& record, const PointReading& reading) {
  constexpr std::size_t kMatrix = 16;
  const Schema& schema = *record.schema;
  const bool isJson = schema.form == Form::json;
  const std::string matrix = schema.size == kMatrix ? "; info reads a matrix" : "";
  if (schema.size != 3 && !(isJson && schema.size == 4))
    failWithCount(record,
                  std::string("x y z") +
                      (isJson            ? " or x y z w"
                       : schema.size > 3 ? "; --columns picks three: 1,2,3, or 2,3,4 behind an id; x,y,z,w takes four"
                                         : "") +
                      matrix);
  if (reading.worldIsEcef && schema.size == 3 && !isBinary(schema.form))
    throw RecordError(0, bareTriple(std::string(isJson ? "lat, lon, height or x, y, z of an object, " : "") +
                                    "--columns lat,lon,height or --columns x,y,z"));
  return firstFields(schema.size, isJson ? 0 : 3);
}

/// A point and its pixel from five numbers without names.
NumberPlan findBarePair(const RecordView& record, const PointReading& reading) {
  if (record.schema->size != 5) failWithCount(record, "x y z u v");
  if (reading.worldIsEcef) throw RecordError(0, bareTriple("--columns lat,lon,height,u,v or --columns x,y,z,u,v"));
  return firstFields(5, 0);
}

struct Found {
  const Coordinate* row;
  NumberPlan plan;
};

/// The record's point or shape. Throws RecordError if it has two.
std::optional<Found> findOne(const RecordView& record, const PointReading& reading, Conditions& conditions) {
  std::vector<Found> all;
  for (const auto& rows : {std::span<const Coordinate* const>(coordinates::kPoints), {coordinates::kShapes}})
    for (const Coordinate* row : rows)
      // Beside x, y, z, on the Earth and beside a camera's columns, those of a map are something else.
      if (row != &coordinates::direction &&
          !(row == &coordinates::map && (reading.worldIsEcef || reading.besideCamera))) {
        Coordinate read = *row;
        read.isNameFirst = !reading.besideCamera;
        if (auto plan = find(read, record, conditions)) all.push_back({row, std::move(*plan)});
      }
  if (auto plan = find(coordinates::segment, record, conditions))
    all.push_back({&coordinates::segment, std::move(*plan)});
  if (!reading.worldIsEcef && all.size() > 1)
    std::erase_if(all, [](const Found& found) { return found.row == &coordinates::place; });
  if (all.size() > 1) std::erase_if(all, [](const Found& found) { return found.row == &coordinates::map; });
  if (all.size() > 1)
    throw hasBoth(0, namesIn(all[0].plan, *record.schema), namesIn(all[1].plan, *record.schema),
                  isPoint(all[1].plan) || record.schema->form == Form::csv);
  if (all.empty())
    if (auto plan = find(coordinates::direction, record, conditions))
      all.push_back({&coordinates::direction, std::move(*plan)});
  return all.empty() ? std::nullopt : std::optional(std::move(all[0]));
}

/// The rows that a command reads, in the order of the table.
std::vector<const Coordinate*> rowsRead(const PointReading& reading) {
  std::vector<const Coordinate*> rows(std::begin(coordinates::kPoints), std::end(coordinates::kPoints));
  if (reading.segments) rows.push_back(&coordinates::segment);
  if (reading.shapes) rows.insert(rows.end(), std::begin(coordinates::kShapes), std::end(coordinates::kShapes));
  return rows;
}

[[noreturn]] void failWithoutPoint(const RecordView& record, const PointReading& reading,
                                   const Conditions& conditions) {
  const Schema& schema = *record.schema;
  const bool csv = schema.form == Form::csv;
  // A field with a shape's name, but without a shape as its value.
  for (const Condition& condition : conditions)
    for (const Coordinate* row : allCoordinates())
      if (row->form != CoordinateForm::array && sameButForCase(row->name, schema.names[condition.field]))
        throw RecordError(record.offset(condition.field), std::string(row->name) + ": expected " + exampleOf(*row));
  const char* const choose = csv ? "; --columns names all of them" : "";
  for (const Coordinate* row : {&coordinates::xyz, &coordinates::place})
    if (const std::string part = missingParts(*row, schema); !part.empty()) throw RecordError(0, part + choose);
  if (csv)
    throw RecordError(0, "has no columns x, y, z or lat, lon, height" + fieldsNote(schema) +
                             "; --columns names them, as in x=E,y=N,z=U");
  if (const auto field = schema.find(kRecordsField))
    throw RecordError(record.offset(*field), "has points behind other fields; expected them as the first one");
  throw RecordError(0, "has no point" + std::string(reading.shapes ? " or shape" : "") + "; expected " +
                           namesOf(rowsRead(reading), reading.polygons ? ", " : " or ") +
                           (reading.polygons ? " or polygon" : "") + fieldsNote(schema));
}

/// A letter beside x, y, z that may belong to the point, and is not read, for it may as well be a width or a colour.
void noteUnread(const RecordView& record, const Coordinate& row, const PointReading& reading, NumberPlan& plan) {
  if (&row != &coordinates::xyz || plan.kind == kindRoundPoint) return;
  const auto has = [&](const char* name) { return record.schema->find(name).has_value(); };
  if (has("w") && !has("h")) plan.notes.push_back("w is not read; --columns x,y,z,w makes the point (x/w, y/w, z/w)");
  if (reading.radius && has("r") && !has("g"))
    plan.notes.push_back("r is not read; the name radius, or --columns x=x,y=y,z=z,radius=r, makes it a sphere");
}

NumberPlan findNamedPoint(const RecordView& record, const PointReading& reading) {
  Conditions conditions;
  auto found = findOne(record, reading, conditions);
  if (!found) failWithoutPoint(record, reading, conditions);
  auto& [row, plan] = *found;
  if (row == &coordinates::place && !reading.worldIsEcef) throw RecordError(0, kNotOnEarth);
  const bool isSegment = row == &coordinates::segment;
  if (isSegment ? !reading.segments : isShape(plan) && !reading.shapes)
    throw RecordError(record.offset(plan.fields[0].field),
                      "a " + std::string(row->name) + " is not read here; expected " + namesOf(rowsRead(reading)));
  if (reading.radius && isPoint(plan) && row->kind != kindDirection)
    if (const auto radius = find(coordinates::radius, record, conditions)) {
      plan.append(*radius);
      plan.kind = plan.kind == kindPlace ? kindPlacedSphere : kindRoundPoint;
    }
  noteUnread(record, *row, reading, plan);
  // With a camera on the Earth, an array of three numbers may be a place.
  if (reading.worldIsEcef)
    for (NumberField& part : plan.fields)
      if (part.point == PointForm::point) part.point = PointForm::ofTheEarth;
  plan.conditions = std::move(conditions);
  return plan;
}

// Pixels

/// A pixel from two or three numbers without names.
NumberPlan findBarePixel(const RecordView& record) {
  const Schema& schema = *record.schema;
  const bool isJson = schema.form == Form::json;
  if (schema.size != 2 && schema.size != 3)
    failWithCount(record, std::string(isJson ? "[x, y] or [x, y, depth]" : "x y or x y depth") +
                              (schema.size > 3 && !isJson ? "; --columns 1,2 picks two" : ""));
  NumberPlan plan = firstFields(schema.size, isJson ? 0 : 2);
  if (schema.size == 3) plan.kind = depthKnown;
  return plan;
}

/// A pixel from screen, pixel or x y, in two slots.
NumberPlan findScreen(const RecordView& record, Conditions& conditions) {
  const Schema& schema = *record.schema;
  std::optional<std::size_t> offsetOfZ;  // then x, y are not a pixel
  for (const Coordinate* row : coordinates::kPixels) {
    const auto plan = find(*row, record, conditions);
    if (!plan) continue;
    const auto z = matchParts(schema.names, std::span(coordinates::kXyzw).subspan(2, 1))[0].field;
    if (!z || row != &coordinates::xy) return *plan;
    offsetOfZ = record.offset(*z);
  }
  if (offsetOfZ)
    throw RecordError(*offsetOfZ, "x, y, z is a point of the world, not a pixel; expected screen, pixel or x y alone");
  if (const std::string part = missingParts(coordinates::xy, schema); !part.empty()) throw RecordError(0, part);
  if (schema.form == Form::csv)
    throw RecordError(
        0, "has no columns screen_x, screen_y or x, y" + fieldsNote(schema) + "; --columns names them, as in x=u,y=v");
  throw RecordError(0, "has no pixel; expected " + namesOf(coordinates::kPixels, ", or ") + fieldsNote(schema));
}

/// A distance along the ray is not read: without it the record would seem to have been obeyed. Nor is z without x, y.
void requireNoOtherDistance(const RecordView& record) {
  const std::vector<std::string>& names = record.schema->names;
  const bool hasX = std::any_of(names.begin(), names.end(), [](const auto& name) { return sameButForCase(name, "x"); });
  for (const std::string& name : names)
    if (sameButForCase(name, "distance") || (!hasX && sameButForCase(name, "z")))
      throw RecordError(0, "has " + inQuotes(name) +
                               ", which is not read; expected depth, range, the distance from the eye, or "
                               "viewDistance, along the viewing axis; --columns x=X,y=Y takes the pixel alone");
}

// Making points and pixels from numbers

/// slots: how many numbers belong to the point.
Vec4 pointOf(const NumberPlan& plan, std::size_t slots, const Numbers& n) {
  if (n.isNull) throw RecordError(0, "has no point: it is null");
  if (plan.kind == kindPlace || plan.kind == kindPlacedSphere) {
    Geodetic place{n[0], n[1], n[2]};
    if (const std::string fault = faultOf(place); !fault.empty()) throw RecordError(0, fault);
    if (plan.isAboveSea) place.height += seaLevelAt(place.lat, place.lon);
    const Vec3 p = geodeticToEcef(place);
    return {p.x, p.y, p.z, 1};
  }
  const bool hasWeight = slots == 4 && !std::isnan(n[3]);
  const Vec4 point{n[0], n[1], n[2], plan.kind == kindDirection ? 0 : hasWeight ? n[3] : 1};
  if (point == Vec4{0, 0, 0, 0}) throw RecordError(0, "0 0 0 0 is neither a point nor a direction");
  return point;
}

}  // namespace

NumberPlan findPoint(const RecordView& record, const PointReading& reading) {
  if (reading.columns.given()) return findChosenPoint(record, reading);
  return isNameless(*record.schema) ? findBarePoint(record, reading) : findNamedPoint(record, reading);
}

bool isSegment(const NumberPlan& plan) { return plan.kind == kindSegment; }
bool mayBePlace(const NumberPlan& plan) { return plan.kind == kindPlace || plan.fields[0].isArray; }
bool isPoint(const NumberPlan& plan) { return plan.kind <= kindPlace; }
bool isShape(const NumberPlan& plan) { return !isPoint(plan) && !isSegment(plan); }

Vec4 toPoint(const NumberPlan& plan, const Numbers& n) {
  return pointOf(plan, plan.slots() - (plan.kind == kindRoundPoint ? 1 : plan.hasPixel ? 2 : 0), n);
}

NumberPlan findPixel(const RecordView& record, const ColumnChoice& columns) {
  NumberPlan plan;
  if (columns.given()) {
    plan = chosenFields(columns, record, true);
    plan.together = 2;
    plan.kind = (columns.has("depth") ? depthKnown : 0u) | (columns.has("viewDistance") ? viewDistanceKnown : 0u) |
                (columns.has("range") ? rangeKnown : 0u);
    return plan;
  }
  if (isNameless(*record.schema)) return findBarePixel(record);
  Conditions conditions;
  plan = findScreen(record, conditions);
  for (const Coordinate* row : coordinates::kDistances)
    if (const auto part = find(*row, record, conditions)) {
      plan.append(*part);
      plan.kind |= row == &coordinates::depth   ? depthKnown
                   : row == &coordinates::range ? rangeKnown
                                                : viewDistanceKnown;
    }
  if (plan.kind == 0) requireNoOtherDistance(record);
  plan.conditions = std::move(conditions);
  return plan;
}

NumberPlan findTwoPixels(const RecordView& record, const ColumnChoice& columns) {
  if (columns.given()) return chosenFields(columns, record, false);
  if (isNameless(*record.schema)) {
    if (record.schema->size != 4) failWithCount(record, "u1 v1 u2 v2");
    return firstFields(4, 0);
  }
  Conditions conditions;
  for (const Coordinate* row : {&coordinates::twoUv, &coordinates::twoXy})
    if (auto plan = find(*row, record, conditions)) return *plan;
  throw RecordError(0, "has no " + std::string(coordinates::twoUv.name) + ", a pixel in each of two cameras" +
                           fieldsNote(*record.schema) + "; --columns names them");
}

NumberPlan findPair(const RecordView& record, const PointReading& reading) {
  NumberPlan plan;
  std::size_t ofPixel = 2;  // fields, the last ones
  if (reading.columns.given()) {
    plan = findChosenPoint(record, reading);
    // The table has w last, where it can be left out.
    if (reading.columns.has("w")) std::rotate(plan.fields.begin() + 3, plan.fields.end() - 1, plan.fields.end());
  } else if (isNameless(*record.schema)) {
    plan = findBarePair(record, reading);
  } else {
    plan = findNamedPoint(record, reading);
    std::optional<NumberPlan> pixel;
    for (const Coordinate* row : coordinates::kPixelsBesidePoints) {
      auto found = find(*row, record, plan.conditions);
      if (!found) continue;
      if (pixel) throw hasBoth(0, namesIn(*pixel, *record.schema), namesIn(*found, *record.schema), true);
      pixel = std::move(found);
    }
    if (!pixel)
      throw RecordError(0, "has no pixel beside its point; expected " + namesOf(coordinates::kPixelsBesidePoints) +
                               fieldsNote(*record.schema));
    ofPixel = pixel->fields.size();
    plan.append(*pixel);
  }
  plan.hasPixel = true;
  for (std::size_t i = plan.fields.size() - ofPixel; i < plan.fields.size(); ++i) plan.fields[i].mayBeAbsent = true;
  return plan;
}

std::optional<Vec2> pixelBesidePoint(const NumberPlan& plan, const Numbers& n) {
  const Vec2 pixel{n[plan.slots() - 2], n[plan.slots() - 1]};
  if (std::isnan(pixel.x) != std::isnan(pixel.y))
    throw RecordError(0, "has one number of a pixel; expected two, or none where the point has no pixel");
  return std::isnan(pixel.x) ? std::nullopt : std::optional(pixel);
}

bool hasPixelBesidePoint(const RecordView& record, const ColumnChoice& columns) {
  if (columns.given()) return columns.has("u");
  if (isNameless(*record.schema)) return record.schema->size == 5;
  Conditions conditions;
  return std::any_of(std::begin(coordinates::kPixelsBesidePoints), std::end(coordinates::kPixelsBesidePoints),
                     [&](const Coordinate* row) { return find(*row, record, conditions).has_value(); });
}

bool hasDistance(const NumberPlan& plan) { return (plan.kind & (depthKnown | viewDistanceKnown | rangeKnown)) != 0; }

Pixel toPixel(const NumberPlan& plan, const Numbers& n) {
  Pixel pixel;
  if (!n.isNull) pixel.screen = Vec2{n[0], n[1]};
  if (!n.isNull && !(std::fabs(n[0]) < kFarthestPoint && std::fabs(n[1]) < kFarthestPoint))
    throw RecordError(0, "lies farther than 1e46 from the picture");
  const double* next = &n[2];
  const auto optional = [&](unsigned part) {
    if (!(plan.kind & part)) return std::optional<double>();
    const double value = *next++;
    return std::isnan(value) ? std::nullopt : std::optional(value);
  };
  pixel.depth = optional(depthKnown);
  pixel.viewDistance = optional(viewDistanceKnown);
  pixel.range = optional(rangeKnown);
  pixel.hasDistance = hasDistance(plan);
  return pixel;
}

}  // namespace viewproj::cmd
