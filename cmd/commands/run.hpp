// A command line, parsed and obeyed.
#pragma once

#include "commands/command.hpp"

namespace viewproj::cmd {

/// argv[0] is the command's name. Returns the exit status; throws what text/error.hpp lists.
int runCommand(const Command& command, int argc, char** argv);

}  // namespace viewproj::cmd
