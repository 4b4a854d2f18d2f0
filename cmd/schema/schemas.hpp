// The files beside this one, as text.
#pragma once

#include <string_view>

namespace viewproj::cmd {

struct NamedSchema {
  std::string_view name, text;
};

/// camera, points, scene, results. Defined in a file that CMake writes.
extern const NamedSchema kSchemas[4];

}  // namespace viewproj::cmd
