// What a record's numbers are called: each way to write a point, a shape or a pixel is a row, which the readers,
// --columns, messages and help follow from. Names count in any letter case. To add a way: a row; another name: an
// alias.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace viewproj::cmd {

enum class CoordinateForm : unsigned char {
  numbers,  ///< a field or column for each part
  array,    ///< a field with an array, or an object of x, y, z; columns NAME_x, NAME_y, ...
  points,   ///< a field with an array of so many points; JSON alone
  object,   ///< a field with an object of the parts; columns PART, or PART_x, ... for a part of three
};

/// What becomes of the numbers.
enum RecordKind : unsigned {
  kindPoint,
  kindDirection,
  kindPlace,
  kindSegment,
  kindSegmentAndPixel,
  kindSphere,
  kindRoundPoint,    ///< a point, and a radius after it
  kindPlacedSphere,  ///< a place, and a radius
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
  std::string_view name;  ///< of the field; of `numbers`, how messages call them
  CoordinateForm form;
  std::size_t fewest, most;  ///< numbers; of `points`, points
  std::string_view help;
  unsigned kind = 0;
  std::span<const CoordinatePart> parts = {};
  bool orNull = false;   ///< null, an empty cell: stands for no value
  Aliases aliases = {};  ///< of an array. Of a field of JSON they count where its value is a point

  std::span<const CoordinatePart> required() const { return parts.first(fewest); }
};

// clang-format off
namespace coordinates {

using enum CoordinateForm;

inline constexpr std::string_view
    kPositionNames[] = {"pos", "point", "location", "xyz"},
    kLatNames[] = {"latitude"},
    kLonNames[] = {"lng", "longitude"},
    kSeaLevelNames[] = {"alt", "altitude", "elevation"};  // read as heights, with a note

inline constexpr CoordinatePart
    kXyzw[] = {{"x"}, {"y"}, {"z"}, {"w"}},
    kXy[] = {{"x"}, {"y"}},
    kPlace[] = {{"lat", 1, kLatNames}, {"lon", 1, kLonNames}, {"height", 1, kSeaLevelNames}},
    kSphere[] = {{"center", 3}, {"radius"}},
    kBox[] = {{"min", 3}, {"max", 3}},
    kRadius[] = {{"radius"}},
    kUv[] = {{"u"}, {"v"}},
    kPxPy[] = {{"px"}, {"py"}},
    kXyzUvw[] = {{"x"}, {"y"}, {"z"}, {"u"}, {"v"}, {"w"}},
    kPlaceUv[] = {{"lat", 1, kLatNames}, {"lon", 1, kLonNames}, {"height", 1, kSeaLevelNames}, {"u"}, {"v"}},
    kDepth[] = {{"depth"}},
    kViewDistance[] = {{"viewDistance"}};

// Points. A record has one of them, or of the shapes.
inline constexpr Coordinate
    position = {"position", array, 3, 4, "a point of the world; with a fourth number w it is (x/w, y/w, z/w), and w = 0 makes it a direction", kindPoint, {}, false, kPositionNames},
    xyz = {"x y z", numbers, 3, 3, "a point of the world, a field or column each", kindPoint, kXyzw},
    place = {"lat lon height", numbers, 3, 3, "a place on the Earth: degrees on WGS84, metres above the ellipsoid", kindPlace, kPlace},
    direction = {"direction", array, 3, 3, "its vanishing point; counts where a record has no other point or shape", kindDirection};
inline constexpr const Coordinate* kPoints[] = {&position, &xyz, &place, &direction};

// Shapes.
inline constexpr Coordinate
    segment = {"segment", points, 2, 2, "from one point to another", kindSegment},
    sphere = {"sphere", object, 4, 4, "all within radius of center", kindSphere, kSphere},
    box = {"box", object, 6, 6, "from min to max along the world's axes", kindBox, kBox},
    triangle = {"triangle", points, 3, 3, "of three corners", kindTriangle},
    radius = {"radius", numbers, 1, 1, "beside a point, to cull and fit, and to project where --fields asks for screenBox: a sphere about it", 0, kRadius};
inline constexpr const Coordinate* kShapes[] = {&sphere, &box, &triangle};

// Pixels, in the order in which they count, and how far away the point is.
inline constexpr Coordinate
    screen = {"screen", array, 2, 2, "a pixel, as project writes it", 0, {}, true},
    pixel = {"pixel", array, 2, 2, "the same", 0, {}, true},
    xy = {"x y", numbers, 2, 2, "the same, a field or column each, without z", 0, kXy},
    uv = {"u v", numbers, 2, 2, "a pixel beside a point, a field or column each", 0, kUv},
    pxPy = {"px py", numbers, 2, 2, "the same", 0, kPxPy},
    depth = {"depth", numbers, 1, 1, "window depth of the point behind the pixel", 0, kDepth, true},
    viewDistance = {"viewDistance", numbers, 1, 1, "its distance along the viewing axis; goes before depth", 0, kViewDistance, true};
inline constexpr const Coordinate *kPixels[] = {&screen, &pixel, &xy}, *kDistances[] = {&depth, &viewDistance},
                                  *kPixelsBesidePoints[] = {&screen, &pixel, &uv, &pxPy};

// Pairs of a point and its pixel, as --columns and lines of numbers have them.
inline constexpr Coordinate
    xyzUv = {"x y z u v", numbers, 5, 6, "a point and its pixel", kindPoint, kXyzUvw},
    placeUv = {"lat lon height u v", numbers, 5, 5, "a place and its pixel", kindPlace, kPlaceUv};

}  // namespace coordinates
// clang-format on

/// Every row.
std::span<const Coordinate* const> allCoordinates();

/// The columns of CSV, all that it may have.
std::vector<std::string> columnsOf(const Coordinate& row);

/// How its value is written: {"center": [x, y, z], "radius": r}.
std::string exampleOf(const Coordinate& row);

/// "position, x y z, lat lon height or direction".
std::string namesOf(std::span<const Coordinate* const> rows, std::string_view last = " or ");

// Names of fields and columns

/// Whether a field has a part's own name, in any letter case, or as a column's (view_distance).
bool hasName(std::string_view field, const CoordinatePart& part);
/// Whether it has that or one of the part's other names.
bool isNamed(std::string_view field, const CoordinatePart& part);

/// The field of a part, and another that fits as well. Own names go before other names.
struct PartMatch {
  std::optional<std::size_t> field, also;
};
std::vector<PartMatch> matchParts(std::span<const std::string> fields, std::span<const CoordinatePart> parts);

/// Whether each part has a field.
bool isWhole(std::span<const PartMatch> matches);

/// Whether a place's height has a name of heights that may be counted from the sea.
bool isSeaLevelName(std::string_view name);
std::string seaLevelNote(std::string_view name);

}  // namespace viewproj::cmd
