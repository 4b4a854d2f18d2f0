// What a projection does to coordinates along the camera's axes. Internal.
#pragma once

#include "camera/depth.hpp"
#include "viewproj/convention.hpp"

namespace viewproj::detail {

/// Two affine maps that a projection is made of: of the window's coordinates and of depth. In perspective
///   out.x = (scaleX X + offsetX W) / W,  out.y = (scaleY Y + offsetY W) / W,  out.z = (depth.offset W + depth.scale) /
///   W
/// and in orthographic
///   out.x = scaleX X + offsetX,          out.y = scaleY Y + offsetY,          out.z = depth.offset + depth.scale W
/// where out is NDC or the screen. The inverse map of x is X = (out.x - offsetX) / scaleX, and so on.
struct Lens {
  bool orthographic;
  DoubleDouble scaleX, offsetX, scaleY, offsetY;
  DoubleDouble inverseScaleX, inverseOffsetX, inverseScaleY, inverseOffsetY;
  DepthLine depth;
  DoubleDouble inverseDepthOffset, inverseDepthScale;  // 1/W or W = inverseDepthOffset + inverseDepthScale out.z
};

/// The first four of them, to normalised device coordinates of the convention.
struct NdcWindow {
  DoubleDouble scaleX, offsetX, scaleY, offsetY;
};
NdcWindow ndcWindow(const ProjectionParts& projection, const Convention& convention) noexcept;

/// Throws CameraError naming "near" where there is no depth.
void requireDepth(const ProjectionParts& projection);

/// All of them. Throws as requireDepth.
Lens ndcLens(const ProjectionParts& projection, const Convention& convention);

}  // namespace viewproj::detail
