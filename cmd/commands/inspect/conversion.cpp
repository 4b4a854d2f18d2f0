#include "commands/inspect/conversion.hpp"

#include <algorithm>
#include <cmath>

#include "numbers/vectors.hpp"
#include "viewproj/matrices.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

/// What is left where the parts of an entry cancel to their own error is 0.
Mat4 withoutNoise(Mat4 m, const Vec3& eye) noexcept {
  for (auto& row : m.m) {
    const double size = std::max({std::fabs(row[0]), std::fabs(row[1]), std::fabs(row[2])});
    const double limits[] = {size, size, size, size * maxAbs(eye)};
    for (std::size_t j = 0; j < 4; ++j)
      if (std::fabs(row[j]) <= limits[j] * kCancellation) row[j] = 0;
  }
  return m;
}

}  // namespace

bool fits(const MatrixCamera& r, const Convention& c, NumberOrder order) noexcept {
  const Convention& own = r.convention;
  if (r.lens && (c.ndcZ != own.ndcZ || c.ndcY != own.ndcY)) return false;
  if (r.kind != MatrixKind::viewProjection && c.view != own.view) return false;
  if (r.layout == MatrixLayout::either) return true;
  const bool paper = c.vectors == Vectors::row, memory = paper != (c.storage == Storage::columnMajor);
  const bool turned = r.layout == MatrixLayout::transposed;
  return memory == turned || (order == NumberOrder::rows && paper == turned);
}

Mat4 converted(const MatrixCamera& r, const Convention& target) {
  if (r.lens && !r.lens->projection) throw CameraError("near", "is not determined by the matrix");
  switch (r.kind) {
    case MatrixKind::projection:
      return clipFromView(*r.lens->projection, target);
    case MatrixKind::view:
      return viewFromWorld(*r.pose, target);
    case MatrixKind::worldFromView:
      return worldFromView(*r.pose, target);
    case MatrixKind::viewProjection:
      break;
  }
  return withoutNoise(clipFromWorld(*r.pose, *r.lens->projection, target), r.pose->eye());
}

}  // namespace viewproj::cmd
