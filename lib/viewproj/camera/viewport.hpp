// The rectangle of pixels a picture fills.
#pragma once

namespace viewproj {

/// The corner that screen y is counted from: downwards from the top left, upwards from the bottom left.
enum class Origin { topLeft, bottomLeft };

/// Pixel values are positions: the centre of pixel (i, j) is (i + pixelCenter, j + pixelCenter).
struct Viewport {
  double width = 0, height = 0;            ///< pixels, > 0
  double x = 0, y = 0;                     ///< where the corner of the picture lies on the screen
  double depthFirst = 0, depthSecond = 1;  ///< window depth of near and far; exchanged by reverseZ
  Origin origin = Origin::topLeft;
  double pixelCenter = 0.5;
};

/// A tile of a viewport's picture, in pixels from the picture's corner.
struct Crop {
  double x = 0, y = 0, width = 0, height = 0;
};

/// How many of its widths (heights) a viewport's corner, and its pixels' centre, may lie away from 0.
inline constexpr double kLargestCorner = 0x1p40;

/// Throws CameraError unless every number is finite, width and height are positive, and all are within the range that
/// kSmallestWindow and kLargestWindow (projection.hpp) state.
void validate(const Viewport& viewport);

/// The tile as a viewport of its own: screen numbers start at its corner.
Viewport cropped(const Viewport& viewport, const Crop& crop);

}  // namespace viewproj
