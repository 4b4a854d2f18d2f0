// Points and pixels from records.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "input/record.hpp"
#include "viewproj/numbers/vectors.hpp"

namespace viewproj::cmd {

/// The point of a record: [x,y,z], [x,y,z,w]; position, x y z (w) or direction of an object or of a CSV line's columns;
/// three or four numbers of a text line. columns: CSV names of the coordinates, or empty. Throws RecordError.
Vec4 readPoint(const Record& record, const std::vector<std::string>& columns);

/// A pixel to shoot a ray through, with what may be known of the point behind it. viewDistance wins over depth, because
/// it keeps its digits.
struct Pixel {
  std::optional<Vec2> screen;  ///< nothing where the record says null
  std::optional<double> depth;
  std::optional<double> viewDistance;
  bool hasDistance = false;  ///< the record has a field for depth or viewDistance, be it null
};

/// [x,y]; screen, pixel or x y of an object or of a CSV line's columns, with depth or viewDistance; two or three
/// numbers of a text line, NaN for those that have no value. Throws RecordError.
Pixel readPixel(const Record& record, const std::vector<std::string>& columns);

}  // namespace viewproj::cmd
