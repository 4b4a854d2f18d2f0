// Shapes from records: what cull reads.
#pragma once

#include <variant>

#include "records/layout.hpp"
#include "viewproj/scene.hpp"

namespace viewproj::cmd {

using CullShape = std::variant<Vec3, Sphere, Box, Triangle>;

/// Throws RecordError where the numbers make no shape, and for a direction.
CullShape toShape(const Layout& layout, const Numbers& numbers);

}  // namespace viewproj::cmd
