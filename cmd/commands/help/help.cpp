// viewproj help: the tool, a command, or a topic.
#include <CLI/CLI.hpp>
#include <memory>

#include "commands/command.hpp"
#include "commands/help/command_help.hpp"
#include "commands/help/machine_help.hpp"
#include "commands/help/topics.hpp"
#include "commands/notes.hpp"
#include "commands/output_option.hpp"
#include "commands/values.hpp"
#include "output/output_file.hpp"
#include "text/error.hpp"
#include "text/names.hpp"

namespace viewproj::cmd {
namespace {

struct Options {
  std::optional<std::string> name;
  bool json = false;
  Notes notes;
};

std::string textOf(const std::optional<std::string>& name) {
  if (!name) return helpText();
  std::vector<std::string_view> known;
  for (const Command& command : allCommands()) {
    if (command.name == *name) return helpText(describe(command));
    known.push_back(command.name);
  }
  for (const Topic& topic : topics()) {
    if (topic.name == *name) return helpText(topic);
    known.push_back(topic.name);
  }
  throw UsageError("'" + *name + "' is no command and no topic" + suggestion(*name, known));
}

int run(const Options& o) {
  if (o.json && o.name) throw UsageError("help --json tells of all; leave out one of it and " + *o.name);
  writeOutput(o.json ? helpAsJson() : textOf(o.name));
  return 0;
}

}  // namespace

Action defineHelp(CLI::App& app) {
  const auto o = std::make_shared<Options>();
  app.description("What a command is about, with its options, or one of the topics: " + [] {
    std::vector<std::string_view> names;
    for (const Topic& topic : topics()) names.push_back(topic.name);
    return joined(names);
  }() + ".");
  app.footer("viewproj help camera");
  addValue(app, "NAME", "", o->name, readText, "A command or a topic; absent: all of them, a line each");
  app.add_flag("--json", o->json, "All commands, options, topics and fields, for editors and scripts");
  addOnlyForm(app, "text or JSON", ".txt .json");
  o->notes.add(app);
  return [o] { return run(*o); };
}

}  // namespace viewproj::cmd
