#include "records/points.hpp"

#include <algorithm>
#include <cmath>

#include "records/coordinate_fields.hpp"
#include "text/error.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "viewproj/geodesy.hpp"

namespace viewproj::cmd {
namespace {

/// What a pixel's numbers are, in this order.
enum PixelParts : unsigned { depthKnown = 1, viewDistanceKnown = 2 };

/// The first `count` fields, each a number.
Layout firstFields(std::size_t count, bool mayBeAbsent) {
  Layout layout;
  for (std::size_t i = 0; i < count; ++i) layout.parts.push_back({i, 1, 1, false, mayBeAbsent});
  return layout;
}

constexpr const char* kColumnsSay = "--columns lat,lon,height or --columns x,y,z";

Vec4 toWorld(const Geodetic& place) {
  if (!isPlace(place)) throw RecordError(0, "lat: " + formatNumber(place.lat) + " is not from -90 to 90 degrees");
  const Vec3 p = geodeticToEcef(place);
  return {p.x, p.y, p.z, 1};
}

void append(Layout& layout, const Layout& more) {
  layout.notes.insert(layout.notes.end(), more.notes.begin(), more.notes.end());
  layout.parts.insert(layout.parts.end(), more.parts.begin(), more.parts.end());
}

/// What --columns names of a row, in the row's order. Throws RecordError for a column under two names.
void appendChosen(Layout& layout, const Coordinate& row, const ColumnChoice& choice, const RecordParts& record,
                  bool mayBeAbsent) {
  for (const CoordinatePart& part : row.parts) {
    const auto* pick = choice.find(part.name);
    if (!pick) continue;
    const std::size_t field = fieldOf(*pick, choice, record);
    for (const NumberField& other : layout.parts)
      if (other.field == field)
        throw RecordError(0, "--columns " + choice.text + " names column " + std::to_string(field + 1) +
                                 " twice, for " + pick->role + " as " + inQuotes(pick->name));
    layout.parts.push_back({field, 1, 1, false, mayBeAbsent});
    if (pick->role == coordinates::kPlace[2].name && isSeaLevelName(pick->name))
      layout.notes.push_back(seaLevelNote(pick->name));
  }
}

/// What the columns do not name, a w or a radius of another field, is not used.
Layout findChosenPoint(const RecordParts& record, const PointReading& reading) {
  const ColumnChoice& choice = reading.columns;
  const Coordinate& row = choice.find("lat") ? coordinates::place : coordinates::xyz;
  if (row.kind == kindPlace && !reading.worldIsEcef) throw RecordError(0, kNotOnEarth);
  Layout layout;
  layout.kind = row.kind;
  appendChosen(layout, row, choice, record, false);
  if (!reading.radius) return layout;
  const std::size_t numbers = layout.parts.size();
  appendChosen(layout, coordinates::radius, choice, record, false);
  if (layout.parts.size() > numbers) layout.kind = layout.kind == kindPlace ? kindPlacedSphere : kindRoundPoint;
  return layout;
}

std::string numbersIn(const Shape& shape) {
  return "has " + std::to_string(shape.size) + (shape.size == 1 ? " number" : " numbers");
}

constexpr std::size_t kMatrix = 16;

/// Of numbers without names.
Layout findBarePoint(const RecordParts& record, const PointReading& reading) {
  const Shape& shape = record.shape;
  const bool weighted = shape.form == Form::json;
  const std::string count = numbersIn(shape);
  if (!weighted && shape.size > 3)
    throw RecordError(
        0,
        count +
            ", and a point has three; --columns 1,2,3 takes these, --columns x,y,z,w reads the "
            "fourth as w" +
            (reading.radius ? ", --columns x,y,z,radius as the radius of a sphere" : "") +
            (shape.form == Form::text && (shape.size == 4 || shape.size == kMatrix) ? "; inspect reads a matrix" : ""));
  if (shape.size != 3 && !(weighted && shape.size == 4))
    throw RecordError(0, count + "; expected x y z" + (weighted ? " or x y z w" : "") +
                             (shape.size == kMatrix ? "; inspect reads a matrix" : ""));
  if (reading.worldIsEcef && shape.size == 3 && shape.form != Form::f64)
    throw RecordError(
        0, bareTriple(std::string(weighted ? "lat, lon, height or x, y, z of an object, " : "") + kColumnsSay));
  return firstFields(shape.size, false);
}

struct Found {
  const Coordinate* row;
  Layout layout;
};

/// Those of the rows that the record has.
std::vector<Found> findAll(std::span<const Coordinate* const> rows, const RecordParts& record,
                           std::vector<FormOfField>& forms, NameRule rule) {
  std::vector<Found> all;
  for (const Coordinate* row : rows)
    if (auto layout = find(*row, record, forms, rule)) all.push_back({row, std::move(*layout)});
  return all;
}

[[noreturn]] void failTwoPoints(const RecordParts& record, const Layout& one, const Layout& other) {
  throw RecordError(0, "has two points, " + namesIn(one, record.shape) + " and " + namesIn(other, record.shape) +
                           "; expected one, or --columns to choose");
}

/// With a camera on the Earth three numbers of an array may be a place.
void askWhich(Layout& layout) {
  for (NumberField& part : layout.parts)
    if (part.point == PointForm::point) part.point = PointForm::ofTheEarth;
}

/// The shape of a record, or nothing. Throws RecordError where it has two.
std::optional<Layout> findShape(const RecordParts& record, const PointReading& reading,
                                std::vector<FormOfField>& forms) {
  std::vector<const Coordinate*> rows;
  if (reading.segments) rows.push_back(&coordinates::segment);
  if (!reading.shapes.empty())
    rows.insert(rows.end(), std::begin(coordinates::kShapes), std::end(coordinates::kShapes));
  std::vector<Found> all = findAll(rows, record, forms, NameRule::exact);
  if (all.empty() && record.shape.form == Form::csv) all = findAll(rows, record, forms, NameRule::any);
  if (all.size() > 1)
    throw RecordError(0, "has two shapes, a " + std::string(all[0].row->name) + " and a " +
                             std::string(all[1].row->name) + "; expected one");
  if (all.empty()) return std::nullopt;
  Layout& layout = all[0].layout;
  if (all[0].row == &coordinates::segment)
    if (const auto pixel = find(coordinates::pixel, record, forms)) {
      append(layout, *pixel);
      layout.kind = kindSegmentAndPixel;
    }
  if (reading.worldIsEcef) askWhich(layout);
  return layout;
}

/// The point of a record, or nothing. Throws RecordError where it has two.
std::optional<Layout> findNamed(const RecordParts& record, const PointReading& reading, std::vector<FormOfField>& forms,
                                NameRule rule) {
  std::vector<Found> all = findAll(coordinates::kPoints, record, forms, rule);
  if (!reading.worldIsEcef && all.size() > 1)
    std::erase_if(all, [](const Found& found) { return found.row->kind == kindPlace; });
  if (all.size() > 1 && all.back().row->kind == kindDirection) all.pop_back();
  if (all.empty()) return std::nullopt;
  if (all.size() > 1) failTwoPoints(record, all[0].layout, all[1].layout);
  auto& [row, layout] = all[0];
  if (row->kind == kindPlace && !reading.worldIsEcef) throw RecordError(0, kNotOnEarth);
  if (reading.worldIsEcef) {
    askWhich(layout);
    // Other names of the one beside the very names of the other.
    for (const auto& [one, other] :
         {std::pair(&coordinates::xyz, &coordinates::place), std::pair(&coordinates::place, &coordinates::xyz)})
      if (row == one)
        if (const auto second = find(*other, record, forms, NameRule::any)) failTwoPoints(record, layout, *second);
  }
  if (!reading.radius || row->kind == kindDirection) return layout;
  if (const auto radius = find(coordinates::radius, record, forms, NameRule::any)) {
    append(layout, *radius);
    layout.kind = layout.kind == kindPlace ? kindPlacedSphere : kindRoundPoint;
  }
  return layout;
}

/// Throws RecordError.
Layout findNamedPoint(const RecordParts& record, const PointReading& reading, std::vector<FormOfField>& forms) {
  const Shape& shape = record.shape;
  const auto requireNoOther = [&] {
    for (const Coordinate* row : coordinates::kNotRead)
      if (find(*row, record, forms))
        throw RecordError(record.offset(forms.back().field),
                          std::string(row == &coordinates::ellipsoid ? "an " : "a ") + std::string(row->name) +
                              " is not " + std::string(reading.shapes) + "; expected a point, " +
                              (reading.segments ? "segment, " : "") + namesOf(coordinates::kShapes));
  };
  PointReading first = reading;
  if (reading.pointsFirst) first.shapes = {};
  if (auto layout = findShape(record, first, forms)) return *layout;
  if (!first.shapes.empty()) requireNoOther();
  for (const NameRule rule : {NameRule::exact, NameRule::any})
    if (const auto layout = findNamed(record, reading, forms, rule)) return *layout;
  if (reading.pointsFirst) {
    if (auto layout = findShape(record, reading, forms)) return *layout;
    requireNoOther();
  }
  // A field of a shape's name whose value is none.
  for (const FormOfField& form : forms)
    if (const auto* row = rowNamed(shape.names[form.field]);
        row && row->form != CoordinateForm::word && row->form != CoordinateForm::array)
      throw RecordError(record.offset(form.field), std::string(row->name) + ": expected " + exampleOf(*row));
  for (const Coordinate* row : coordinates::kPoints)
    if (const std::string part = partlyThere(*row, shape); !part.empty())
      throw RecordError(0, part + whatIsThere(shape) + (shape.form == Form::csv ? "; --columns names the others" : ""));
  if (shape.form == Form::csv)
    throw RecordError(
        0, "has no columns x, y, z or lat, lon, height" + whatIsThere(shape) + "; " +
               otherSeparator(shape).value_or(reading.worldIsEcef ? "--columns names lat, lon and height, or x, y and z"
                                                                  : "--columns names x, y and z"));
  throw RecordError(0, "has no point; expected " + namesOf(coordinates::kPoints, ", or ") + whatIsThere(shape));
}

/// screen, pixel or x y: two slots.
Layout findScreen(const RecordParts& record, std::vector<FormOfField>& forms) {
  const Shape& shape = record.shape;
  for (const NameRule rule : {NameRule::exact, NameRule::any})
    for (const Coordinate* row : coordinates::kPixels) {
      const auto layout = find(*row, record, forms, rule);
      if (!layout) continue;
      const auto z = matchParts(shape.names, std::span(coordinates::kXyzw).subspan(2, 1), 1, rule)[0].field;
      if (z && row == &coordinates::xy)
        throw RecordError(record.offset(*z),
                          "x, y, z is a point of the world, not a pixel; expected screen, pixel or x y alone");
      return *layout;
    }
  const std::string there = whatIsThere(shape);
  if (const std::string part = partlyThere(coordinates::xy, shape); !part.empty()) throw RecordError(0, part + there);
  if (shape.form == Form::csv)
    throw RecordError(0, "has no columns screen_x, screen_y or x, y" + there + "; " +
                             otherSeparator(shape).value_or("--columns names the two"));
  throw RecordError(0, "has no pixel; expected " + namesOf(coordinates::kPixels, ", or ") + there);
}

unsigned distanceKind(const Coordinate& row) { return &row == &coordinates::depth ? depthKnown : viewDistanceKnown; }

/// Two or three numbers without names.
Layout findBarePixel(const RecordParts& record) {
  const Shape& shape = record.shape;
  const std::string count = numbersIn(shape) + "; expected ";
  if (shape.size != 2 && shape.size != 3 && shape.form == Form::json)
    throw RecordError(0, count + "[x, y] or [x, y, depth]");
  if (shape.size != 2 && shape.size != 3)
    throw RecordError(0, count + "x y or x y depth" + (shape.size > 3 ? "; --columns 1,2,3 takes three of them" : ""));
  Layout layout = firstFields(shape.size, shape.form != Form::json);
  if (shape.size == 3) layout.kind = depthKnown;
  return layout;
}

/// What the columns do not name, a distance of another field, is not used.
Layout findChosenPixel(const RecordParts& record, const ColumnChoice& choice) {
  Layout layout;
  appendChosen(layout, coordinates::xy, choice, record, true);
  for (const Coordinate* row : coordinates::kDistances) {
    const std::size_t numbers = layout.parts.size();
    appendChosen(layout, *row, choice, record, true);
    if (layout.parts.size() > numbers) layout.kind |= distanceKind(*row);
  }
  return layout;
}

bool isNameless(const Shape& shape) { return shape.isArray || (shape.form == Form::csv && !shape.hasHeader); }

}  // namespace

Layout findPoint(const RecordParts& record, const PointReading& reading) {
  std::vector<FormOfField> forms;
  Layout layout = reading.columns.given()    ? findChosenPoint(record, reading)
                  : isNameless(record.shape) ? findBarePoint(record, reading)
                                             : findNamedPoint(record, reading, forms);
  layout.forms = std::move(forms);
  return layout;
}

bool isSegment(const Layout& layout) { return layout.kind == kindSegment || layout.kind == kindSegmentAndPixel; }
bool isPoint(const Layout& layout) { return layout.kind <= kindPlace; }
bool isShape(const Layout& layout) {
  return layout.kind == kindSphere || layout.kind == kindBox || layout.kind == kindTriangle ||
         layout.kind == kindRoundPoint || layout.kind == kindPlacedSphere;
}

Vec4 toPoint(const Layout& layout, const Numbers& n) {
  const bool round = layout.kind == kindRoundPoint;
  if (layout.kind == kindPlace || layout.kind == kindPlacedSphere) return toWorld({n[0], n[1], n[2]});
  double w = 1;
  if (layout.kind == kindDirection)
    w = 0;
  else if (layout.slots() - (round ? 1 : 0) == 4 && !std::isnan(n[3]))
    w = n[3];
  const Vec4 point{n[0], n[1], n[2], w};
  if (point == Vec4{0, 0, 0, 0}) throw RecordError(0, "0 0 0 0 is neither a point nor a direction");
  return point;
}

Layout findPixel(const RecordParts& record, const ColumnChoice& columns) {
  if (columns.given()) return findChosenPixel(record, columns);
  if (isNameless(record.shape)) return findBarePixel(record);
  std::vector<FormOfField> forms;
  Layout layout = findScreen(record, forms);
  for (const Coordinate* row : coordinates::kDistances)
    if (const auto part = find(*row, record, forms, NameRule::any)) {
      append(layout, *part);
      layout.kind |= distanceKind(*row);
    }
  layout.forms = std::move(forms);
  return layout;
}

bool hasDistance(const Layout& layout) { return (layout.kind & (depthKnown | viewDistanceKnown)) != 0; }

Pixel toPixel(const Layout& layout, const Numbers& n) {
  Pixel pixel;
  if (!std::isnan(n[0]) && !std::isnan(n[1])) pixel.screen = Vec2{n[0], n[1]};
  const double* next = &n[2];
  const auto optional = [&](unsigned part) {
    if (!(layout.kind & part)) return std::optional<double>();
    const double value = *next++;
    return std::isnan(value) ? std::nullopt : std::optional(value);
  };
  pixel.depth = optional(depthKnown);
  pixel.viewDistance = optional(viewDistanceKnown);
  pixel.hasDistance = hasDistance(layout);
  return pixel;
}

}  // namespace viewproj::cmd
