#include "camera/turned_axes.hpp"

#include <cmath>

#include "camera/require.hpp"
#include "numbers/degrees.hpp"

namespace viewproj::detail {

void TurnedAxes::turn(std::size_t a, std::size_t b, const Angle& angle) noexcept {
  const auto [sine, cosine] = angle.isRadians ? sinCosRadians(angle.value) : sinCosDegrees(angle.value);
  Vector3<Dyadic<1>>&first = axes_[a], &second = axes_[b];
  for (std::size_t i = 0; i < 3; ++i) {
    const Dyadic<1> from = first[i], to = second[i];
    first[i] = sinCosProduct(from, cosine) - sinCosProduct(to, sine);
    second[i] = sinCosProduct(from, sine) + sinCosProduct(to, cosine);
  }
}

FineVec3 TurnedAxes::axis(std::size_t index, bool opposite) const noexcept {
  constexpr double kNoise = 0x1p-207;  // smaller entries are what rounding left of a sum that cancels
  FineVec3 v;
  for (std::size_t i = 0; i < 3; ++i) {
    const Dyadic<1>& part = axes_[index][i];
    if (std::fabs(double(part.rounded())) >= kNoise) v[i] = opposite ? -part : part;
  }
  return v;
}

}  // namespace viewproj::detail

namespace viewproj {

using namespace detail;

Pose poseFromTurns(const Vec3& position, const std::array<Turn, 3>& turns, CameraAxes axes) {
  TurnedAxes t({{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}});
  for (const Turn& turn : turns) {
    if (turn.axis < 0 || turn.axis > 2) throw CameraError("euler", "has an axis that is not 0, 1 or 2");
    requireTurn(turn.angle, "euler");
    const auto axis = static_cast<std::size_t>(turn.axis);
    t.turn((axis + 2) % 3, (axis + 1) % 3, turn.angle);
  }
  const AxisMap map = axisMap(axes);
  std::array<FineVec3, 3> turned;
  for (std::size_t i = 0; i < 3; ++i) turned[map.along[i]] = t.axis(i, map.sign[i] < 0);
  return poseFromAxes(position, turned);
}

}  // namespace viewproj
