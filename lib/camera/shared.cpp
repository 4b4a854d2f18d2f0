#include "viewproj/shared.hpp"

#include "camera/access.hpp"

namespace viewproj::detail {

void addOwner(Owners* owners) noexcept {
  if (owners) owners->count.fetch_add(1, std::memory_order_relaxed);
}

void removeOwner(Owners* owners) noexcept {
  if (owners && owners->count.fetch_sub(1, std::memory_order_acq_rel) == 1) delete owners;
}

}  // namespace viewproj::detail
