// The batch kernels: one source, compiled once per instruction set, chosen at run time, all giving the same bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

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

/// Everything is in arrays of three doubles a point: x y z in; screen x, screen y and depth out, NaN where a point has
/// none. distance: one double a point, its distance along the viewing axis, also of a point behind the eye plane; null
/// where nobody asks.
struct Kernels {
  using Project = void (*)(const ProjectionConstants&, const double* points, double* screen, double* distance,
                           std::size_t count, Unsettled) noexcept;
  const char* name;
  Project standard, exact;
  Project throughLens;  ///< exact, of cameras with a lens: of a point beyond it only screen x and y are NaN
  /// Perspective ray directions of pixels (x y pairs in, x y z out).
  void (*rays)(const ProjectionConstants&, const double* pixels, double* directions, std::size_t count,
               Unsettled) noexcept;
  /// One point in exact, through a lens too, of weight 1; or in perspective, without a lens, a direction's vanishing
  /// point without a depth.
  Projected<double, bool> (*exactPoint)(const ProjectionConstants&, const Vec4& point) noexcept;
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
