#include "camera/pose.hpp"

#include <limits>
#include <string>

#include "camera/require.hpp"

namespace viewproj::detail {
namespace {

using Row = ExactPose::Row;

DDVec3 roundedRow(const Row& row, const Wide& scale) noexcept {
  const WideVec3 v = rounded(row) * scale;
  return {toDoubleDouble(v.x), toDoubleDouble(v.y), toDoubleDouble(v.z)};
}

/// direction is not zero, up is finite.
Pose looking(const Vec3& position, const Vector3<Dyadic<1>>& direction, const FineVec3& up, Handedness world) {
  const Vector3<Dyadic<2>> side = crossOf(direction, up);
  if (side.x.sign() == 0 && side.y.sign() == 0 && side.z.sign() == 0)
    throw CameraError("up", "is parallel to the viewing direction, so it does not say which way is up; give another");
  const Wide perSide = Wide(1) / lengthOf(rounded(side)), perDirection = Wide(1) / lengthOf(rounded(direction));
  ExactPose exact;
  setUnitRow(exact, 0, {side.x, side.y, side.z}, world == Handedness::left ? -perSide : perSide);
  setUnitRow(exact, 1, crossOf(side, direction), perSide * perDirection);
  setUnitRow(exact, 2, {direction.x, direction.y, direction.z}, perDirection);
  exact.origin = position;
  return orthogonal(exact);
}

void requireFine(const FineVec3& up) {
  if (!isFinite(rounded(rounded(up)))) throw CameraError("up", "has a component that is not a finite number");
}

FineVec3 checkedUp(const Vec3& up) {
  const Vec3 checked = checkedEntries(up, "up");
  if (maxAbs(checked) == 0) throw CameraError("up", "is zero");
  return toDyadic(checked);
}

}  // namespace

Pose made(const PoseParts& parts) { return Access::whole<Pose>(share(parts)); }

Pose orthogonal(const ExactPose& exact) {
  const Axes rows = roundedRows(exact);
  return made({exact.origin, rows, rows, {}, share(exact)});
}

Axes roundedRows(const ExactPose& exact) noexcept {
  return {roundedRow(exact.rows[0], exact.scale[0]), roundedRow(exact.rows[1], exact.scale[1]),
          roundedRow(exact.rows[2], exact.scale[2])};
}

std::size_t onlyEntry(const Row& row) noexcept {
  std::size_t found = 3;
  for (std::size_t i = 0; i < 3; ++i) {
    if (row[i].sign() == 0) continue;
    if (found < 3) return 3;
    found = i;
  }
  return found;
}

void setUnitRow(ExactPose& exact, std::size_t index, Row row, Wide scale) {
  const std::size_t only = onlyEntry(row);
  exact.rows[index] = row;
  exact.scale[index] = only < 3 ? Wide(1) : scale;
  if (only < 3) exact.rows[index][only] = row[only].sign() * scale.sign();
}

bool forwardIsAxis(const PoseParts& pose) noexcept {
  const ExactPose& exact = *pose.exact;
  const Row& forward = exact.rows[2];
  const std::size_t only = onlyEntry(forward);
  const DDVec3& residual = pose.residual;
  return only < 3 && (exact.scale[2] - Wide(1)).value.hi == 0 &&
         (forward[only] - Dyadic<1>(forward[only].sign())).sign() == 0 && residual.x.hi == 0 && residual.y.hi == 0 &&
         residual.z.hi == 0;
}

Pose lookAlongWithUp(const Vec3& position, const Vec3& direction, const FineVec3& up, Handedness world) {
  const Vec3 eye = checkedEntries(position, "position"), along = checkedEntries(direction, "direction");
  if (maxAbs(along) == 0) throw CameraError("direction", "is zero");
  requireFine(up);
  return looking(eye, toDyadic(along), up, world);
}

Pose lookAtWithUp(const Vec3& position, const Vec3& target, const FineVec3& up, Handedness world) {
  const Vec3 eye = checkedEntries(position, "position"), at = checkedEntries(target, "target");
  requireFine(up);
  if (eye == at) throw CameraError("target", "is the camera's own position: there is no direction to look in");
  Vector3<Dyadic<1>> direction;
  for (std::size_t i = 0; i < 3; ++i) direction[i] = Dyadic<1>::difference(at[i], eye[i]);
  return looking(eye, direction, up, world);
}

Pose poseFromAxes(const Vec3& position, const std::array<FineVec3, 3>& axes) {
  ExactPose exact;
  for (std::size_t i = 0; i < 3; ++i) exact.rows[i] = {axes[i].x, axes[i].y, axes[i].z};
  exact.origin = checkedEntries(position, "position");
  return orthogonal(exact);
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

PoseError Pose::error() const noexcept { return parts_->error; }

Pose movedTo(const Pose& pose, const Vec3& eye) {
  PoseParts moved = parts(pose);
  ExactPose exact = *moved.exact;
  moved.eye = exact.origin = checkedEntries(eye, "position");
  exact.translation = {};
  moved.residual = {};
  moved.error.eye = 0;
  moved.exact = share(exact);
  return made(moved);
}

Pose withError(const Pose& pose, const PoseError& error) {
  const auto positive = [](double a) { return a >= 0 ? a : std::numeric_limits<double>::infinity(); };
  PoseParts result = parts(pose);
  result.error = {positive(error.eye), positive(error.angle)};
  return made(result);
}

Pose lookAlong(const Vec3& position, const Vec3& direction, const Vec3& up, Handedness world) {
  return lookAlongWithUp(position, direction, checkedUp(up), world);
}

Pose lookAt(const Vec3& position, const Vec3& target, const Vec3& up, Handedness world) {
  return lookAtWithUp(position, target, checkedUp(up), world);
}

}  // namespace viewproj
