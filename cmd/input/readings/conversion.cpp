// A reading written again, in the same convention or another.
#include <algorithm>
#include <cmath>

#include "input/readings/readings.hpp"
#include "viewproj/matrices.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

/// What is left where the parts of an entry cancel to their own error is 0.
Mat4 withoutNoise(Mat4 m, const PoseParts& pose) noexcept {
  for (auto& row : m.m) {
    const double size = std::max({std::fabs(row[0]), std::fabs(row[1]), std::fabs(row[2])});
    const double limits[] = {size, size, size, size * maxAbs(pose.eye)};
    for (std::size_t j = 0; j < 4; ++j)
      if (std::fabs(row[j]) <= limits[j] * kCancellation) row[j] = 0;
  }
  return m;
}

}  // namespace

bool fits(const Reading& r, const Convention& c, NumberOrder order) noexcept {
  const Convention& own = r.convention;
  const bool hasLens = r.kind == MatrixKind::projection || r.kind == MatrixKind::viewProjection;
  if (hasLens && (c.ndcZ != own.ndcZ || c.ndcY != own.ndcY)) return false;
  if (r.kind != MatrixKind::viewProjection && c.view != own.view) return false;
  if (r.layout == MatrixLayout::either) return true;
  const bool paper = c.vectors == Vectors::row, memory = paper != (c.storage == Storage::columnMajor);
  const bool turned = r.layout == MatrixLayout::transposed;
  return memory == turned || (order == NumberOrder::rows && paper == turned);
}

Mat4 converted(const Reading& r, const Convention& target) {
  if (r.lens && !(r.projection->zNear() < r.projection->zFar() && (r.lens->orthographic || r.projection->zNear() > 0)))
    throw CameraError("near", "is not determined by the matrix");
  if (r.kind != MatrixKind::projection && !r.pose)
    throw CameraError("axes", "are further than 0.001 from right angles: its digits are too few for a camera");
  switch (r.kind) {
    case MatrixKind::projection:
      return clipFromView(*r.projection, target);
    case MatrixKind::view:
      return viewFromWorld(*r.pose, target);
    case MatrixKind::worldFromView:
      return worldFromView(*r.pose, target);
    case MatrixKind::viewProjection:
      break;
  }
  return withoutNoise(clipFromWorld(*r.pose, *r.projection, target), parts(*r.pose));
}

}  // namespace viewproj::cmd
