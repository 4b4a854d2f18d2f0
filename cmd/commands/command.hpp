// The commands of the tool. To add one: a file beside this one, and a row in command.cpp.
#pragma once

#include <functional>
#include <span>
#include <string_view>

namespace CLI {
class App;
}

namespace viewproj::cmd {

/// What a command does once its options are parsed. Returns the exit status; throws what text/error.hpp lists.
using Action = std::function<int()>;

struct Command {
  std::string_view name;
  std::string_view summary;
  /// Gives the app its description, its options and its example. The action works on what the app has parsed.
  Action (*define)(CLI::App& app);
};

/// Headings in the help: of the command's own options, and of those that every command has.
inline constexpr const char* kOwnOptions = "Options";
inline constexpr const char* kEverywhere = "Output file and messages";

std::span<const Command> allCommands();

Action defineProject(CLI::App& app);
Action defineRay(CLI::App& app);
Action defineMatrix(CLI::App& app);
Action defineCull(CLI::App& app);
Action defineInspect(CLI::App& app);
Action defineExplain(CLI::App& app);
Action defineDepth(CLI::App& app);
Action defineMeasure(CLI::App& app);
Action defineDraw(CLI::App& app);
Action defineSchema(CLI::App& app);
Action defineHelp(CLI::App& app);

}  // namespace viewproj::cmd
