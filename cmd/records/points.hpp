// Where records have their points, shapes and pixels, and what these are.
#pragma once

#include <optional>
#include <string>

#include "records/columns.hpp"
#include "records/layout.hpp"
#include "viewproj/vectors.hpp"

namespace viewproj::cmd {

/// What a command reads of a record.
struct PointReading {
  ColumnChoice columns = {};
  bool worldIsEcef = false;
  bool segments = false;
  bool shapes = false;  ///< spheres, boxes, triangles too
  bool radius = false;  ///< a point with a radius is a sphere
};

/// The one point or shape of a record: [x,y,z], [x,y,z,w]; what coordinates::kPoints, segment and kShapes have of an
/// object or of a CSV line's columns; three numbers of a text line; the three of f64. Throws RecordError where records
/// of this shape have none, two, or one that is not read; for lat, lon, height unless the camera's world is ECEF, and
/// for three numbers without names where it is.
Layout findPoint(const RecordParts& record, const PointReading& reading);

bool isPoint(const Layout& layout);
/// A sphere, be it a point with a radius, a box or a triangle.
bool isShape(const Layout& layout);
bool isSegment(const Layout& layout);

/// The point, or the middle of a sphere that is a point with a radius. In the world: a place in ECEF. Throws
/// RecordError for 0 0 0 0 and for a lat beyond 90.
Vec4 toPoint(const Layout& layout, const Numbers& numbers);

/// A pixel to shoot a ray through, with what may be known of the point behind it. viewDistance goes before depth,
/// because it keeps its digits.
struct Pixel {
  std::optional<Vec2> screen;  ///< nothing where the record says null
  std::optional<double> depth;
  std::optional<double> viewDistance;
  bool hasDistance = false;  ///< the record has a field for depth or viewDistance, be it null
};

/// [x,y], [x,y,depth]; what coordinates::kPixels has of an object or of a CSV line's columns, with a distance; two or
/// three numbers of a text line or f64, NaN for those that have no value. Throws RecordError.
Layout findPixel(const RecordParts& record, const ColumnChoice& columns);

/// A point, and the pixel that somebody has for it.
struct Pair {
  Vec4 point;
  Vec2 pixel;
};

/// A point as findPoint has it, and one of coordinates::kPixelsBesidePoints; five numbers without names. Throws
/// RecordError.
Layout findPair(const RecordParts& record, const PointReading& reading);
Pair toPair(const Layout& layout, const Numbers& numbers);

bool hasDistance(const Layout& layout);
Pixel toPixel(const Layout& layout, const Numbers& numbers);

}  // namespace viewproj::cmd
