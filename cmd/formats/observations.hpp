// Points with their pixels, as reconstructions and calibrations hold them.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "viewproj/vectors.hpp"

namespace viewproj::cmd {

struct Observation {
  std::size_t camera;  ///< the number in the file's list of cameras
  Vec3 position;
  Vec2 pixel;
};

/// Calls take with each observation of a COLMAP model, or of OpenCV's calibration of several views. Returns a note, or
/// an empty text. Throws InputError for other files.
std::string eachObservation(const std::string& file, const std::function<void(const Observation&)>& take);

}  // namespace viewproj::cmd
