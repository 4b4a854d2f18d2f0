// A command, whole.
#pragma once

#include <string>

#include "commands/command.hpp"
#include "commands/command_line.hpp"

namespace viewproj::cmd {

/// "viewproj project".
std::string fullName(const Command& command);

/// With the options that every command has, and what these add to the action.
Action define(const Command& command, CommandLine& line);

/// With every option, for help.
CommandLine wholeCommand(const Command& command);

}  // namespace viewproj::cmd
