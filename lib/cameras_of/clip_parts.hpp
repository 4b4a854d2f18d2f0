// The parts of a clip matrix: what it does along the axes of the camera.
#pragma once

#include <array>
#include <optional>

#include "camera/depth.hpp"
#include "numbers/double_double.hpp"
#include "numbers/dyadic.hpp"
#include "viewproj/vectors.hpp"

namespace viewproj::detail {

struct Row {
  Vector3<Dyadic<1>> axis;
  Dyadic<1> last;
};
using Rows = std::array<Row, 4>;
Rows rowsOf(const Mat4& m) noexcept;

DDVec3 quotient(const WideVec3& a, const Wide& by) noexcept;

/// A clip matrix as parts. X, Y, W are a point's distances along the axes right, ndcUp, forward from the eye (in
/// orthographic from the origin). Then clip is scale times
///   (x.scale X + x.offset W, y.scale Y + y.offset W, depth.offset W + depth.scale, W)   in perspective
///   (x.scale X + x.offset,   y.scale Y + y.offset,   depth.offset + depth.scale W, 1)   in orthographic
/// The scales of x and y are positive, and in orthographic the scale of depth too.
struct ClipParts {
  bool orthographic;
  DoubleDouble scale;
  std::array<DepthLine, 3> lines;  ///< x, y, depth
  std::array<DDVec3, 3> axes;
  double residual;           ///< the largest cosine between x and y, in orthographic also with z
  double depthResidual = 0;  ///< in perspective: the part of the z row that is not along the w row
};

/// Returns nothing if x or y is constant across the picture.
std::optional<ClipParts> perspectiveParts(const Rows& m) noexcept;
std::optional<ClipParts> orthographicParts(const Rows& m) noexcept;

}  // namespace viewproj::detail
