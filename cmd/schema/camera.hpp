// The JSON Schema of a camera file.
#pragma once

#include <string>

namespace viewproj::cmd {

std::string cameraSchema();

}  // namespace viewproj::cmd
