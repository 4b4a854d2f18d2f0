// A camera document as text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "camera/read_camera.hpp"

namespace viewproj::cmd {

/// The document as text, with its kind of pose and projection, in another convention; see inConvention(). between: what
/// stands between two members.
std::string writeCamera(const CameraFile& camera, const ConventionPreset& preset, const Convention& convention,
                        std::string_view between = ",\n  ");

/// What makes the second document of the first: values for --set, such as "projection.fovY=42.1" or "target=null". A
/// projection of another type is one value.
std::vector<std::string> setsBetween(const Document& from, const Document& to);

}  // namespace viewproj::cmd
