// Reads the projection and the viewport of a camera document.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "camera/read_convention.hpp"
#include "camera/values.hpp"
#include "viewproj/camera.hpp"

namespace viewproj::cmd {

/// What an orthographic camera may lack, and then gets some of.
enum class BoxLack : std::uint8_t { nothing, nearAndFar, sizeToo };

struct ReadOptions {
  bool allowStretch = false;
  bool ignoreDistortion = false;
  bool needsPicture = true;  ///< false: of a picture without a size, near, far and depths alone are right
  BoxLack boxMayLack = BoxLack::nothing;
  bool sizeMayLack = false;  ///< where fx, fy, cx and cy count pixels, which need none
};

/// A picture, and the tile of it that the camera has.
struct PictureFrame {
  Viewport frame;
  std::optional<Crop> crop;
  bool isSizeAssumed = false;  ///< see ReadOptions::sizeMayLack

  Viewport tile() const { return crop ? cropped(frame, *crop) : frame; }
};

/// The bit of the projection's type; 0 without a projection.
std::uint8_t typeOf(const FieldValues& values);

/// The viewport, or else the size of `pixels`; nothing without either.
std::optional<PictureFrame> readPicture(const FieldValues& values, const DocumentConvention& convention,
                                        const ReadOptions& options = {});

/// The frame as fx, fy, cx, cy count it: the picture of `pixels`, which has the same corners.
Viewport pictureOfIntrinsics(const FieldValues& values, Viewport frame);

/// The projection of the frame, with the document's shift; nothing if the document has none. Throws InputError, or
/// CameraError naming a field.
std::optional<Projection> readProjection(const FieldValues& values, const DocumentConvention& convention,
                                         const std::optional<PictureFrame>& picture, const ReadOptions& options);

/// Near and far of a projection matrix. Throws InputError.
Projection readProjectionMatrix(const FieldValues& values, const DocumentConvention& convention);

/// Whether a camera with this aspect fits the viewport: the shapes differ by no more than 0.1 %.
bool hasShape(const Viewport& viewport, double aspect);

}  // namespace viewproj::cmd
