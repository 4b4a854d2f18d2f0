// A file of JSON, or a binary glTF file, which has its JSON in front.
#pragma once

#include <cstddef>
#include <string>

namespace viewproj::cmd {

/// The text of a file; of a .glb file, known by its first four bytes, only the text of its JSON chunk, however large
/// the rest is. name "-" is standard input. Throws InputError, also if the text is longer than most. Source: glTF 2.0
/// specification, "GLB File Format Specification".
std::string readJsonFile(const std::string& name, std::size_t most);

}  // namespace viewproj::cmd
