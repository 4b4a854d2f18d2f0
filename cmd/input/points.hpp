// Where records have their points and pixels, and what these are.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "input/layout.hpp"
#include "viewproj/vectors.hpp"

namespace viewproj::cmd {

enum PointKind : unsigned { kindPoint, kindDirection, kindPlace, kindSegment, kindSegmentAndPixel };

/// The point of a record: [x,y,z], [x,y,z,w]; position, x y z (w), lat lon height or direction of an object or of a CSV
/// line's columns; three or four numbers of a text line; the three of f64. columns: CSV names of the coordinates, or
/// empty. Throws RecordError where records of this shape have none, and for lat, lon, height unless the camera's world
/// is ECEF.
Layout findPoint(const RecordParts& record, const std::vector<std::string>& columns, bool worldIsEcef);

/// In the world: a place in ECEF. Throws RecordError for 0 0 0 0 and for a lat beyond 90.
Vec4 toPoint(const Layout& layout, const Numbers& numbers);

/// Where records have {"segment": [a, b]}, two points of three numbers, and behind them the two of "pixel", if they
/// have one. Nothing where they have no segment.
std::optional<Layout> findSegment(const RecordParts& record);

/// A pixel to shoot a ray through, with what may be known of the point behind it. viewDistance wins over depth, because
/// it keeps its digits.
struct Pixel {
  std::optional<Vec2> screen;  ///< nothing where the record says null
  std::optional<double> depth;
  std::optional<double> viewDistance;
  bool hasDistance = false;  ///< the record has a field for depth or viewDistance, be it null
};

/// [x,y]; screen, pixel or x y of an object or of a CSV line's columns, with depth or viewDistance; two or three
/// numbers of a text line or f64, NaN for those that have no value. Throws RecordError.
Layout findPixel(const RecordParts& record, const std::vector<std::string>& columns);

bool hasDistance(const Layout& layout);
Pixel toPixel(const Layout& layout, const Numbers& numbers);

}  // namespace viewproj::cmd
