// Nothing is half read: what a format has not read of a file, and holds numbers.
#pragma once

#include <memory>
#include <string_view>

#include "camera/camera_set.hpp"

namespace viewproj::cmd {

/// Whether a number of this name may be of a camera's pose or lens.
bool mayBeOfCamera(std::string_view name);

/// The same cameras, whose documents throw InputError where what is left of the file looks like the camera's pose or
/// lens; what else has three numbers or more, or is a number other than 0 and 1 beside what was read, is what was not
/// read. known: members that say nothing about the picture, separated by blanks; "*" is any text.
Import judged(const std::shared_ptr<Document>& file, Import cameras, std::string_view known);

}  // namespace viewproj::cmd
