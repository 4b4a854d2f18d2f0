// What the kernels of a batch leave to be settled point by point.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "viewproj/screen.hpp"

namespace viewproj::detail {

/// Points go in blocks: input and output may be the same memory, and a point that is not settled is read again.
inline constexpr std::size_t kBlock = 512;

/// Of a block, the points that a kernel has left: use(index) settles each.
struct Left {
  std::uint64_t bits[kBlock / 64] = {};

  bool has(std::size_t i) const noexcept { return bits[i / 64] >> i % 64 & 1; }
  template <class Use>
  void each(const Use& use) const noexcept {
    for (std::size_t i = 0; i < kBlock; i += 64)
      for (std::uint64_t rest = bits[i / 64]; rest; rest &= rest - 1)
        use(i + static_cast<std::size_t>(std::countr_zero(rest)));
  }
};

inline void tally(BatchCounts& counts, const ScreenPoint& settled) noexcept {
  ++counts.escalated;
  if (settled.status == PointStatus::inFront && !settled.certain) ++counts.uncertain;
}

}  // namespace viewproj::detail
