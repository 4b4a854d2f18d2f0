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

/// The range of a camera's numbers, about 1e-271 to 1e271. A window's width and height, a viewport's and a crop's lie
/// within it; a window's edges, a viewport's and a crop's corner and window depths are no larger. The pixels for a unit
/// of the window lie between 2^-1000 and 2^1000. near, far and every number of a pose may be any double that is finite.
inline constexpr double kSmallestWindow = 0x1p-900;
inline constexpr double kLargestWindow = 0x1p900;

/// How many of its widths (heights) a viewport's corner, and its pixels' centre, may lie away from 0.
inline constexpr double kLargestCorner = 0x1p40;

/// Throws CameraError unless every number is finite, width and height are positive, and all are within the range that
/// kSmallestWindow and kLargestWindow state.
void validate(const Viewport& viewport);

/// The tile as a viewport of its own: screen numbers start at its corner.
Viewport cropped(const Viewport& viewport, const Crop& crop);

}  // namespace viewproj
