// How far float32 may take a point off on its way through a graphics pipeline.
#pragma once

#include <array>

#include "rasteriser.hpp"

namespace rasterisers {

/// Unit roundoff of float32.
constexpr double kUnit = 0x1p-24;

/// A matrix for column vectors, whatever the memory held.
using Mat = std::array<std::array<double, 4>, 4>;
Mat fromMemory(const Matrix& memory, bool rowVectors, bool rowMajor);

struct Pipeline {
  Mat view, projection;
  bool product = false;        ///< view is the identity, which rounds nothing
  bool pointsRounded = false;  ///< the points were rounded to float32
  bool zeroToOne = false;
  double x = 0, y = 0, width = 0, height = 0;  ///< of the viewport
  double depthRange[2] = {0, 1};
};

/// Bounds of the errors: of window x and y in pixels, of window depth before it is stored, of clip w.
struct Rounding {
  double x = 0, y = 0, depth = 0, w = 0;
};

/// Of a point with w > 0; only w counts where it is not.
Rounding roundingOf(const std::array<double, 3>& point, const Pipeline& pipeline);

/// What storing may add: one step. OpenGL 4.5, 2.3.5 and Vulkan 1.3, "Conversion from Floating-Point to Normalized
/// Fixed-Point": one of the two nearest numbers.
double storageStep(DepthFormat format);

}  // namespace rasterisers
