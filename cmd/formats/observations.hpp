// Points with their pixels, as reconstructions and calibrations hold them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

#include "viewproj/vectors.hpp"

namespace viewproj::cmd {

struct Observation {
  std::size_t camera;  ///< the number in the file's list of cameras
  std::int64_t point;  ///< the file's own number; of OpenCV's boards from 0 in each view
  Vec3 position;
  Vec2 pixel;
};

/// Calls take with each observation of a COLMAP model, or of OpenCV's calibration of several views. Returns a note, or
/// an empty text. Throws InputError for other files.
std::string eachObservation(const std::string& file, const std::function<void(const Observation&)>& take);

}  // namespace viewproj::cmd
