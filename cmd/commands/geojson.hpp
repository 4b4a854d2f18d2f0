// Outlines as GeoJSON (RFC 7946).
#pragma once

#include <vector>

#include "viewproj/vectors.hpp"

namespace viewproj::cmd {

/// Longitude and latitude of its vertices, in degrees.
using MapRing = std::vector<Vec2>;

/// A ring as rings of a map: anticlockwise, closed, with longitudes from -180 to 180. One that passes the antimeridian
/// is cut there. One that goes round a pole runs along the map's edges and the pole of this latitude, 90 or -90.
std::vector<MapRing> mapRings(const MapRing& ring, double pole);

}  // namespace viewproj::cmd
