// How large a shape is on the screen.
#pragma once

#include <optional>

#include "viewproj/scene.hpp"

namespace viewproj::cmd {

/// Screen positions: of the left, upper, right and lower edge of a rectangle. top is above bottom in the picture, and
/// so the smaller number where the viewport's origin is topLeft.
struct ScreenBox {
  double left = 0, top = 0, right = 0, bottom = 0;
};

/// Each number is within this of the true one, relative to itself and the size of the picture; of a sphere whose
/// surface is nearer to the eye than 1e-9 of its radius it may be more.
inline constexpr double kScreenBoxBound = 0x1.1p-53;

/// The smallest that holds what of the shape lies in front of near or on it, however far out of the picture and beyond
/// far; nothing where nothing does, for a shape that is not valid, and without a near plane, which it needs. Infinite
/// beyond the largest double. What lies within 2^-90 of near counts as on it.
///
/// A sphere is seen as an ellipse (perspective) between the lines through the eye that touch it; where near cuts it,
/// the circle of the cut counts too. Source of the touching lines: Mara & McGuire, "2D polyhedral bounds of a clipped,
/// perspective-projected 3D sphere", 2013.
std::optional<ScreenBox> screenBox(const Camera& camera, const Sphere& sphere);
std::optional<ScreenBox> screenBox(const Camera& camera, const Box& box);
std::optional<ScreenBox> screenBox(const Camera& camera, const Triangle& triangle);

}  // namespace viewproj::cmd
