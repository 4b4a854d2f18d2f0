// The files beside this one, as text.
#pragma once

#include <string_view>

namespace viewproj::cmd {

struct NamedSchema {
  std::string_view name, text;
};

/// camera, scene, and of the schema of results the definitions of reports. Defined in a file that CMake writes.
extern const NamedSchema kSchemas[3];

}  // namespace viewproj::cmd
