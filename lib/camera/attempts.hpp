// Results in place of exceptions.
#pragma once

#include "viewproj/camera.hpp"

namespace viewproj::detail {

/// What it returns, or the fault it throws.
template <class Make>
auto attempt(const Make& make) noexcept -> Result<decltype(make())> {
  try {
    return make();
  } catch (const CameraError& error) {
    return error.fault();
  }
}

}  // namespace viewproj::detail
