// viewproj help: the tool, a command, or a topic.
#include <memory>

#include "commands/command.hpp"
#include "commands/help/command_help.hpp"
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
  throw UsageError("'" + *name + "' is no command and no topic" + suggestion(*name, known, "help"));
}

int run(const Options& o) {
  writeOutput(textOf(o.name));
  return 0;
}

}  // namespace

Action defineHelp(CommandLine& line) {
  const auto o = std::make_shared<Options>();
  line.setDescription("What a command is about, with its options, or one of the topics: " + [] {
    std::vector<std::string_view> names;
    for (const Topic& topic : topics()) names.push_back(topic.name);
    return joined(names);
  }() + ".");
  line.setExample("viewproj help camera");
  addValue(line, "NAME", "", o->name, readText, "A command or a topic; absent: all of them, a line each");
  addOnlyForm(line, "text", ".txt");
  o->notes.add(line);
  return [o] { return run(*o); };
}

}  // namespace viewproj::cmd
