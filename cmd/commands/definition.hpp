// A command, whole.
#pragma once

#include "commands/command.hpp"

namespace viewproj::cmd {

/// With the options that every command has, and what these add to the action.
Action define(const Command& command, CLI::App& app);

}  // namespace viewproj::cmd
