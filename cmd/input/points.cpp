#include "input/points.hpp"

#include <cmath>

#include "text/error.hpp"
#include "text/format_number.hpp"
#include "viewproj/geodesy.hpp"

namespace viewproj::cmd {
namespace {

/// What a pixel's numbers are, in this order.
enum PixelParts : unsigned { depthKnown = 1, viewDistanceKnown = 2 };

NumberField array(std::size_t field, std::size_t fewest, std::size_t most) { return {field, fewest, most, true}; }

/// The first `count` fields, each a number.
Layout firstFields(std::size_t count, bool mayBeAbsent) {
  Layout layout;
  for (std::size_t i = 0; i < count; ++i) layout.parts.push_back({i, 1, 1, false, mayBeAbsent});
  return layout;
}

/// The fields of these names, if the record has the first of them. Throws RecordError if it lacks another.
std::optional<Layout> namedNumbers(const Shape& shape, const std::vector<std::string>& names, std::size_t required,
                                   bool mayBeAbsent = false) {
  if (!shape.find(names[0])) return std::nullopt;
  Layout layout;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto field = shape.find(names[i]);
    if (field)
      layout.parts.push_back({*field, 1, 1, false, mayBeAbsent});
    else if (i < required)
      throw RecordError(0, "has " + names[0] + " but no " + names[i]);
    else
      break;
  }
  return layout;
}

/// The columns NAME_x, NAME_y, ... of CSV.
std::optional<Layout> suffixedNumbers(const Shape& shape, const std::string& name, std::size_t required,
                                      std::size_t most, bool mayBeAbsent = false) {
  static constexpr const char* kSuffixes[] = {"_x", "_y", "_z", "_w"};
  std::vector<std::string> names;
  for (std::size_t i = 0; i < most; ++i) names.push_back(name + kSuffixes[i]);
  return namedNumbers(shape, names, required, mayBeAbsent);
}

Layout ofKind(PointKind kind, Layout layout) {
  layout.kind = kind;
  return layout;
}

Vec4 toWorld(const Geodetic& place) {
  if (!isPlace(place)) throw RecordError(0, "lat: " + formatNumber(place.lat) + " is not from -90 to 90 degrees");
  const Vec3 p = geodeticToEcef(place);
  return {p.x, p.y, p.z, 1};
}

RecordError withoutColumn(const std::string& name) {
  return RecordError(0, "has no column " + name + ", which --columns names");
}

/// screen, pixel or x y: two slots.
Layout findScreen(const RecordParts& record, const std::vector<std::string>& columns) {
  const Shape& shape = record.shape;
  const bool csv = shape.form == Form::csv;
  if (csv && !columns.empty()) {
    const auto named = namedNumbers(shape, columns, 2);
    if (!named) throw withoutColumn(columns[0]);
    return *named;
  }
  for (const char* name : {"screen", "pixel"}) {
    if (csv) {
      if (const auto named = suffixedNumbers(shape, name, 2, 2, true)) return *named;
    } else if (const auto field = shape.find(name)) {
      return {{{*field, 2, 2, true, true}}};
    }
  }
  if (const auto z = shape.find("z"); z && shape.find("x"))
    throw RecordError(record.offset(*z),
                      "x, y, z is a point of the world, not a pixel; expected screen, pixel or x y alone");
  const auto named = namedNumbers(shape, {"x", "y"}, 2);
  if (!named)
    throw RecordError(0, csv ? "has no columns screen_x, screen_y or x, y; --columns names the two"
                             : "has no pixel; expected screen, pixel, or x y");
  return *named;
}

}  // namespace

Layout findPoint(const RecordParts& record, const std::vector<std::string>& columns, bool worldIsEcef) {
  const Shape& shape = record.shape;
  if (shape.isArray) {
    if (shape.size != 3 && shape.size != 4)
      throw RecordError(0, "has " + std::to_string(shape.size) + " numbers; expected x y z or x y z w");
    return firstFields(shape.size, false);
  }
  if (shape.form == Form::csv) {
    if (!columns.empty()) {
      const auto named = namedNumbers(shape, columns, 3);
      if (!named) throw withoutColumn(columns[0]);
      return *named;
    }
    if (const auto named = suffixedNumbers(shape, "position", 3, 4)) return *named;
  } else if (const auto position = shape.find("position")) {
    return {{array(*position, 3, 4)}};
  }
  if (const auto named = namedNumbers(shape, {"x", "y", "z", "w"}, 3)) return *named;
  if (const auto named = namedNumbers(shape, {"lat", "lon", "height"}, 3)) {
    if (!worldIsEcef)
      throw RecordError(0,
                        "lat, lon, height need a camera that stands on the Earth: a position by lat, lon, height, or "
                        "\"world\": \"ecef\"");
    return ofKind(kindPlace, *named);
  }
  if (shape.form == Form::csv) {
    if (const auto named = suffixedNumbers(shape, "direction", 3, 3)) return ofKind(kindDirection, *named);
    throw RecordError(0, "has no columns x, y, z or lat, lon, height; --columns names x, y and z");
  }
  if (const auto field = shape.find("direction")) return ofKind(kindDirection, {{array(*field, 3, 3)}});
  throw RecordError(0, "has no point; expected position, x y z, lat lon height, or direction");
}

std::optional<Layout> findSegment(const RecordParts& record) {
  const Shape& shape = record.shape;
  const auto field = shape.find("segment");
  if (!field || shape.form != Form::json) return std::nullopt;
  Layout layout;
  layout.kind = kindSegment;
  for (std::size_t end : {0u, 1u}) layout.parts.push_back({*field, 3, 3, true, false, {}, end, 2});
  if (const auto pixel = shape.find("pixel")) {
    layout.kind = kindSegmentAndPixel;
    layout.parts.push_back({*pixel, 2, 2, true, true});
  }
  return layout;
}

Vec4 toPoint(const Layout& layout, const Numbers& n) {
  if (layout.kind == kindPlace) return toWorld({n[0], n[1], n[2]});
  double w = 1;
  if (layout.kind == kindDirection)
    w = 0;
  else if (layout.slots() == 4 && !std::isnan(n[3]))
    w = n[3];
  const Vec4 point{n[0], n[1], n[2], w};
  if (point == Vec4{0, 0, 0, 0}) throw RecordError(0, "0 0 0 0 is neither a point nor a direction");
  return point;
}

Layout findPixel(const RecordParts& record, const std::vector<std::string>& columns) {
  const Shape& shape = record.shape;
  if (shape.isArray) {
    const bool json = shape.form == Form::json;
    if (json && shape.size != 2)
      throw RecordError(
          0, "has " + std::to_string(shape.size) + " numbers; expected [x, y], or {\"screen\": [x, y], \"depth\": d}");
    if (shape.size != 2 && shape.size != 3)
      throw RecordError(0, "has " + std::to_string(shape.size) + " numbers; expected x y or x y depth");
    Layout layout = firstFields(shape.size, !json);
    if (shape.size == 3) layout.kind = depthKnown;
    return layout;
  }
  Layout layout = findScreen(record, columns);
  if (const auto depth = shape.find("depth")) {
    layout.parts.push_back({*depth, 1, 1, false, true});
    layout.kind |= depthKnown;
  }
  auto distance = shape.find("viewDistance");
  if (!distance && shape.form == Form::csv) distance = shape.find("view_distance");
  if (distance) {
    layout.parts.push_back({*distance, 1, 1, false, true});
    layout.kind |= viewDistanceKnown;
  }
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
