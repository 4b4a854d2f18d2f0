// A view as an SVG: self-contained, no scripts, no fonts of its own, any width, light or dark as the reader's system.
#pragma once

#include <string>

#include "commands/draw/view.hpp"

namespace viewproj::cmd {

/// Every mark lies where its screen position does, to a hundredth of a unit of the sheet; its title tells the numbers.
std::string pictureOf(const View& view);

}  // namespace viewproj::cmd
