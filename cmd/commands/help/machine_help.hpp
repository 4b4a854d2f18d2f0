// What help says, for editors and scripts.
#pragma once

#include <string>

namespace viewproj::cmd {

/// All commands with their options, the topics, and the fields of files, as one JSON object.
std::string helpAsJson();

}  // namespace viewproj::cmd
