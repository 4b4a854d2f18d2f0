// The commands of the tool. To add one: a file beside this one, its declaration here and a row in command.cpp.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace CLI {
class App;
}

namespace viewproj::cmd {

/// What a command does once its options are parsed. Returns the exit status; throws what text/error.hpp lists.
using Action = std::function<int()>;

struct Command {
  std::string_view task;  ///< what the command is for: a heading of the list
  std::string_view name;
  std::string_view summary;
  /// Gives the App its description, its options and its examples. The action works on what the App has parsed.
  Action (*declare)(CLI::App& app);
  int failureStatus = 1;     ///< exit status where an input is wrong or an output cannot be written
  bool opensOutput = false;  ///< what -o names may be a folder, and the command opens it itself
};

std::span<const Command> allCommands();

/// Throws UsageError for a name that is none.
const Command& findCommand(std::string_view name);

/// arguments: those after the command's name. Returns the exit status; throws what text/error.hpp lists.
int runCommand(const Command& command, std::span<const std::string> arguments);

/// COMMAND --help.
std::string helpOf(const Command& command);

/// viewproj help: the commands by task and the topics, a line each.
std::string overview();

Action declareProject(CLI::App& app);
Action declareRay(CLI::App& app);
Action declareMatrix(CLI::App& app);
Action declareConvert(CLI::App& app);
Action declareCull(CLI::App& app);
Action declareCheck(CLI::App& app);
Action declareInfo(CLI::App& app);
Action declareFootprint(CLI::App& app);
Action declareExplain(CLI::App& app);
Action declareDepth(CLI::App& app);
Action declareTriangulate(CLI::App& app);
Action declareMeasure(CLI::App& app);
Action declareDraw(CLI::App& app);
Action declareFit(CLI::App& app);
Action declareSchema(CLI::App& app);
Action declareHelp(CLI::App& app);

}  // namespace viewproj::cmd
