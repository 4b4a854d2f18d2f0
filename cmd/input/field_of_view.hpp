// The angles that a window is seen under, wherever the viewing axis meets it.
#pragma once

#include "numbers/double_double.hpp"

namespace viewproj::cmd {

/// Degrees between the directions (from, 1) and (to, 1), from <= to: those of a window at unit distance. Within an ulp.
double degreesAcross(detail::DoubleDouble from, detail::DoubleDouble to) noexcept;

/// Degrees between the directions to two corners, (x0, y0, 1) and (x1, y1, 1). Within an ulp.
double degreesBetween(detail::DoubleDouble x0, detail::DoubleDouble y0, detail::DoubleDouble x1,
                      detail::DoubleDouble y1) noexcept;

}  // namespace viewproj::cmd
