// Which way is up on the Earth, to more digits than doubles have.
#pragma once

#include "camera/pose.hpp"
#include "viewproj/geodesy.hpp"

namespace viewproj::detail {

/// The ellipsoid's outward normal, of unit length: up for lookAt and lookAlong. NaN for what is no place.
FineVec3 exactNormal(const Geodetic& place) noexcept;

}  // namespace viewproj::detail
