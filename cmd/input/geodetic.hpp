// Places in a camera file: positions and targets by lat, lon, height, and turns by heading, pitch, roll.
#pragma once

#include <optional>
#include <string>

#include "input/document.hpp"
#include "viewproj/geodesy.hpp"

namespace viewproj::cmd {

/// The camera has "world": "ecef", or its position or target is a place.
bool worldIsEcef(const ObjectReader& camera);

/// The value of key as a place, if it is an object, and not one of x, y, z. Throws InputError for a lat beyond 90.
std::optional<Geodetic> readPlace(const ObjectReader& camera, const Field& field);

/// A place's own fields. Throws InputError.
Geodetic requirePlace(const ObjectReader& fields);

/// Three numbers, or the ECEF coordinates of a place.
std::optional<Vec3> readPosition(const ObjectReader& camera, const Field& field);

/// Those it lacks are 0.
HeadingPitchRoll readTurn(const ObjectReader& camera);

}  // namespace viewproj::cmd
