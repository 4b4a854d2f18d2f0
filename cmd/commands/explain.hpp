// viewproj explain: every stage of one point or pixel.
#pragma once

#include <optional>

#include "output/report.hpp"
#include "viewproj/camera.hpp"

namespace viewproj::cmd {

// Each step's value is the double nearest the true one, and its formula names what it is made of: numbers of steps
// above it, and entries of the matrices beside them, as the convention writes them on paper. The result is what
// `project` and `ray` give.

/// point: before the model matrix, if there is one. Throws InputError where that takes it out of the range of doubles.
OrderedJson explainPoint(const Camera& camera, const Convention& convention, const Vec4& point,
                         const std::optional<Mat4>& model = std::nullopt);

/// Throws InputError for a depth that no point in front of the eye has.
OrderedJson explainPixel(const Camera& camera, const Convention& convention, const Vec2& pixel,
                         std::optional<double> depth = std::nullopt);

}  // namespace viewproj::cmd
