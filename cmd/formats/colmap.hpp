// COLMAP's reconstructions as text and binary.
#pragma once

#include <optional>
#include <string>

#include "camera/camera_set.hpp"

namespace viewproj::cmd {

/// A folder of a reconstruction, or one of its files; the folder with the model: the folder itself, sparse/0 or 0 in
/// it. Nothing if it is none.
std::optional<std::string> colmapModel(const std::string& source);

/// {"cameras": {"1": {...}}, "images": [...]} of what colmapModel() found. Throws InputError.
Json readColmap(const std::string& model);
Import openColmap(const Node& root);

}  // namespace viewproj::cmd
