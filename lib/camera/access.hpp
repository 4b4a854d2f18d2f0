// Gives the library access to the numbers behind the public classes, and makes those classes from numbers.
#pragma once

#include <atomic>

#include "viewproj/camera.hpp"

namespace viewproj::detail {

struct Access {
  template <class Whole>
  static const auto& shared(const Whole& whole) noexcept {
    return whole.parts_;
  }
  template <class Whole, class Parts>
  static Whole whole(const Shared<Parts>& parts) noexcept {
    return Whole(parts);
  }
};

struct Owners {
  std::atomic<long> count{1};
  virtual ~Owners() = default;
};

template <class Parts>
struct Owned final : Owners {
  template <class... Arguments>
  explicit Owned(const Arguments&... arguments) : parts(arguments...) {}
  const Parts parts;
};

/// Parts made of these arguments, and with one owner.
template <class Parts, class... Arguments>
Shared<Parts> shareNew(const Arguments&... arguments) {
  auto* owned = new Owned<Parts>(arguments...);
  return {&owned->parts, owned};
}
template <class Parts>
Shared<Parts> share(const Parts& parts) {
  return shareNew<Parts>(parts);
}

}  // namespace viewproj::detail
