// The batch kernels: one source, compiled once per instruction set, chosen at run time, all giving the same bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "camera/camera.hpp"

namespace viewproj::detail {

/// The points of a batch that a kernel cannot settle itself, 64 to a number, the first in the lowest bit. It sets bits
/// and clears none.
using Unsettled = std::uint64_t*;

/// valid: the numbers are within the precision's bound. behind: certainly beyond the eye plane. What is neither is for
/// the exact path to decide.
template <class V, class Mask>
struct Projected {
  V x, y, depth, distance;
  Mask valid, behind;
};

/// How coordinates of points in float32 lie: an array each; x y z of one point after the other's; or x y z of vertices
/// that are four floats apart or more, of each of which a fourth float may be read.
enum class FloatShape { columns, packed, vertices };

template <class Float>
struct FloatColumns {
  Float *x, *y, *z;
  FloatShape shape;
  std::size_t strideBytes;  ///< from one x to the next

  FloatColumns from(std::size_t first) const noexcept {
    using Byte = std::conditional_t<std::is_const_v<Float>, const char, char>;
    const auto moved = [&](Float* p) {
      return reinterpret_cast<Float*>(reinterpret_cast<Byte*>(p) + first * strideBytes);
    };
    return {moved(x), moved(y), moved(z), shape, strideBytes};
  }
};

/// Of memory of one's own.
template <class Float>
FloatColumns<Float> packedColumns(Float* first) noexcept {
  return {first, first + 1, first + 2, FloatShape::packed, 3 * sizeof(float)};
}

/// Everything is in arrays of three doubles a point: x y z in; screen x, screen y and depth out, NaN where a point has
/// none. bandX, bandY: farther than this from the principal point, in pixels, a point counts as unsettled. distance:
/// one double a point, its distance along the viewing axis, also of a point behind the eye plane; null where nobody
/// asks.
struct Kernels {
  const char* name;
  unsigned features;  ///< of cpu_features.hpp: what its compiler was free to use
  void (*fast)(const ProjectionConstants&, double bandX, double bandY, const double* points, double* screen,
               double* distance, std::size_t count, Unsettled) noexcept;
  void (*standard)(const ProjectionConstants&, double bandX, double bandY, const double* points, double* screen,
                   double* distance, std::size_t count, Unsettled) noexcept;
  void (*exact)(const ProjectionConstants&, double bandX, double bandY, const double* points, double* screen,
                double* distance, std::size_t count, Unsettled) noexcept;
  /// As fast, from float32 to float32.
  void (*floats)(const ProjectionConstants&, const FloatColumns<const float>& points, const FloatColumns<float>& screen,
                 std::size_t count, Unsettled) noexcept;
  /// Perspective ray directions of pixels (x y pairs in, x y z out).
  void (*rays)(const ProjectionConstants&, const double* pixels, double* directions, std::size_t count,
               Unsettled) noexcept;
  /// One point in exact.
  Projected<double, bool> (*exactPoint)(const ProjectionConstants&, const Vec3& point) noexcept;
};

/// All that were compiled, the plainest first.
std::span<const Kernels* const> allKernels() noexcept;

/// Whether the processor, and the system for its registers, has all that the kernel may use.
bool isSupported(const Kernels& kernels) noexcept;

/// The best that is supported, unless another is forced.
const Kernels& kernels() noexcept;

/// For tests: all threads use this one, which must be supported, until told otherwise; null for the best again.
void forceKernels(const Kernels* kernels) noexcept;

}  // namespace viewproj::detail
