#include "camera/turned_axes.hpp"

#include <cmath>

#include "numbers/degrees.hpp"

namespace viewproj::detail {

void TurnedAxes::turn(std::size_t a, std::size_t b, double degrees) noexcept {
  const SinCos angle = sinCosDegrees(degrees);
  Vector3<Dyadic>&first = axes_[a], &second = axes_[b];
  for (std::size_t i = 0; i < 3; ++i) {
    const Dyadic from = first[i], to = second[i];
    first[i] = sinCosProduct(from, angle.cosine) - sinCosProduct(to, angle.sine);
    second[i] = sinCosProduct(from, angle.sine) + sinCosProduct(to, angle.cosine);
  }
  exact_ = exact_ && isRightAngle(degrees);
}

FineVec3 TurnedAxes::axis(std::size_t index, bool opposite) const noexcept {
  constexpr double kNoise = 0x1p-207;  // below it an entry is what rounding left of a sum that cancels
  FineVec3 v;
  for (std::size_t i = 0; i < 3; ++i) {
    const Dyadic& part = axes_[index][i];
    const Expansion<8> terms = (opposite ? -part : part).expansion<8>();
    if (std::fabs(terms.rounded().hi) >= kNoise) v.terms[i] = terms;
  }
  v.error = exact_ ? 0 : kTurnedRowBound;
  return v;
}

}  // namespace viewproj::detail
