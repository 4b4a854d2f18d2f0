// A camera as the canonical file, in any of its forms.
//
// A file holds doubles, a camera double-doubles. So what is written is read again and the two compared: where doubles
// do not suffice (a tile far off the axis of a picture of 1e9 pixels) the caller learns by how much.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "camera/document.hpp"
#include "camera/read_camera.hpp"

namespace viewproj::cmd {

/// A file keeps a camera's pixels that shows all points this close to where the camera does: in pixels, and in depth as
/// a share of the range.
inline constexpr double kKeptPixels = 1e-9, kKeptDepth = 1e-12;

/// The most by which a point in the picture moves.
struct Moved {
  double pixels = 0, depth = 0;

  /// Kept up to 1.
  double size() const { return std::max(pixels / kKeptPixels, depth / kKeptDepth); }
};

struct WrittenCamera {
  std::string text;
  Moved moved;        ///< when the file is read instead
  double turned = 0;  ///< its axes then, by so many radians at the most
};

/// The names of the forms of a projection.
std::vector<std::string_view> cameraTypes();

/// type: one of cameraTypes(), or empty for one that keeps the pixels. allowStretch: whoever reads the file will allow
/// a camera shape unlike the viewport's. Throws InputError for what the type cannot hold.
WrittenCamera writeCamera(const CameraFile& camera, std::string_view type, bool allowStretch);

/// A checked camera document as it stands, in this convention, of which preset is the nearest. What it leaves to the
/// preset that it was read in is added where the other one has something else.
std::string writeDocument(const Document& document, const ConventionPreset& preset, const Convention& convention);

/// From where the first camera shows what is in its picture to where the second does, from near to far: over the
/// corners, the sides' middles and the centre. Parts that a file lacks are the same in both; no viewport counts as
/// 1920 by 1080 pixels.
Moved movedBetween(const CameraFile& first, const CameraFile& second);

}  // namespace viewproj::cmd
