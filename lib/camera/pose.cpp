#include "camera/pose.hpp"

#include <array>
#include <string>

#include "camera/exact_vectors.hpp"
#include "camera/pose_source.hpp"

namespace viewproj::detail {
namespace {

/// Scaled to unit magnitude.
FineVec3 fineUp(const Vec3& up) {
  const DDVec3 wide = toDoubleDouble(up);
  return {exactly(rounded(scaleByPowerOfTwo(wide, exponentToUnit(wide)))), 0};
}

/// Rows more uncertain than this would not be within 2^-100.
constexpr double kLargestRowError = 0x1p-102;

/// Without an error, and of components that are doubles.
bool isOfDoubles(const FineVec3& v) {
  return v.error == 0 && v.terms[0].size() <= 1 && v.terms[1].size() <= 1 && v.terms[2].size() <= 1;
}

/// up as it was given, or as FineVec3; and what the direction is the difference of.
struct Looking {
  Vec3 position;
  DDVec3 direction;
  Vec3 from, to;
  FineVec3 fineUp;
  Vec3 up;
  bool isNarrow;
};

Pose lookAlongExactly(const Looking& l, Handedness world, const char* directionField) {
  if (maxAbs(l.direction) == 0)
    throw CameraError(directionField, std::string(directionField) == "target"
                                          ? "is the camera's own position: there is no direction to look in"
                                          : "is zero");
  const FineVec3& up = l.fineUp;
  const DDVec3 g = scaleByPowerOfTwo(l.direction, exponentToUnit(l.direction));
  const ExactVec3 side = exactCross(g, up.terms);
  ExactVec3 along;
  for (std::size_t i = 0; i < 3; ++i) along[i] = {g[i].lo, g[i].hi};
  // Where up has an error, what underflows is far below it.
  const bool isNarrow = !isOfDoubles(up) || (l.isNarrow && isAbove(l.direction, kSmallestFactor) &&
                                             isAbove(side, kSmallestTerm) && isAbove(along, kSmallestTerm));
  const double handed = world == Handedness::right ? 1 : -1;
  const PoseSource source{PoseSource::Kind::look, {l.from, l.to, l.up}, handed < 0, {}, {}};
  DDVec3 roundedSide = rounded(side);
  DDVec3 roundedAlong = g;
  if (!isNarrow) {
    const ExactSource rows = exactSource(source);
    const auto unitScaled = [](const Vector3<Dyadic>& row) {
      const WideVec3 wide{row[0].rounded(), row[1].rounded(), row[2].rounded()};
      const Wide length = lengthOf(wide);
      const Wide scale = length.sign() == 0 ? Wide(0) : Wide(1) / length;
      return DDVec3{toDoubleDouble(wide.x * scale), toDoubleDouble(wide.y * scale), toDoubleDouble(wide.z * scale)};
    };
    roundedSide = unitScaled(rows.right);
    roundedAlong = unitScaled(rows.forward);
  }
  // Each product of a component of g with one of up carries 2 up.error; of up's row there are two.
  const double sideError = 16 * up.error;
  if (!(maxAbs(roundedSide) * kLargestRowError >= sideError && maxAbs(roundedSide) > 0))
    throw CameraError("up", "is parallel to the viewing direction, so it does not say which way is up; give another");

  const DoubleDouble sideScale = inverseLength(roundedSide);
  const DoubleDouble forwardScale = inverseLength(roundedAlong);
  const DDVec3 right = roundedSide * sideScale;
  const DDVec3 forward = roundedAlong * forwardScale;
  const Axes axes{right * DoubleDouble(handed), cross(right, forward), forward};
  ExactRows exact{side,
                  along,
                  {},
                  true,
                  sideScale * DoubleDouble(handed),
                  sideScale * forwardScale,
                  forwardScale,
                  l.position,
                  {},
                  sideError * sideScale.hi,
                  isNarrow,
                  source};
  return made({l.position, axes, axes, {}, exact});
}

/// up is checked last, as the fields are named.
Looking withUp(Looking l, const Vec3& up) {
  requireFinite(up, "up");
  if (maxAbs(up) == 0) throw CameraError("up", "is zero");
  l.up = up;
  l.fineUp = fineUp(up);
  l.isNarrow = l.isNarrow && isAbove(toDoubleDouble(up), kSmallestFactor);
  return l;
}

Looking withUp(Looking l, const FineVec3& up) {
  requireFinite(up, "up");
  l.up = detail::rounded(rounded(up.terms));
  l.fineUp = up;
  return l;
}

template <class Up>
Looking lookingAlong(const Vec3& position, const Vec3& direction, const Up& up) {
  requireFinite(position, "position");
  requireFinite(direction, "direction");
  return withUp({position, toDoubleDouble(direction), {}, direction, {}, {}, true}, up);
}

template <class Up>
Looking lookingAt(const Vec3& position, const Vec3& target, const Up& up) {
  requireFinite(position, "position");
  requireFinite(target, "target");
  // Quartered where the difference could overflow; only its direction counts.
  const bool isHuge = std::max(maxAbs(position), maxAbs(target)) > 0x1p1000;
  const double quarter = isHuge ? 0.25 : 1;
  Looking l{position, {}, position, target, {}, {}, true};
  for (std::size_t i = 0; i < 3; ++i) {
    l.direction[i] = twoDiff(target[i] * quarter, position[i] * quarter);
    if (isHuge) l.isNarrow = l.isNarrow && isAbove(target[i], 0x1p-900) && isAbove(position[i], 0x1p-900);
  }
  return withUp(l, up);
}

}  // namespace

Pose made(const PoseParts& parts) { return Access::whole<Pose, PoseParts>(std::make_shared<const PoseParts>(parts)); }

Pose lookAlong(const Vec3& position, const Vec3& direction, const FineVec3& up, Handedness world) {
  return lookAlongExactly(lookingAlong(position, direction, up), world, "direction");
}

Pose lookAt(const Vec3& position, const Vec3& target, const FineVec3& up, Handedness world) {
  return lookAlongExactly(lookingAt(position, target, up), world, "target");
}

Pose poseFromAxes(const Vec3& position, const FineVec3& right, const FineVec3& up, const FineVec3& forward) {
  requireFinite(position, "position");
  const Axes axes{rounded(right.terms), rounded(up.terms), rounded(forward.terms)};
  ExactRows exact;
  exact.right = right.terms;
  exact.up = up.terms;
  exact.forward = forward.terms;
  exact.origin = position;
  exact.error = std::max({right.error, up.error, forward.error});
  return made({position, axes, axes, {}, exact});
}

DDVec3 unroundedEye(const PoseParts& p) noexcept {
  return toDoubleDouble(p.eye) +
         -(p.columns.right * p.residual.x + p.columns.up * p.residual.y + p.columns.forward * p.residual.z);
}

}  // namespace viewproj::detail

namespace viewproj {

using namespace detail;

Vec3 Pose::eye() const noexcept { return parts_->eye; }
Vec3 Pose::right() const noexcept { return detail::rounded(parts_->rows.right); }
Vec3 Pose::up() const noexcept { return detail::rounded(parts_->rows.up); }
Vec3 Pose::forward() const noexcept { return detail::rounded(parts_->rows.forward); }
Handedness Pose::world() const noexcept {
  const Axes& rows = parts_->rows;
  return dot(cross(rows.right, rows.up), rows.forward).hi < 0 ? Handedness::right : Handedness::left;
}

Pose lookAlong(const Vec3& position, const Vec3& direction, const Vec3& up, Handedness world) {
  return lookAlongExactly(lookingAlong(position, direction, up), world, "direction");
}

Pose lookAt(const Vec3& position, const Vec3& target, const Vec3& up, Handedness world) {
  return lookAlongExactly(lookingAt(position, target, up), world, "target");
}

}  // namespace viewproj
