// COLMAP's reconstructions as text and binary.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "camera/camera_set.hpp"
#include "viewproj/vectors.hpp"

namespace viewproj::cmd {

struct ColmapModel {
  std::string_view name;
  std::size_t focalLengths, coefficients;  ///< cx and cy stand between them
  std::string_view lens;                   ///< see setLens(); "-": not supported
};
/// In the order of their numbers in binary files. The coefficients are in the order of the lens.
inline constexpr ColmapModel kColmapModels[] = {{"SIMPLE_PINHOLE", 1, 0, ""},
                                                {"PINHOLE", 2, 0, ""},
                                                {"SIMPLE_RADIAL", 1, 1, "radial"},
                                                {"RADIAL", 1, 2, "radial"},
                                                {"OPENCV", 2, 4, "opencv"},
                                                {"OPENCV_FISHEYE", 2, 4, "fisheye"},
                                                {"FULL_OPENCV", 2, 8, "opencv"},
                                                {"FOV", 2, 1, "fov"},
                                                {"SIMPLE_RADIAL_FISHEYE", 1, 1, "fisheye"},
                                                {"RADIAL_FISHEYE", 1, 2, "fisheye"},
                                                {"THIN_PRISM_FISHEYE", 2, 8, "-"},
                                                {"RAD_TAN_THIN_PRISM_FISHEYE", 2, 12, "-"},
                                                {"SIMPLE_DIVISION", 1, 1, "-"},
                                                {"DIVISION", 2, 1, "-"},
                                                {"SIMPLE_FISHEYE", 1, 0, "fisheye"},
                                                {"FISHEYE", 2, 0, "fisheye"},
                                                {"EUCM", 2, 2, "eucm"},
                                                {"EQUIRECTANGULAR", 0, 0, "-"}};

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
