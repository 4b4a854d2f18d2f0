// Gives the library access to the numbers behind the public classes, and makes those classes from numbers.
#pragma once

#include <memory>

#include "viewproj/camera.hpp"

namespace viewproj::detail {

struct Access {
  template <class Whole>
  static const auto& shared(const Whole& whole) noexcept {
    return whole.parts_;
  }
  template <class Whole, class Parts>
  static Whole whole(std::shared_ptr<const Parts> parts) noexcept {
    return Whole(std::move(parts));
  }
};

}  // namespace viewproj::detail
