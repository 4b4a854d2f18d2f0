#include "input/points.hpp"

#include <cmath>

#include "text/error.hpp"
#include "text/format_number.hpp"
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

constexpr const char* kNotOnEarth =
    "lat, lon, height need a camera that stands on the Earth: a position by lat, lon, height, or \"world\": \"ecef\"";
constexpr const char* kColumnsSay = "--columns lat,lon,height or --columns x,y,z";

Vec4 toWorld(const Geodetic& place) {
  if (!isPlace(place)) throw RecordError(0, "lat: " + formatNumber(place.lat) + " is not from -90 to 90 degrees");
  const Vec3 p = geodeticToEcef(place);
  return {p.x, p.y, p.z, 1};
}

void append(Layout& layout, const Layout& more) {
  layout.parts.insert(layout.parts.end(), more.parts.begin(), more.parts.end());
}

/// What --columns names of a row, in the row's order.
void appendChosen(Layout& layout, const Coordinate& row, const ColumnChoice& choice, const RecordParts& record,
                  bool mayBeAbsent) {
  for (const CoordinatePart& part : row.parts)
    if (const auto* pick = choice.find(part.name))
      layout.parts.push_back({fieldOf(*pick, choice, record), 1, 1, false, mayBeAbsent});
}

/// A point with its radius, if it has one and that counts.
Layout perhapsRound(Layout layout, std::optional<Layout> radius) {
  if (!radius) return layout;
  append(layout, *radius);
  layout.kind = layout.kind == kindPlace           ? kindPlacedSphere
                : layout.kind == kindWeightedPoint ? kindRoundWeightedPoint
                                                   : kindRoundPoint;
  return layout;
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
  if (!choice.find("radius")) return layout;
  Layout radius;
  appendChosen(radius, coordinates::radius, choice, record, false);
  return perhapsRound(layout, radius);
}

std::string numbersIn(const Shape& shape) {
  return "has " + std::to_string(shape.size) + (shape.size == 1 ? " number" : " numbers");
}

/// Of numbers without names.
Layout findBarePoint(const RecordParts& record, const PointReading& reading) {
  const Shape& shape = record.shape;
  const bool weighted = shape.form == Form::json;
  const std::string count = numbersIn(shape);
  if (!weighted && shape.size > 3)
    throw RecordError(0, count +
                             ", and a point has three; --columns 1,2,3 takes these, --columns x,y,z,w reads the "
                             "fourth as w" +
                             (reading.radius ? ", --columns x,y,z,radius as the radius of a sphere" : ""));
  if (shape.size != 3 && !(weighted && shape.size == 4))
    throw RecordError(0, count + "; expected x y z" + (weighted ? " or x y z w" : ""));
  if (reading.worldIsEcef && shape.size == 3 && shape.form != Form::f64)
    throw RecordError(
        0, bareTriple(std::string(weighted ? "lat, lon, height or x, y, z of an object, " : "") + kColumnsSay));
  return firstFields(shape.size, false);
}

/// Throws RecordError.
Layout findNamedPoint(const RecordParts& record, const PointReading& reading, std::vector<FormOfField>& forms) {
  const bool csv = record.shape.form == Form::csv;
  const auto findRow = [&](const Coordinate& row) { return find(row, record, forms); };
  if (reading.segments)
    if (auto segment = findRow(coordinates::segment)) {
      if (const auto pixel = findRow(coordinates::pixel)) {
        append(*segment, *pixel);
        segment->kind = kindSegmentAndPixel;
      }
      return *segment;
    }
  if (!reading.shapes.empty()) {
    for (const Coordinate* row : coordinates::kShapes)
      if (auto shape = findRow(*row)) return *shape;
    for (const Coordinate* row : coordinates::kNotRead)
      if (findRow(*row))
        throw RecordError(record.offset(forms.back().field),
                          std::string(row == &coordinates::ellipsoid ? "an " : "a ") + std::string(row->name) +
                              " is not " + std::string(reading.shapes) + "; expected a point, " +
                              (reading.segments ? "segment, " : "") + namesOf(coordinates::kShapes));
  }
  for (const Coordinate* row : coordinates::kPoints) {
    auto layout = findRow(*row);
    if (!layout) continue;
    if (row->kind == kindPlace && !reading.worldIsEcef) throw RecordError(0, kNotOnEarth);
    if (row == &coordinates::position && !csv && reading.worldIsEcef) layout->kind = kindWeightedPoint;
    if (!reading.radius || row->kind == kindDirection) return *layout;
    return perhapsRound(*layout, findRow(coordinates::radius));
  }
  // A field of a shape's name whose value is none.
  for (const FormOfField& form : forms)
    if (const auto* row = rowNamed(record.shape.names[form.field]); row && row->form != CoordinateForm::word)
      throw RecordError(record.offset(form.field), std::string(row->name) + ": expected " + exampleOf(*row));
  if (csv)
    throw RecordError(0, "has no columns x, y, z or lat, lon, height; " +
                             otherSeparator(record.shape).value_or("--columns names x, y and z"));
  throw RecordError(0, "has no point; expected " + namesOf(coordinates::kPoints, ", or "));
}

/// screen, pixel or x y: two slots.
Layout findScreen(const RecordParts& record, std::vector<FormOfField>& forms) {
  const Shape& shape = record.shape;
  for (const Coordinate* row : coordinates::kPixels) {
    const auto layout = find(*row, record, forms);
    if (!layout) continue;
    if (const auto z = shape.find("z"); z && row == &coordinates::xy)
      throw RecordError(record.offset(*z),
                        "x, y, z is a point of the world, not a pixel; expected screen, pixel or x y alone");
    return *layout;
  }
  if (shape.form == Form::csv)
    throw RecordError(
        0, "has no columns screen_x, screen_y or x, y; " + otherSeparator(shape).value_or("--columns names the two"));
  throw RecordError(0, "has no pixel; expected " + namesOf(coordinates::kPixels, ", or "));
}

void appendDistance(Layout& layout, const Coordinate& row, const Layout& part) {
  append(layout, part);
  layout.kind |= &row == &coordinates::depth ? depthKnown : viewDistanceKnown;
}

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
    Layout part;
    appendChosen(part, *row, choice, record, true);
    if (part.parts.empty()) continue;
    appendDistance(layout, *row, part);
  }
  return layout;
}

bool isNameless(const Shape& shape) { return shape.isArray || (shape.form == Form::csv && !shape.hasHeader); }

}  // namespace

std::string bareTriple(const std::string& way) {
  return "three numbers without names may be a place or metres from the Earth's centre; say which: " + way;
}

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

Vec4 toPoint(const Layout& layout, const Numbers& n) {
  const bool round = layout.kind == kindRoundPoint || layout.kind == kindRoundWeightedPoint;
  if (layout.kind == kindPlace || layout.kind == kindPlacedSphere) return toWorld({n[0], n[1], n[2]});
  double w = 1;
  if (layout.kind == kindDirection)
    w = 0;
  else if (layout.slots() - (round ? 1 : 0) == 4 && !std::isnan(n[3]))
    w = n[3];
  else if (layout.kind == kindWeightedPoint || layout.kind == kindRoundWeightedPoint)
    throw RecordError(0, "position: " + bareTriple("lat, lon, height or x, y, z, a field each"));
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
    if (const auto part = find(*row, record, forms)) appendDistance(layout, *row, *part);
  return layout;
}

bool hasDistance(const Layout& layout) { return layout.kind != 0; }

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
