#include "camera/read_screen.hpp"

#include <cmath>
#include <numbers>

#include "numbers/vectors.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

/// Cosine of the angle between the sides: more is no rectangle.
constexpr double kLargestSkew = 1e-3;
/// An eye nearer to the screen's plane, in distances to its corner, is in it.
constexpr double kSmallestDistance = 1e-12;

DDVec3 difference(const Vec3& a, const Vec3& b) { return {twoDiff(a.x, b.x), twoDiff(a.y, b.y), twoDiff(a.z, b.z)}; }

}  // namespace

ScreenView readScreen(const FieldValues& values, Handedness world) {
  const Vec3 eye = values.require<Position>("position").point;
  const Vec3 corner = values.require<Position>("projection.bottomLeft").point;
  const DDVec3 across = difference(values.require<Position>("projection.bottomRight").point, corner);
  const DDVec3 along = difference(values.require<Position>("projection.topLeft").point, corner);
  const DDVec3 toCorner = difference(corner, eye);
  if (!(maxAbs(across) > 0)) values.fail("projection.bottomRight", "is the same point as bottomLeft");
  if (!(maxAbs(along) > 0)) values.fail("projection.topLeft", "is the same point as bottomLeft");
  const DDVec3 right = normalized(across);
  const double cosine = dot(right, normalized(along)).hi;
  if (!(std::fabs(cosine) <= kLargestSkew))
    values.failAt("projection", "is no rectangle: its sides meet at " +
                                    formatDigits(std::acos(cosine) * 180 / std::numbers::pi, 6) +
                                    " degrees in bottomLeft, expected 90");
  // right x up points to the eye in a right-handed world, and to the screen in a left-handed one.
  const bool isRight = world == Handedness::right;
  const DDVec3 normal = normalized(cross(right, along));
  const DDVec3 forward = isRight ? -normal : normal;
  const DDVec3 up = isRight ? cross(right, forward) : cross(forward, right);
  const DoubleDouble distance = dot(toCorner, forward);
  const double reach = std::sqrt(dot(toCorner, toCorner).hi);
  if (!(std::fabs(distance.hi) > kSmallestDistance * reach)) values.fail("position", "lies in the plane of the screen");
  if (distance.hi < 0) values.fail("position", "is behind the screen, whose back it sees");
  const DoubleDouble left = dot(toCorner, right) / distance, bottom = dot(toCorner, up) / distance;
  const DoubleDouble end = left + dot(across, right) / distance, top = bottom + dot(along, up) / distance;
  return {poseFromColumns({split(right), split(up), split(forward)}, SplitVec3{eye, {}}, CameraAxes::RUF), left.hi,
          end.hi, bottom.hi, top.hi};
}

}  // namespace viewproj::cmd
