// The --model option: where a model stands in the world.
#pragma once

#include <string>

#include "viewproj/matrices.hpp"

namespace viewproj::cmd {

/// source: a file name or the JSON itself. Four rows of four numbers for column vectors, of which the last is 0 0 0 1,
/// or an object of translation, rotation [x, y, z, w] and scale. Throws InputError with the place of what is wrong, and
/// UsageError for numbers that are neither.
Mat4 readModel(const std::string& source);

}  // namespace viewproj::cmd
