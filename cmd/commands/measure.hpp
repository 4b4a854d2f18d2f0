// viewproj measure: time and error of each way to project points, on one scene.
#pragma once

#include <cstddef>
#include <span>

#include "output/report.hpp"
#include "viewproj/camera.hpp"

namespace viewproj::cmd {

/// The library's exact and standard arithmetic beside the textbook's: one view-projection matrix in double and in
/// float32. Errors count on the points in the picture, against exact. The camera has a near plane, and there are
/// points. leftOut: how many records were none.
OrderedJson measureReport(const Camera& camera, std::span<const Vec3> points, std::size_t leftOut = 0);

}  // namespace viewproj::cmd
