// The viewport of a camera file, whatever form the file has.
#pragma once

#include <optional>
#include <string>

#include "input/document.hpp"
#include "viewproj/camera.hpp"

namespace viewproj::cmd {

struct ReadViewport {
  Viewport frame;
  std::optional<Crop> crop;

  /// The tile, whose corner is at the frame's x and y; or else the frame.
  Viewport tile() const;
};

/// What a file says of its picture elsewhere.
struct ViewportDefaults {
  std::optional<double> width = {}, height = {};
  double pixelCenter = 0.5;
};

/// The object "viewport" of the file; the defaults where it or a part of it is absent. Nothing if the size is unknown.
/// Throws InputError, or CameraError naming "viewport.…".
std::optional<ReadViewport> readViewport(const ObjectReader& file, const ViewportDefaults& defaults);

/// Width / height.
DoubleDouble viewportAspect(const Viewport& viewport);

/// Whether the viewport has this shape (width / height), to a thousandth of it.
bool hasShape(const Viewport& viewport, DoubleDouble shape);

/// The projection whose picture has the shape (width / height) that the file says it has. Throws InputError, with the
/// mend, unless the viewport has that shape.
void requireShape(DoubleDouble shape, const Viewport& viewport, const ObjectReader& projection,
                  const std::string& mend = "");

}  // namespace viewproj::cmd
