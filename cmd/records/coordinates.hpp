// The names of a record's numbers. Each way to write a point, a shape or a pixel is a row of a table, which the
// readers, --columns, messages and help use. Letter case does not matter. To add a way, add a row; to add another name,
// add an alias.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "camera/field_columns.hpp"

namespace viewproj::cmd {

enum class CoordinateForm : unsigned char {
  numbers,  ///< one field or column per part
  array,    ///< one field with an array, or an object of x, y, z; columns NAME_x, NAME_y, ...
  points,   ///< one field with an array of points; only in JSON
  object,   ///< one field with an object of the parts; columns PART, or PART_x, ... for a part of three numbers
};

/// How the numbers are used.
enum RecordKind : unsigned {
  kindPoint,
  kindDirection,
  kindPlace,
  kindSegment,
  kindSphere,
  kindRoundPoint,    ///< a point followed by a radius
  kindPlacedSphere,  ///< a place followed by a radius
  kindBox,
  kindTriangle
};

using Aliases = std::span<const std::string_view>;

struct CoordinatePart {
  std::string_view name;
  std::size_t size = 1;
  Aliases aliases = {};
};

struct Coordinate {
  std::string_view name;  ///< name of the field; for `numbers`, the name in messages
  CoordinateForm form;
  std::size_t fewest, most;  ///< how many numbers; for `points`, how many points
  std::string_view help;
  unsigned kind = 0;
  std::span<const CoordinatePart> parts = {};
  bool orNull = false;      ///< null, or all cells empty, means no value
  Aliases aliases = {};     ///< for arrays; a JSON field with an alias counts only if its value is a point
  bool isNameFirst = true;  ///< its name is preferred to its aliases; otherwise both are an error

  std::span<const CoordinatePart> required() const { return parts.first(fewest); }
};

// clang-format off
namespace coordinates {

using enum CoordinateForm;

inline constexpr std::string_view
    kPositionNames[] = {"pos", "point", "location", "xyz"},
    kLatNames[] = {"latitude"},
    kLonNames[] = {"lng", "longitude"},
    kEastNames[] = {"east"},
    kNorthNames[] = {"north"};

inline constexpr CoordinatePart
    kXyzw[] = {{"x"}, {"y"}, {"z"}, {"w"}},
    kXy[] = {{"x"}, {"y"}},
    kPlace[] = {{"lat", 1, kLatNames}, {"lon", 1, kLonNames}, {"height", 1, kHeightNames}},
    kMap[] = {{"easting", 1, kEastNames}, {"northing", 1, kNorthNames}, {"height", 1, kHeightNames}},
    kSphere[] = {{"center", 3}, {"radius"}},
    kBox[] = {{"min", 3}, {"max", 3}},
    kRadius[] = {{"radius"}},
    kUv[] = {{"u"}, {"v"}},
    kPxPy[] = {{"px"}, {"py"}},
    kTwoUv[] = {{"u1"}, {"v1"}, {"u2"}, {"v2"}},
    kTwoXy[] = {{"x1"}, {"y1"}, {"x2"}, {"y2"}},
    kXyzUvw[] = {{"x"}, {"y"}, {"z"}, {"u"}, {"v"}, {"w"}},
    kPlaceUv[] = {{"lat", 1, kLatNames}, {"lon", 1, kLonNames}, {"height", 1, kHeightNames}, {"u"}, {"v"}},
    kDepth[] = {{"depth"}},
    kViewDistance[] = {{"viewDistance"}},
    kRange[] = {{"range"}};

// Points. A record has one point or shape.
inline constexpr Coordinate
    position = {"position", array, 3, 4, "a point of the world; with a fourth number w it is (x/w, y/w, z/w), and w = 0 makes it a direction", kindPoint, {}, true, kPositionNames},
    xyz = {"x y z", numbers, 3, 3, "a point of the world, one field or column per number", kindPoint, kXyzw, true},
    place = {"lat lon height", numbers, 3, 3, "a place on the Earth: degrees on WGS84, metres above the ellipsoid", kindPlace, kPlace, true},
    map = {"easting northing height", numbers, 3, 3, "a point of a map, as x, y, z", kindPoint, kMap, true},
    direction = {"direction", array, 3, 3, "a direction, shown at its vanishing point; used only if the record has no other point or shape", kindDirection, {}, true};
inline constexpr const Coordinate* kPoints[] = {&position, &xyz, &place, &map, &direction};

// Shapes.
inline constexpr Coordinate
    segment = {"segment", points, 2, 2, "from one point to another", kindSegment},
    sphere = {"sphere", object, 4, 4, "all points within radius of center", kindSphere, kSphere},
    box = {"box", object, 6, 6, "from min to max along the world's axes", kindBox, kBox},
    triangle = {"triangle", points, 3, 3, "three corners", kindTriangle},
    radius = {"radius", numbers, 1, 1, "with a point: a sphere around it (for cull, fit, and project --fields screenBox)", 0, kRadius};
inline constexpr const Coordinate* kShapes[] = {&sphere, &box, &triangle};

// Pixels, in order of preference, and the distance of the point behind them.
inline constexpr Coordinate
    screen = {"screen", array, 2, 2, "a pixel, as project writes it", 0, {}, true},
    pixel = {"pixel", array, 2, 2, "the same", 0, {}, true},
    xy = {"x y", numbers, 2, 2, "the same, one field or column per number, without z", 0, kXy, true},
    uv = {"u v", numbers, 2, 2, "the same; also beside a point", 0, kUv, true},
    pxPy = {"px py", numbers, 2, 2, "the same", 0, kPxPy, true},
    depth = {"depth", numbers, 1, 1, "window depth of the point behind the pixel", 0, kDepth, true},
    viewDistance = {"viewDistance", numbers, 1, 1, "its distance along the viewing axis; preferred to depth", 0, kViewDistance, true},
    range = {"range", numbers, 1, 1, "its distance from the eye; used only without the others", 0, kRange, true};
inline constexpr const Coordinate *kPixels[] = {&screen, &pixel, &xy, &uv, &pxPy}, *kDistances[] = {&depth, &viewDistance, &range},
                                  *kPixelsBesidePoints[] = {&screen, &pixel, &uv, &pxPy};

// A point's pixels in two cameras.
inline constexpr Coordinate
    twoUv = {"u1 v1 u2 v2", numbers, 4, 4, "a point's pixels in two cameras, for triangulate", 0, kTwoUv},
    twoXy = {"x1 y1 x2 y2", numbers, 4, 4, "the same", 0, kTwoXy};

// Pairs of a point and its pixel, for --columns and lines of numbers.
inline constexpr Coordinate
    xyzUv = {"x y z u v", numbers, 5, 6, "a point and its pixel", kindPoint, kXyzUvw},
    placeUv = {"lat lon height u v", numbers, 5, 5, "a place and its pixel", kindPlace, kPlaceUv};

}  // namespace coordinates
// clang-format on

/// All rows.
std::span<const Coordinate* const> allCoordinates();

/// All CSV columns that the row may have.
std::vector<std::string> columnsOf(const Coordinate& row);

/// An example of the row's value: {"center": [x, y, z], "radius": r}.
std::string exampleOf(const Coordinate& row);

/// "position, x y z, lat lon height or direction".
std::string namesOf(std::span<const Coordinate* const> rows, std::string_view last = " or ");

// Names of fields and columns

/// Whether a field has the part's name, in any letter case, or its name as a column (view_distance).
bool hasName(std::string_view field, const CoordinatePart& part);
/// Whether a field has the part's name or one of its aliases.
bool isNamed(std::string_view field, const CoordinatePart& part);

/// The field for a part, and another field that fits too. The part's name is preferred to its aliases.
struct PartMatch {
  std::optional<std::size_t> field, also;
};
std::vector<PartMatch> matchParts(std::span<const std::string> fields, std::span<const CoordinatePart> parts);

/// Whether every part has a field.
bool isWhole(std::span<const PartMatch> matches);

}  // namespace viewproj::cmd
