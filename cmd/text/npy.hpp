// Reads arrays of numpy: .npy, and .npz, which is a zip of them.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string_view>

namespace viewproj::cmd {

/// Whether the bytes begin as an .npy or an .npz does.
bool isNumpy(std::string_view bytes);

/// An array of arrays of numbers, or for an .npz an object of them. An array of something else, or of more than a
/// million numbers, is null in an .npz. Throws InputError that begins with name.
nlohmann::json readNumpy(const std::string& name, std::string_view bytes);

}  // namespace viewproj::cmd
