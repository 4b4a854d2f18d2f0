// The commands of the tool. To add one: a file beside this one, and a row in command.cpp.
#pragma once

#include <functional>
#include <span>
#include <string_view>

namespace viewproj::cmd {

class CommandLine;

/// What a command does once its options are parsed. Returns the exit status; throws what text/error.hpp lists.
using Action = std::function<int()>;

struct Command {
  std::string_view name;
  std::string_view summary;
  /// Gives the line its description, its options and its example. The action works on what the line has parsed.
  Action (*define)(CommandLine& line);
};

std::span<const Command> allCommands();

Action defineProject(CommandLine& line);
Action defineRay(CommandLine& line);
Action defineMatrix(CommandLine& line);
Action defineCull(CommandLine& line);
Action defineInspect(CommandLine& line);
Action defineExplain(CommandLine& line);
Action defineDepth(CommandLine& line);
Action defineMeasure(CommandLine& line);
Action defineDraw(CommandLine& line);
Action defineFit(CommandLine& line);
Action defineSchema(CommandLine& line);
Action defineHelp(CommandLine& line);

}  // namespace viewproj::cmd
