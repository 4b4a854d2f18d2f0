// What a depth buffer resolves: window depth over distance, and how far apart surfaces must be to be stored apart.
//
// A mapping is that of a projection and a viewport that validate takes, a format one of those below; of others, of a
// distance that is not finite and of a gap that is not above 0 the results mean nothing. Distances are world units
// along the viewing axis; depths are window depths. What the closed forms below say is true of the exact window depth
// rounded to the nearest stored one. The rounding of a matrix, a shader or a rasteriser in float32 comes on top and is
// not modelled. Relative error of every result: at most kDepthBufferError.
//
// With s the step of stored depths and K = |atFar - atNear| n f / (f - n) (perspective; n for infinite far), two
// surfaces at v < w differ in depth by K (1/v - 1/w), in orthographic by |atFar - atNear| (w - v) / (f - n). They are
// stored apart for certain, wherever the steps lie, from a difference of s on.
#pragma once

#include <cstdint>

#include "camera/projection.hpp"
#include "camera/require.hpp"

namespace viewproj::cmd {

inline constexpr double kDepthBufferError = 1e-14;

/// How a projection maps distance to window depth.
struct DepthMapping {
  bool orthographic = false;
  double near = 0, far = 0;      ///< as in Projection
  double atNear = 0, atFar = 1;  ///< window depths, not negative
};

/// depthFirst and depthSecond as in Viewport; reverseZ exchanges them.
DepthMapping depthMapping(const detail::ProjectionParts& projection, double depthFirst, double depthSecond,
                          bool reverseZ) noexcept;

/// How depths are stored.
struct DepthFormat {
  double step = 0;     ///< distance of neighbouring stored depths; 0: float32, whose steps depend on the depth
  double largest = 1;  ///< the largest stored depth
};

/// 2^bits - 1, which is a double for 1 to 53 bits; throws CameraError naming "bits" for any other number of them.
constexpr double largestInteger(int bits) {
  if (bits < 1 || bits > 53) throw CameraError("bits", "must be from 1 to 53");
  return static_cast<double>((std::uint64_t{1} << bits) - 1);
}

/// Shares of 1: D16_UNORM, D24_UNORM. bits from 1 to 53, or it throws CameraError.
constexpr DepthFormat unormDepth(int bits) { return {1 / largestInteger(bits), 1}; }
/// Whole numbers from 0 on, as consoles store window depths that go beyond 1. bits as for unormDepth.
constexpr DepthFormat integerDepth(int bits) { return {1, largestInteger(bits)}; }
inline constexpr DepthFormat kFloatDepth{0, 0x1.fffffep127};

/// Window depth at a distance, not clamped, and its change per unit of distance. In perspective for distances above 0.
double depthAtDistance(const DepthMapping& mapping, double distance) noexcept;
double depthSlope(const DepthMapping& mapping, double distance) noexcept;

/// The way back; infinite at the depth of infinity, NaN at one that no point in front of the eye has.
double distanceAtDepth(const DepthMapping& mapping, double depth) noexcept;

/// The step by which stored depths differ next to the depth of a surface at this distance, towards the eye.
double depthStep(const DepthMapping& mapping, const DepthFormat& format, double distance) noexcept;

/// How much nearer than a surface at this distance another must be, to be stored apart for certain: one step, as a
/// length. Finite at every distance.
double resolvedGap(const DepthMapping& mapping, const DepthFormat& format, double distance) noexcept;

}  // namespace viewproj::cmd
