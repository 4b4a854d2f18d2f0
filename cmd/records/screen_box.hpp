// The size of a shape on the screen.
#pragma once

#include <optional>

#include "viewproj/scene.hpp"

namespace viewproj::cmd {

/// Screen positions of a rectangle's left, upper, right and lower edge. top is above bottom in the picture, so it is
/// the smaller number if the viewport's origin is topLeft.
struct ScreenBox {
  double left = 0, top = 0, right = 0, bottom = 0;
};

/// Error of each number, relative to itself and the size of the picture. It may be larger for a sphere whose surface is
/// nearer to the eye than 1e-9 of its radius.
inline constexpr double kScreenBoxBound = 0x1.1p-53;

/// The smallest box that holds the part of the shape in front of near or on it, even if outside of the picture or
/// beyond far. Nothing if no part is there, if the shape is invalid, or if there is no near plane. Infinite beyond the
/// largest double. Points within 2^-90 of near count as on it.
///
/// In perspective a sphere is seen as an ellipse between the lines through the eye that touch it. If near cuts the
/// sphere, the circle of the cut counts too. Source of the touching lines: Mara & McGuire, "2D polyhedral bounds of a
/// clipped, perspective-projected 3D sphere", 2013.
std::optional<ScreenBox> screenBox(const Camera& camera, const Sphere& sphere);
std::optional<ScreenBox> screenBox(const Camera& camera, const Box& box);
std::optional<ScreenBox> screenBox(const Camera& camera, const Triangle& triangle);

}  // namespace viewproj::cmd
