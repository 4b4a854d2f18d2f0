// Reads the pose of a camera document.
#pragma once

#include <array>
#include <optional>

#include "camera/document.hpp"
#include "numbers/vectors.hpp"
#include "viewproj/camera.hpp"
#include "viewproj/geodesy.hpp"

namespace viewproj::cmd {

struct DocumentConvention {
  const ConventionPreset* preset;  ///< its up, axes and pixel centre apply
  Convention convention;           ///< the preset's, with the document's changes
  bool isStated;
};
DocumentConvention readConvention(const Document& document);

/// Whether world coordinates are Earth-centred, Earth-fixed metres.
bool worldIsEcef(const Document& document);

/// Whether a value is {"lat", "lon", "height"} and not x, y, z.
bool isPlaceValue(const Node& value);
Geodetic placeOf(const Node& value);
/// x, y, z, or a place in ECEF coordinates.
Vec3 positionOf(const Node& value);

/// The columns of the rotation x, y, z, w of any length. Throws if all are 0.
std::array<detail::DDVec3, 3> rotationColumns(const Node& quaternion);

/// The matrix of worldFromCamera or cameraFromWorld. Nothing if its rotation is a quaternion or a rotation vector.
std::optional<Mat4> rigidMatrix(const Node& value);

/// The pose of a normalized document; nothing without an orientation. Throws InputError, or CameraError naming a field.
std::optional<Pose> readPose(const Document& document);

}  // namespace viewproj::cmd
