// The --model option: where a model stands in the world.
#pragma once

#include <string>

#include "viewproj/matrices.hpp"

namespace viewproj::cmd {

/// source: a file name or the JSON itself. Four rows of four numbers for column vectors, or an object as a glTF node
/// has it: translation, rotation [x, y, z, w] and scale, or matrix, 16 numbers by columns. The last row is 0 0 0 1.
/// Throws InputError with the place of what is wrong.
Mat4 readModel(const std::string& source);

}  // namespace viewproj::cmd
