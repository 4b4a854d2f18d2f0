// viewproj help: the tool, a command, or a topic.
#include <CLI/CLI.hpp>
#include <memory>

#include "commands/cli.hpp"
#include "commands/command.hpp"
#include "commands/help/command_help.hpp"
#include "commands/help/topics.hpp"
#include "commands/run.hpp"
#include "output/output_file.hpp"
#include "text/error.hpp"
#include "text/names.hpp"

namespace viewproj::cmd {
namespace {

std::string textOf(const std::optional<std::string>& name) {
  if (!name) return helpText();
  std::vector<std::string_view> known;
  for (const Command& command : allCommands()) {
    if (command.name == *name) return helpOf(command);
    known.push_back(command.name);
  }
  for (const Topic& topic : topics()) {
    if (topic.name == *name) return helpText(topic);
    known.push_back(topic.name);
  }
  throw UsageError("'" + *name + "' is no command and no topic" + suggestion(*name, known, "help"));
}

}  // namespace

Action declareHelp(CLI::App& app) {
  std::vector<std::string_view> names;
  for (const Topic& topic : topics()) names.push_back(topic.name);
  app.description("Help on a command, with its options, or on a topic: " + joined(names) + ".");
  app.footer("Examples:\n  viewproj help camera\n  viewproj help project");
  const auto name = std::make_shared<std::optional<std::string>>();
  app.add_option("NAME", *name, "A command or a topic; absent: the list of all");
  addOnlyForm(app, "text", ".txt .md");
  return [name] {
    writeOutput(textOf(*name));
    return 0;
  };
}

}  // namespace viewproj::cmd
