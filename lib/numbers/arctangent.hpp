// The arctangent and its inverse in double-double, with bits and bounds that libm does not guarantee.
#pragma once

#include "numbers/double_double.hpp"

namespace viewproj::detail {

/// The angle of this slope in radians, for 0 <= slope < 2^900. The relative error is at most 2^-94.
DoubleDouble arctangent(DoubleDouble slope) noexcept;

/// The sine (across) and cosine (along) of an angle from 0 to a half turn, both divided by the size of the larger one.
/// The angle they represent is within 2^-94 relative.
struct Direction {
  DoubleDouble across, along;
};
Direction directionOf(DoubleDouble angle) noexcept;

inline constexpr DoubleDouble kQuarterTurn{0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};
inline constexpr DoubleDouble kDegreesPerRadian{0x1.ca5dc1a63c1f8p+5, -0x1.1e7ab456405f9p-49};
inline constexpr DoubleDouble kHalfTurn{0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};

// ---- The formula, for double-double and for lanes of it

inline double high(const DoubleDouble& a) noexcept { return a.hi; }
template <class Number>
Number choose(bool condition, const Number& a, const Number& b) noexcept {
  return condition ? a : b;
}
/// entry(i) of the whole number i that a position is rounded down to.
template <class Entry>
DoubleDouble entryAt(const DoubleDouble& position, const Entry& entry) noexcept {
  return entry(static_cast<int>(position.hi));
}

/// The arctangents of 0/16 ... 16/16. Not inline: no kernel shares anything.
constexpr DoubleDouble kArctangents[] = {
    {0x0.0p+0, 0x0.0p+0},
    {0x1.ff55bb72cfdeap-5, -0x1.c934d86d23f1dp-60},
    {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59},
    {0x1.7b97b4bce5b02p-3, 0x1.347b0b4f881cap-58},
    {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
    {0x1.362773707ebccp-2, -0x1.963a544b672d8p-57},
    {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
    {0x1.a64eec3cc23fdp-2, -0x1.24dec1b50b7ffp-56},
    {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
    {0x1.0657e94db30d0p-1, -0x1.d5b495f6349e6p-56},
    {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
    {0x1.345f01cce37bbp-1, 0x1.1021137c71102p-55},
    {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
    {0x1.5d58987169b18p-1, 0x1.0028e4bc5e7cap-57},
    {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
    {0x1.819d0b7158a4dp-1, -0x1.bf76229d3b917p-56},
    {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55},
};

/// 1 / (2 n + 1).
constexpr auto kOdd = [] {
  struct {
    DoubleDouble of[13];
  } odd;
  for (int n = 0; n < 13; ++n) odd.of[n] = DoubleDouble(1) / DoubleDouble(2 * n + 1);
  return odd;
}();

/// z - z^3/3 + z^5/5 - ... of |z| <= 1/32.
template <class Number>
[[gnu::always_inline]] inline Number arctangentOfSmall(const Number& z) noexcept {
  const Number minusSquare = -(z * z);
  auto rest = high(Number(kOdd.of[12].hi));
  for (int n = 11; n >= 4; --n) rest = kOdd.of[n].hi + high(minusSquare) * rest;  // these are below 2^-43
  Number sum = rest;
  for (int n = 3; n > 0; --n) sum = Number(kOdd.of[n]) + minusSquare * sum;
  return z + z * (minusSquare * sum);
}

/// The angle from 0 to a half turn whose sine and cosine are these times any length. across >= 0. A NaN's is none.
template <class Number>
[[gnu::always_inline]] inline Number angleOf(const Number& across, const Number& along) noexcept {
  const auto isBackward = high(along) < 0.0;
  const Number size = choose(isBackward, Number(-along), along);
  const auto isSteep = high(across) > high(size);
  const Number larger = choose(isSteep, across, size), smaller = choose(isSteep, size, across);
  const Number position = 16.0 * (high(smaller) / high(larger)) + 0.5;
  const Number index = choose(high(position) > 0.0, position, Number(0));
  const Number start = entryAt(index, [](int i) { return DoubleDouble(i / 16.0); });
  const Number angle = entryAt(index, [](int i) { return kArctangents[i]; }) +
                       arctangentOfSmall(Number((smaller - start * larger) / (larger + start * smaller)));
  const Number forward = choose(isSteep, Number(kQuarterTurn) - angle, angle);
  return choose(isBackward, Number(kHalfTurn) - forward, forward);
}

}  // namespace viewproj::detail
