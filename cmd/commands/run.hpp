// A command line, parsed and obeyed.
#pragma once

#include <span>
#include <string>

#include "commands/command.hpp"

namespace viewproj::cmd {

/// arguments: those after the command's name. Returns the exit status; throws what text/error.hpp lists.
int runCommand(const Command& command, std::span<const std::string> arguments);

/// COMMAND --help.
std::string helpOf(const Command& command);

}  // namespace viewproj::cmd
