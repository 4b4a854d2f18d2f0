// Shapes from records: what cull reads.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "input/layout.hpp"
#include "viewproj/scene.hpp"

namespace viewproj::cmd {

using CullShape = std::variant<Vec3, Sphere, Box, Triangle>;

/// "sphere": {"center", "radius"}, "box": {"min", "max"} or "triangle": [a, b, c] of a JSON object; columns center_x,
/// center_y, center_z, radius or min_x, ... max_z of CSV; otherwise a point. Throws RecordError.
Layout findShape(const RecordParts& record, const std::vector<std::string>& columns, bool worldIsEcef);

/// Throws RecordError where the numbers make no shape, and for a direction.
CullShape toShape(const Layout& layout, const Numbers& numbers);

}  // namespace viewproj::cmd
