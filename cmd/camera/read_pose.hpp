// Where a camera document says that the camera stands, and how it is turned.
#pragma once

#include <array>
#include <optional>

#include "camera/document.hpp"
#include "numbers/vectors.hpp"
#include "viewproj/camera.hpp"
#include "viewproj/geodesy.hpp"

namespace viewproj::cmd {

struct DocumentConvention {
  const ConventionPreset* preset;  ///< whose up, axes and pixel centre count
  Convention convention;           ///< with the axes that the document names
  bool isStated;
};
DocumentConvention readConvention(const Document& document);

/// Whether world coordinates are Earth-centred, Earth-fixed metres.
bool worldIsEcef(const Document& document);

/// {"lat", "lon", "height"}, and no x, y, z.
bool isPlaceValue(const Node& value);
Geodetic placeOf(const Node& value);
/// x, y, z, or of a place its ECEF coordinates.
Vec3 positionOf(const Node& value);

/// Of the rotation that x, y, z, w of any length are. Throws where they are all 0.
std::array<detail::DDVec3, 3> rotationColumns(const Node& quaternion);

/// Of worldFromCamera or cameraFromWorld; nothing where its rotation is a quaternion or a rotation vector.
std::optional<Mat4> rigidMatrix(const Node& value);

/// Nothing where the document says nothing of how the camera is turned. The document is normalized. Throws InputError,
/// and CameraError naming a field.
std::optional<Pose> readPose(const Document& document);

}  // namespace viewproj::cmd
