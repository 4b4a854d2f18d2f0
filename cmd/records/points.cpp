#include "records/points.hpp"

#include <algorithm>
#include <cmath>

#include "text/error.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "viewproj/geodesy.hpp"

namespace viewproj::cmd {
namespace {

using Forms = std::vector<FormOfField>;

/// The kind of a pixel's layout: the distances after its two numbers, in this order.
enum PixelParts : unsigned { depthKnown = 1, viewDistanceKnown = 2 };

bool isNameless(const Shape& shape) { return shape.isArray || (shape.form == Form::csv && !shape.hasHeader); }

/// The record's names for the parts of a layout: "x,y,z".
std::string namesIn(const Layout& layout, const Shape& shape) {
  std::vector<std::string_view> names;
  for (const NumberField& part : layout.parts)
    if (names.empty() || names.back() != shape.names[part.field]) names.push_back(shape.names[part.field]);
  return visible(joined(names, ","));
}

RecordError hasBoth(std::size_t offset, const std::string& one, const std::string& other, bool choosable) {
  return {offset, "has both " + one + " and " + other +
                      (choosable ? "; keep one of them, or choose by --columns" : "; keep one of them")};
}

// Finding a row in the names of a record

/// A column or field for each part; nothing if a required one is missing.
std::optional<Layout> findEach(const RecordParts& record, std::span<const CoordinatePart> parts, std::size_t required,
                               bool orNull) {
  const auto& names = record.shape.names;
  const std::vector<PartMatch> matches = matchParts(names, parts);
  if (!isWhole(std::span(matches).first(required))) return std::nullopt;
  Layout layout;
  for (const auto& [field, also] : matches) {
    if (!field) break;
    if (also) throw hasBoth(record.offset(*also), inQuotes(names[*field]), inQuotes(names[*also]), true);
    if (isSeaLevelName(names[*field])) layout.notes.push_back(seaLevelNote(names[*field]));
    layout.parts.push_back({*field, 1, 1, false, orNull});
  }
  return layout;
}

/// CSV columns of a row. Those of an array are NAME_x, NAME_y, ..., where NAME may be an alias.
std::optional<Layout> findColumns(const Coordinate& row, const RecordParts& record) {
  std::vector<std::vector<std::string>> spellings = {columnsOf(row)};
  for (const std::string_view alias : row.aliases) {
    spellings.emplace_back();
    for (std::size_t i = 0; i < row.most; ++i)
      spellings.back().push_back(std::string(alias) + std::string(kColumnSuffixes[i]));
  }
  std::optional<Layout> found;
  for (const std::vector<std::string>& names : spellings) {
    std::vector<CoordinatePart> parts;
    for (const std::string& name : names) parts.push_back({name});
    auto layout = parts.empty() ? std::nullopt : findEach(record, parts, row.fewest, row.orNull);
    if (layout && found) throw hasBoth(0, namesIn(*found, record.shape), namesIn(*layout, record.shape), true);
    if (layout) found = std::move(layout);
    if (found && &names == &spellings[0]) break;  // the row's name is preferred to its aliases
  }
  return found;
}

/// A JSON field with the row's name or alias. An array with the row's name counts whatever its value is; a shape, or an
/// alias, only if its value has the right form. Adds these conditions to forms.
std::optional<Layout> findField(const Coordinate& row, const RecordParts& record, Forms& forms) {
  const auto& names = record.shape.names;
  const CoordinatePart rowName{row.name}, rowOrAlias{row.name, 1, row.aliases};
  const bool isArray = row.form == CoordinateForm::array;
  const bool hasRowName =
      std::any_of(names.begin(), names.end(), [&](const auto& name) { return hasName(name, rowName); });
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!isNamed(names[i], hasRowName ? rowName : rowOrAlias)) continue;
    if (!isArray || !hasRowName) {
      FormOfField form{i, row.form == CoordinateForm::object ? '{' : isArray ? FormOfField::kPoint : '['};
      form.is = form.holds(record.values[i]);
      forms.push_back(form);
      if (!form.is) continue;
    }
    if (found) throw hasBoth(record.offset(i), inQuotes(names[*found]), inQuotes(names[i]), false);
    found = i;
  }
  if (!found) return std::nullopt;
  Layout layout;
  const auto add = [&](NumberField part) {
    part.field = *found;
    part.isArray = part.most > 1;
    if (part.most > 2) part.point = row.kind == kindDirection ? PointForm::vector : PointForm::point;
    layout.parts.push_back(std::move(part));
  };
  if (isArray) add({.fewest = row.fewest, .most = row.most, .mayBeAbsent = row.orNull});
  for (const CoordinatePart& part : row.parts)
    add({.fewest = part.size, .most = part.size, .inner = std::string(part.name)});
  if (row.form == CoordinateForm::points)
    for (std::size_t i = 0; i < row.fewest; ++i) add({.fewest = 3, .most = 3, .item = i, .items = row.fewest});
  return layout;
}

/// The parts of a row in a record, if all required ones are there. Throws RecordError if two fields fit a part.
std::optional<Layout> find(const Coordinate& row, const RecordParts& record, Forms& forms) {
  std::optional<Layout> layout = row.form == CoordinateForm::numbers
                                     ? findEach(record, row.required(), row.fewest, row.orNull)
                                 : record.shape.form == Form::csv ? findColumns(row, record)
                                                                  : findField(row, record, forms);
  if (layout) layout->kind = row.kind;
  return layout;
}

/// "has lat but no height", if a record has some parts of a row; otherwise empty.
std::string missingParts(const Coordinate& row, const Shape& shape) {
  const std::vector<PartMatch> matches = matchParts(shape.names, row.required());
  std::vector<std::string_view> there, missing;
  for (std::size_t i = 0; i < matches.size(); ++i)
    (matches[i].field ? there : missing)
        .push_back(matches[i].field ? shape.names[*matches[i].field] : row.parts[i].name);
  // A single part that is not the first one may mean anything.
  if (!matches[0].field && there.size() < 2) return "";
  return "has " + visible(together(there)) + " but no " + std::string(missing[0]) + fieldsNote(shape);
}

/// The first fields, one number each.
Layout firstFields(std::size_t count, bool mayBeAbsent) {
  Layout layout;
  for (std::size_t i = 0; i < count; ++i) layout.parts.push_back({i, 1, 1, false, mayBeAbsent});
  return layout;
}

std::string numbersIn(const Shape& shape) {
  return "has " + std::to_string(shape.size) + (shape.size == 1 ? " number" : " numbers");
}

// Points and shapes

Layout findChosenPoint(const RecordParts& record, const PointReading& reading) {
  Layout layout = chosenFields(reading.columns, record, false);
  const bool isPlace = reading.columns.has("lat"), isSphere = reading.columns.has("radius");
  if (isPlace && !reading.worldIsEcef) throw RecordError(0, kNotOnEarth);
  layout.kind = isSphere ? (isPlace ? kindPlacedSphere : kindRoundPoint) : (isPlace ? kindPlace : kindPoint);
  return layout;
}

/// A point from numbers without names.
Layout findBarePoint(const RecordParts& record, const PointReading& reading) {
  constexpr std::size_t kMatrix = 16;
  const Shape& shape = record.shape;
  const bool isJson = shape.form == Form::json;
  const std::string matrix = shape.size == kMatrix ? "; info reads a matrix" : "";
  if (shape.size != 3 && !(isJson && shape.size == 4))
    throw RecordError(0, numbersIn(shape) + "; expected x y z" +
                             (isJson           ? " or x y z w"
                              : shape.size > 3 ? ", or --columns, as in 1,2,3, or x,y,z,w for four"
                                               : "") +
                             matrix);
  if (reading.worldIsEcef && shape.size == 3 && shape.form != Form::f64)
    throw RecordError(0, bareTriple(std::string(isJson ? "lat, lon, height or x, y, z of an object, " : "") +
                                    "--columns lat,lon,height or --columns x,y,z"));
  return firstFields(shape.size, false);
}

/// A point and its pixel from five numbers without names.
Layout findBarePair(const RecordParts& record, const PointReading& reading) {
  if (record.shape.size != 5) throw RecordError(0, numbersIn(record.shape) + "; expected x y z u v");
  if (reading.worldIsEcef) throw RecordError(0, bareTriple("--columns lat,lon,height,u,v or --columns x,y,z,u,v"));
  return firstFields(5, false);
}

struct Found {
  const Coordinate* row;
  Layout layout;
};

/// The record's point or shape. Throws RecordError if it has two.
std::optional<Found> findOne(const RecordParts& record, const PointReading& reading, Forms& forms) {
  std::vector<Found> all;
  for (const auto& rows : {std::span<const Coordinate* const>(coordinates::kPoints), {coordinates::kShapes}})
    for (const Coordinate* row : rows)
      if (row != &coordinates::direction)
        if (auto layout = find(*row, record, forms)) all.push_back({row, std::move(*layout)});
  if (auto layout = find(coordinates::segment, record, forms))
    all.push_back({&coordinates::segment, std::move(*layout)});
  if (!reading.worldIsEcef && all.size() > 1)
    std::erase_if(all, [](const Found& found) { return found.row == &coordinates::place; });
  if (all.size() > 1)
    throw hasBoth(0, namesIn(all[0].layout, record.shape), namesIn(all[1].layout, record.shape),
                  isPoint(all[1].layout) || record.shape.form == Form::csv);
  if (all.empty())
    if (auto layout = find(coordinates::direction, record, forms))
      all.push_back({&coordinates::direction, std::move(*layout)});
  return all.empty() ? std::nullopt : std::optional(std::move(all[0]));
}

/// The rows that a command reads, in the order of the table.
std::vector<const Coordinate*> rowsRead(const PointReading& reading) {
  std::vector<const Coordinate*> rows(std::begin(coordinates::kPoints), std::end(coordinates::kPoints));
  if (reading.segments) rows.push_back(&coordinates::segment);
  if (reading.shapes) rows.insert(rows.end(), std::begin(coordinates::kShapes), std::end(coordinates::kShapes));
  return rows;
}

[[noreturn]] void failWithoutPoint(const RecordParts& record, const PointReading& reading, const Forms& forms) {
  const Shape& shape = record.shape;
  const bool csv = shape.form == Form::csv;
  // A field with a shape's name, but without a shape as its value.
  for (const FormOfField& form : forms)
    for (const Coordinate* row : allCoordinates())
      if (row->form != CoordinateForm::array && sameButForCase(row->name, shape.names[form.field]))
        throw RecordError(record.offset(form.field), std::string(row->name) + ": expected " + exampleOf(*row));
  const char* const choose = csv ? "; --columns names the others" : "";
  for (const Coordinate* row : {&coordinates::xyz, &coordinates::place})
    if (const std::string part = missingParts(*row, shape); !part.empty()) throw RecordError(0, part + choose);
  if (csv)
    throw RecordError(0, "has no columns x, y, z or lat, lon, height" + fieldsNote(shape) +
                             "; --columns names them, as in x=E,y=N,z=U");
  throw RecordError(0, "has no point" + std::string(reading.shapes ? " or shape" : "") + "; expected " +
                           namesOf(rowsRead(reading)) + fieldsNote(shape));
}

Layout findNamedPoint(const RecordParts& record, const PointReading& reading) {
  Forms forms;
  auto found = findOne(record, reading, forms);
  if (!found) failWithoutPoint(record, reading, forms);
  auto& [row, layout] = *found;
  if (row == &coordinates::place && !reading.worldIsEcef) throw RecordError(0, kNotOnEarth);
  const bool isSegment = row == &coordinates::segment;
  if (isSegment ? !reading.segments : isShape(layout) && !reading.shapes)
    throw RecordError(record.offset(layout.parts[0].field),
                      "a " + std::string(row->name) + " is not read here; expected " + namesOf(rowsRead(reading)));
  if (reading.radius && isPoint(layout) && row->kind != kindDirection)
    if (const auto radius = find(coordinates::radius, record, forms)) {
      layout.append(*radius);
      layout.kind = layout.kind == kindPlace ? kindPlacedSphere : kindRoundPoint;
    }
  // With a camera on the Earth, an array of three numbers may be a place.
  if (reading.worldIsEcef)
    for (NumberField& part : layout.parts)
      if (part.point == PointForm::point) part.point = PointForm::ofTheEarth;
  layout.forms = std::move(forms);
  return layout;
}

// Pixels

/// A pixel from two or three numbers without names.
Layout findBarePixel(const RecordParts& record) {
  const Shape& shape = record.shape;
  const bool isJson = shape.form == Form::json;
  if (shape.size != 2 && shape.size != 3)
    throw RecordError(0, numbersIn(shape) + "; expected " + (isJson ? "[x, y] or [x, y, depth]" : "x y or x y depth") +
                             (shape.size > 3 && !isJson ? ", or --columns, as in 1,2,3" : ""));
  Layout layout = firstFields(shape.size, !isJson);
  if (shape.size == 3) layout.kind = depthKnown;
  return layout;
}

/// A pixel from screen, pixel or x y, in two slots.
Layout findScreen(const RecordParts& record, Forms& forms) {
  const Shape& shape = record.shape;
  for (const Coordinate* row : coordinates::kPixels) {
    const auto layout = find(*row, record, forms);
    if (!layout) continue;
    const auto z = matchParts(shape.names, std::span(coordinates::kXyzw).subspan(2, 1))[0].field;
    if (z && row == &coordinates::xy)
      throw RecordError(record.offset(*z),
                        "x, y, z is a point of the world, not a pixel; expected screen, pixel or x y alone");
    return *layout;
  }
  if (const std::string part = missingParts(coordinates::xy, shape); !part.empty()) throw RecordError(0, part);
  if (shape.form == Form::csv)
    throw RecordError(
        0, "has no columns screen_x, screen_y or x, y" + fieldsNote(shape) + "; --columns names them, as in x=u,y=v");
  throw RecordError(0, "has no pixel; expected " + namesOf(coordinates::kPixels, ", or ") + fieldsNote(shape));
}

// Making points and pixels from numbers

/// slots: how many numbers belong to the point.
Vec4 pointOf(const Layout& layout, std::size_t slots, const Numbers& n) {
  if (layout.kind == kindPlace || layout.kind == kindPlacedSphere) {
    const Geodetic place{n[0], n[1], n[2]};
    if (!isPlace(place)) throw RecordError(0, "lat: " + formatNumber(place.lat) + " is not from -90 to 90 degrees");
    const Vec3 p = geodeticToEcef(place);
    return {p.x, p.y, p.z, 1};
  }
  const bool hasWeight = slots == 4 && !std::isnan(n[3]);
  const Vec4 point{n[0], n[1], n[2], layout.kind == kindDirection ? 0 : hasWeight ? n[3] : 1};
  if (point == Vec4{0, 0, 0, 0}) throw RecordError(0, "0 0 0 0 is neither a point nor a direction");
  return point;
}

}  // namespace

Layout findPoint(const RecordParts& record, const PointReading& reading) {
  if (reading.columns.given()) return findChosenPoint(record, reading);
  return isNameless(record.shape) ? findBarePoint(record, reading) : findNamedPoint(record, reading);
}

bool isSegment(const Layout& layout) { return layout.kind == kindSegment; }
bool isPoint(const Layout& layout) { return layout.kind <= kindPlace; }
bool isShape(const Layout& layout) { return !isPoint(layout) && !isSegment(layout); }

Vec4 toPoint(const Layout& layout, const Numbers& n) {
  return pointOf(layout, layout.slots() - (layout.kind == kindRoundPoint ? 1 : 0), n);
}

Layout findPixel(const RecordParts& record, const ColumnChoice& columns) {
  Layout layout;
  if (columns.given()) {
    layout = chosenFields(columns, record, true);
    layout.kind = (columns.has("depth") ? depthKnown : 0u) | (columns.has("viewDistance") ? viewDistanceKnown : 0u);
    return layout;
  }
  if (isNameless(record.shape)) return findBarePixel(record);
  Forms forms;
  layout = findScreen(record, forms);
  for (const Coordinate* row : coordinates::kDistances)
    if (const auto part = find(*row, record, forms)) {
      layout.append(*part);
      layout.kind |= row == &coordinates::depth ? depthKnown : viewDistanceKnown;
    }
  layout.forms = std::move(forms);
  return layout;
}

Layout findPair(const RecordParts& record, const PointReading& reading) {
  if (reading.columns.given()) {
    Layout layout = findChosenPoint(record, reading);
    // The table has w last, where it can be left out.
    if (reading.columns.has("w")) std::rotate(layout.parts.begin() + 3, layout.parts.end() - 1, layout.parts.end());
    return layout;
  }
  if (isNameless(record.shape)) return findBarePair(record, reading);
  Layout layout = findNamedPoint(record, reading);
  std::optional<Layout> pixel;
  for (const Coordinate* row : coordinates::kPixelsBesidePoints) {
    auto found = find(*row, record, layout.forms);
    if (!found) continue;
    if (pixel) throw hasBoth(0, namesIn(*pixel, record.shape), namesIn(*found, record.shape), true);
    pixel = std::move(found);
  }
  if (!pixel)
    throw RecordError(0, "has no pixel beside its point; expected " + namesOf(coordinates::kPixelsBesidePoints) +
                             fieldsNote(record.shape));
  for (NumberField& part : pixel->parts) part.mayBeAbsent = false;
  layout.append(*pixel);
  return layout;
}

Pair toPair(const Layout& layout, const Numbers& n) {
  const std::size_t slots = layout.slots() - 2;
  return {pointOf(layout, slots, n), {n[slots], n[slots + 1]}};
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
