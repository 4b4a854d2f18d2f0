// What a convention means in numbers.
#pragma once

#include "viewproj/convention.hpp"

namespace viewproj::detail {

/// +1 where the axis of view space points as right, up, forward do, -1 where it points the other way.
struct AxisSigns {
  double up, forward;
};

constexpr AxisSigns axisSigns(ViewAxes axes) noexcept {
  return {axes == ViewAxes::RDF ? -1.0 : 1.0, axes == ViewAxes::RUB ? -1.0 : 1.0};
}

}  // namespace viewproj::detail
