// COLMAP's reconstructions as text and binary.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "camera/camera_set.hpp"
#include "viewproj/vectors.hpp"

namespace viewproj::cmd {

/// A folder of a reconstruction, or one of its files; the folder with the model: the folder itself, sparse/0 or 0 in
/// it. Nothing if it is none.
std::optional<std::string> colmapModel(const std::string& source);

/// {"cameras": {"1": {...}}, "images": [...]} of what colmapModel() found. Throws InputError.
Json readColmap(const std::string& model);
Import openColmap(const Node& root);

/// Calls take with each pixel of an image that has a point in space: the number of the image in the list of
/// readColmap(), the point's number, the point and the pixel. Throws InputError.
void eachColmapPixel(
    const std::string& source,
    const std::function<void(std::size_t image, std::int64_t number, const Vec3& point, const Vec2& pixel)>& take);

}  // namespace viewproj::cmd
