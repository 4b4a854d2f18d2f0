// What a command's options say of themselves.
#pragma once

#include <string>
#include <vector>

#include "commands/command.hpp"
#include "commands/command_line.hpp"

namespace viewproj::cmd {

struct OptionHelp {
  std::string name;  ///< as it is typed: "-c, --camera FILE[#NAME]"
  std::string text;
};

struct OptionGroup {
  std::string heading;
  std::vector<OptionHelp> options;
};

struct CommandHelp {
  std::string name;  ///< "viewproj project"
  std::string description;
  std::vector<OptionHelp> arguments;  ///< those without a dash
  std::vector<OptionGroup> groups;    ///< the command's own, under kOwnOptions, come first
  std::string example;                ///< a command line that works beside samples/
};

CommandHelp describe(const Command& command);

/// Of one command, for a terminal.
std::string helpText(const CommandHelp& help);

}  // namespace viewproj::cmd
