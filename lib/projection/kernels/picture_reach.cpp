#include "projection/kernels/picture_reach.hpp"

#include <cmath>

#include "projection/kernels/error_model.hpp"

namespace viewproj::detail {

PictureReach pictureReach(const CameraParts& c, double band) noexcept {
  const Viewport& v = c.viewport;
  const double half = v.pixelCenter - 0.5;
  const auto reach = [&](double start, double size, double center) {
    const double middle = start + half + size / 2;
    // The middle and the centre may cancel.
    const double rounding = 0x1p-50 * (std::fabs(start) + std::fabs(half) + size + std::fabs(center));
    return std::fabs(middle - center) + band * size / 2 + rounding;
  };
  return {reach(v.x, v.width, c.constants.centerX.hi) * kSecondOrder,
          reach(v.y, v.height, c.constants.centerY.hi) * kSecondOrder};
}

}  // namespace viewproj::detail
