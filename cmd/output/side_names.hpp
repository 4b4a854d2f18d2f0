// The sides of the view, as results name them.
#pragma once

#include <string_view>

#include "viewproj/screen.hpp"

namespace viewproj::cmd {

/// In the interface's order.
inline constexpr Side kSides[] = {sideLeft, sideRight, sideBottom, sideTop, sideNear, sideFar};

/// Empty for 0.
inline std::string_view sideName(unsigned side) {
  switch (side) {
    case sideLeft:
      return "left";
    case sideRight:
      return "right";
    case sideBottom:
      return "bottom";
    case sideTop:
      return "top";
    case sideNear:
      return "near";
    case sideFar:
      return "far";
    default:
      return "";
  }
}

}  // namespace viewproj::cmd
