// Where records have their points, shapes and pixels, and making these from numbers.
#pragma once

#include <optional>
#include <string>

#include "records/columns.hpp"
#include "records/number_plan.hpp"
#include "viewproj/vectors.hpp"

namespace viewproj::cmd {

/// What a command reads in a record.
struct PointReading {
  ColumnChoice columns = {};
  bool worldIsEcef = false;
  bool segments = false;
  bool shapes = false;        ///< also spheres, boxes and triangles
  bool radius = false;        ///< a point with a radius is a sphere
  bool besideCamera = false;  ///< position may be the record's camera's, and is not preferred to its other names
  bool polygons = false;      ///< the caller reads them: messages name them
};

/// Finds the point or shape of a record: [x,y,z] or [x,y,z,w]; a row of coordinates::kPoints, segment or kShapes in an
/// object or in CSV columns; three numbers of a text line or f64. Throws RecordError if records of this shape have
/// none, two, or one that is not read; for lat, lon, height if the camera's world is not ECEF, and for three numbers
/// without names if it is.
NumberPlan findPoint(const RecordView& record, const PointReading& reading);

bool isPoint(const NumberPlan& plan);
/// A sphere (also a point with a radius), a box or a triangle.
bool isShape(const NumberPlan& plan);
bool isSegment(const NumberPlan& plan);
/// Whether a point in ECEF may come from a place, whose coordinates are rounded.
bool mayBePlace(const NumberPlan& plan);

/// The point, or the centre of a point with a radius, in world coordinates (ECEF for a place). Throws RecordError for
/// null, for 0 0 0 0 and for a lat beyond 90.
Vec4 toPoint(const NumberPlan& plan, const Numbers& numbers);

/// A pixel to shoot a ray through, and the distance of the point behind it, if known. viewDistance is preferred to
/// depth because it keeps its digits.
struct Pixel {
  std::optional<Vec2> screen;  ///< empty if the record has null
  std::optional<double> depth;
  std::optional<double> viewDistance;
  std::optional<double> range;  ///< from the eye
  bool hasDistance = false;     ///< the record has a field for one of these, even if null
};

/// Finds a pixel: [x,y] or [x,y,depth]; a row of coordinates::kPixels in an object or in CSV columns, with a distance;
/// two or three numbers of a text line or f64, NaN for no value. Throws RecordError.
NumberPlan findPixel(const RecordView& record, const ColumnChoice& columns);

/// Finds coordinates::twoUv, or four numbers without names. Throws RecordError.
NumberPlan findTwoPixels(const RecordView& record, const ColumnChoice& columns);

/// Finds a point as findPoint does, and one of coordinates::kPixelsBesidePoints; or five numbers without names. Throws
/// RecordError.
NumberPlan findPair(const RecordView& record, const PointReading& reading);
/// Empty if the record has null: the point has no pixel. Throws RecordError for one number.
std::optional<Vec2> pixelBesidePoint(const NumberPlan& plan, const Numbers& numbers);

/// Whether findPair finds a pixel, where findPoint finds a point.
bool hasPixelBesidePoint(const RecordView& record, const ColumnChoice& columns);

bool hasDistance(const NumberPlan& plan);
Pixel toPixel(const NumberPlan& plan, const Numbers& numbers);

}  // namespace viewproj::cmd
