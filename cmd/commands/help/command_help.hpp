// What a command's options say of themselves, for --help and for the manual page.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "commands/command.hpp"
#include "commands/command_line.hpp"

namespace viewproj::cmd {

struct OptionHelp {
  std::string name;  ///< as it is typed: "-c, --camera FILE[#NAME]"
  std::string text;
  std::vector<std::string> names;  ///< "-c", "--camera"
  std::string value;               ///< "FILE[#NAME]"; empty where it takes none
  OptionFacts facts;
  bool operator==(const OptionHelp&) const = default;
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

inline constexpr const char* kHelpOption = "-h, --help";
inline constexpr const char* kSummary =
    "world points to screen coordinates, pixels to picking rays, cameras to matrices";
inline constexpr std::pair<const char*, const char*> kStatuses[] = {
    {"0", "All went well."},
    {"1", "An input was wrong, or an output could not be written."},
    {"2", "The command line was wrong."},
};

CommandHelp describe(const Command& command);

/// "viewproj project [options] [FILE]"
std::string usage(const CommandHelp& help);

/// Of one command, for a terminal.
std::string helpText(const CommandHelp& help);

/// Of the tool.
std::string helpText();

}  // namespace viewproj::cmd
