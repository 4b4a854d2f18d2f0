// Points drawn by OpenGL, and the framebuffer read back.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace rasterisers {

enum class DepthFormat { f32, d24, d16 };

using Matrix = std::array<float, 16>;  ///< in memory order
using Vertex = std::array<float, 3>;

/// What the API is told.
struct Draw {
  Matrix view, projection;
  bool rowVectors = false;  ///< the shader multiplies point * view * projection
  bool rowMajor = false;    ///< how the shader reads the memory
  bool zeroToOne = false;   ///< NDC z is 0..1, else -1..1
  bool mirrored = false;    ///< clip control's upper left
  int width = 0, height = 0;
  int viewportWidth = 0, viewportHeight = 0;
  double x = 0, y = 0;  ///< the viewport's first column, and first row as they lie in memory
  double depthRange[2] = {0, 1};
  DepthFormat format = DepthFormat::f32;
  std::vector<Vertex> points;
};

/// Row after row, as they lie in memory.
struct Picture {
  std::vector<std::uint32_t> ids;  ///< 0: nothing, else the point's index + 1
  std::vector<double> depths;
};

/// The driver in words.
std::string driver();
/// Why nothing can be drawn here, or an empty string.
std::string unavailable();
Picture render(const Draw& draw);

}  // namespace rasterisers
