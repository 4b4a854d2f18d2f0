#include <string>

#include "camera/error.hpp"
#include "camera/pose.hpp"
#include "camera/pose_source.hpp"

namespace viewproj {
namespace {

/// The rows of a matrix that poses are made of are within kPoseOrthogonality of a rotation's, and those of its inverse,
/// whose lengths and angles add up, within this.
constexpr double kRowOrthogonality = 4 * kPoseOrthogonality;
/// Parts that were made together agree to 2^-98 and better, those of which one was changed do not.
constexpr double kSame = 0x1p-90;
/// What a residual next to the smallest double has lost.
constexpr double kSubnormal = 0x1p-1060;

using Rows = std::array<DDVec3, 3>;

Rows rowsOf(const Axes& a) noexcept { return {a.right, a.up, a.forward}; }

bool isFinite(const DDVec3& v) noexcept {
  return viewproj::isFinite(v.x) && viewproj::isFinite(v.y) && viewproj::isFinite(v.z);
}

/// a[i] . b[j] is 1 for i == j and else 0, as nearly as that. NaN is not.
bool areInverse(const Rows& a, const Rows& b, double within) noexcept {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      if (!(std::fabs((dot(a[i], b[j]) - DoubleDouble(i == j ? 1 : 0)).hi) <= within)) return false;
  return true;
}

/// The exact rows are those of the pose, and at the eye they give its residual.
bool areOfOnePose(const Pose& p) noexcept {
  const ExactRows& e = p.exact;
  const ExactVec3* const exact[] = {&e.right, &e.up, &e.forward};
  const DoubleDouble scales[] = {e.rightScale, e.upScale, e.forwardScale};
  const Rows rows = rowsOf(p.rows);
  if (!isFinite(e.origin) || !(e.error >= 0 && std::isfinite(e.error))) return false;
  // Brought down where a difference or a product of the largest doubles would overflow.
  double largest = std::max(maxAbs(p.eye), maxAbs(e.origin));
  for (const Expansion<8>& part : e.translation) largest = std::max(largest, std::fabs(part.rounded().hi));
  const double scale = largest > 0x1p900 ? 0x1p-200 : 1;
  DDVec3 way;
  for (std::size_t i = 0; i < 3; ++i) way[i] = twoDiff(p.eye[i] * scale, e.origin[i] * scale);
  // Where the exact rows have lost terms, what they were made of has them.
  const bool hasSource = !e.isNarrow && e.source.kind != PoseSource::Kind::rows;
  const ExactSource source = hasSource ? exactSource(e.source) : ExactSource{};
  const std::array<Dyadic, 3>* const sourceRows[] = {&source.right, &source.up, &source.forward};
  const Wide sourceScales[] = {source.rightScale, source.upScale, source.forwardScale};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      if (i == 1 && e.upIsCross && !hasSource) continue;
      const DoubleDouble entry = hasSource ? toDoubleDouble((*sourceRows[i])[j].rounded() * sourceScales[i])
                                           : (*exact[i])[j].rounded() * scales[i];
      if (!(std::fabs((entry - rows[i][j]).hi) <= kSame)) return false;
    }
    const DoubleDouble translation = timesPowerOfTwo(e.translation[i].rounded(), scale) * scales[i];
    const DoubleDouble off = dot(rows[i], way) + translation - timesPowerOfTwo(p.residual[i], scale);
    if (!(std::fabs(off.hi) <= kSame * (maxAbs(way) + std::fabs(translation.hi)) + kSubnormal)) return false;
  }
  return true;
}

const char* nameOf(Handedness world) noexcept { return world == Handedness::right ? "right" : "left"; }

}  // namespace

void validate(const Pose& p, Handedness world) {
  const auto require = [](bool good, const std::string& message) {
    if (!good) throw CameraError("pose", message);
  };
  const Rows rows = rowsOf(p.rows), columns = rowsOf(p.columns);
  require(viewproj::isFinite(p.eye) && isFinite(p.residual), "has a number that is not finite");
  for (const Rows& axes : {rows, columns})
    for (const DDVec3& axis : axes) {
      require(isFinite(axis), "has a number that is not finite");
      require(maxAbs(axis) > 0, "has an axis that is zero; lookAt and its neighbours make one that has none");
    }
  require(areInverse(rows, rows, kRowOrthogonality), "has axes that are not of unit length and at right angles");
  require(areInverse(rows, columns, kSame) && areOfOnePose(p),
          "has parts that are not of one pose; make another instead of changing one");
  const Handedness own =
      dot(cross(p.rows.right, p.rows.up), p.rows.forward).hi < 0 ? Handedness::right : Handedness::left;
  require(own == world, std::string("is of a ") + nameOf(own) + "-handed world, and the convention's is " +
                            nameOf(world) + "-handed");
}

}  // namespace viewproj
