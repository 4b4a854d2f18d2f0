// How batches are cut.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

namespace viewproj::detail {

/// Points go in blocks: input and output may be the same memory, and a point that is not settled is read again.
constexpr std::size_t kBlock = 192;

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

}  // namespace viewproj::detail
