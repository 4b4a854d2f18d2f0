// viewproj info: what is in a camera file.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "camera/read_camera.hpp"
#include "output/report.hpp"

namespace viewproj::cmd {

/// Distances at which a pixel's size is told where none are given; the target's comes on top.
inline constexpr double kUsualDistances[] = {1, 10, 100};

/// One camera, whole or in part: every member is always there, null for what the camera has not. Planes, corners and
/// fx ... cy are those of the lens without distortion.
OrderedJson infoReport(const CameraFile& camera, const std::optional<std::string>& name,
                       std::span<const double> distances);

/// {"name", "type", "size", "pose"}: a row of a list of cameras. The document is normalized; its lens is not read, so
/// that it may lack a picture. Throws InputError, and CameraError naming a field of the pose.
OrderedJson cameraRow(const std::string& name, const Document& document);

}  // namespace viewproj::cmd
