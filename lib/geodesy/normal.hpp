// The up direction on the Earth, with more digits than doubles have.
#pragma once

#include "camera/pose.hpp"
#include "viewproj/geodesy.hpp"

namespace viewproj::detail {

/// The ellipsoid's outward unit normal: the up vector for lookAt and lookAlong. NaN if place is invalid.
FineVec3 exactNormal(const Geodetic& place) noexcept;

}  // namespace viewproj::detail
