// A photo under a picture.
#pragma once

#include <string>

#include "viewproj/camera.hpp"

namespace viewproj::cmd {

/// A JPEG or PNG file as a data URL. A picture in a page loads no other file. Throws InputError, also if the photo's
/// size is not the viewport's: a stretched one would hide the mistake.
std::string photoUrl(const std::string& file, const Viewport& viewport);

}  // namespace viewproj::cmd
