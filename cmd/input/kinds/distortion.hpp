// What a file says of a lens that does not draw straight lines straight. Nothing of it is modelled: it is found,
// whatever it is called, and measured where it is Brown's.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "input/camera_file.hpp"
#include "input/kinds/lookup.hpp"

namespace viewproj::cmd {

/// Coefficients as OpenCV counts them: x' = x (1 + k1 r^2 + k2 r^4 + k3 r^6) / (1 + k4 r^2 + k5 r^4 + k6 r^6)
///   + 2 p1 x y + p2 (r^2 + 2 x^2), y' likewise.
/// Source: OpenCV documentation, "Camera Calibration and 3D Reconstruction".
struct BrownLens {
  std::array<double, 6> k{};
  std::array<double, 2> p{};
};

struct Distortion {
  Path at;                         ///< the first field that is not zero
  bool isModel = false;            ///< that field names a model or is a flag, and no coefficient
  std::optional<BrownLens> brown;  ///< nothing: how far it moves points is not known
};

/// A pinhole, in pixels, and its picture, whose first corner is at `corner`.
struct PinholePicture {
  double fx, fy, cx, cy, width, height, corner;
};

/// Nothing where the lens does not distort. Throws for a model that has no picture plane.
std::optional<Distortion> distortionOf(const CameraPlace& camera);
/// Of all cameras of a file, by the fields around them.
std::optional<Distortion> distortionAround(std::span<const Found> fields, const Kind& kind);
/// Of an array of coefficients.
std::optional<Distortion> distortionAt(const Found& field);
/// The same of the fields of one object, known by their names.
std::optional<Distortion> distortionIn(const Document& document, const Found& object);

/// "by up to 43.1 pixels at 640, 0", or that it is not known.
std::string sizeOf(const Distortion& distortion, const std::optional<PinholePicture>& picture);

/// Throws at a lens that distorts, or notes it where it is to be ignored.
void refuseDistortion(const Document& document, const std::optional<Distortion>& distortion,
                      const std::optional<PinholePicture>& picture, const CameraReading& reading);

}  // namespace viewproj::cmd
