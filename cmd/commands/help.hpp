// The help of the tool.
#pragma once

#include <string>

namespace viewproj::cmd {

/// The commands and topics, a line each.
std::string overview();

}  // namespace viewproj::cmd
