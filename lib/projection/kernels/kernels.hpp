// The kernels, of batches and of single points: one source of each, compiled once per instruction set and chosen at run
// time. All give the same bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "camera/camera.hpp"
#include "lens/lens.hpp"

namespace viewproj::detail {

/// The points of a batch that a kernel cannot settle itself: 64 per number, the first in the lowest bit. A kernel only
/// sets bits.
using Unsettled = std::uint64_t*;

/// valid: the numbers are within the precision's bound. behind: certainly beyond the eye plane. If neither, the exact
/// path decides.
template <class V, class Mask>
struct Projected {
  V x, y, depth, distance;
  Mask valid, behind;
};

/// The direction of a pixel through a lens, as LensInverse gives it. If it is not settled, undistortSlowly decides.
struct LensSight {
  Sight<DoubleDouble> at;
  bool isSettled, hasNone;
};

struct PointKernels {
  /// Projects one point in exact: of weight 1, through a lens too; or in perspective without a lens, a direction's
  /// vanishing point, without a depth.
  Projected<double, bool> (*exactPoint)(const ProjectionConstants&, const Vec4& point) noexcept;
  LensSight (*lensSight)(const ProjectionConstants&, const Vec2& pixel) noexcept;
};

/// Arrays have three doubles per point: x y z in; screen x, screen y and depth out, NaN if a point has none. distance
/// has one double per point, its distance along the viewing axis, also behind the eye plane. It may be null.
struct Kernels {
  using Project = void (*)(const ProjectionConstants&, const double* points, double* screen, double* distance,
                           std::size_t count, Unsettled) noexcept;
  const char* name;
  Project standard, exact;
  /// exact, of cameras with a lens: of a point in front that it does not see only screen x and y are NaN, of a point
  /// that it sees behind the eye plane only the depth
  Project throughLens;
  /// Perspective ray directions of pixels (x y pairs in, x y z out).
  void (*rays)(const ProjectionConstants&, const double* pixels, double* directions, std::size_t count,
               Unsettled) noexcept;
  /// The same through a lens; NaN if a pixel has none. Every component is the same in all kernels.
  void (*raysThroughLens)(const ProjectionConstants&, const double* pixels, double* directions, std::size_t count,
                          Unsettled) noexcept;
  const PointKernels& points;
};

/// All compiled kernels, from the slowest to the fastest.
std::span<const Kernels* const> allKernels() noexcept;

/// Whether the processor, and the system for its registers, supports all that the kernel may use.
bool isSupported(const Kernels& kernels) noexcept;

/// The fastest supported kernels, unless others are forced.
const Kernels& kernels() noexcept;

const PointKernels& pointKernels() noexcept;

/// Whether the processor has AVX2 and FMA.
bool supportsV3() noexcept;

/// For tests: all threads use these kernels and their points, which must be supported, until the next call. null
/// restores the fastest.
void forceKernels(const Kernels* kernels) noexcept;
void forcePointKernels(const PointKernels* kernels) noexcept;

}  // namespace viewproj::detail
