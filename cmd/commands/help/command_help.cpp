#include "commands/help/command_help.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "commands/definition.hpp"
#include "commands/help/topics.hpp"
#include "text/layout.hpp"
#include "text/names.hpp"

namespace viewproj::cmd {
namespace {

constexpr std::size_t kColumn = 30;

OptionHelp describe(const CLI::Option& option) {
  OptionHelp help{
      .name = {}, .text = option.get_description(), .names = {}, .value = {}, .facts = FactKeeper::factsOf(&option)};
  if (option.get_positional()) {
    help.name = option.get_name(true);
    return help;
  }
  for (const std::string& letter : option.get_snames()) help.names.push_back("-" + letter);
  for (const std::string& word : option.get_lnames()) help.names.push_back("--" + word);
  if (option.get_type_size() > 0) help.value = option.get_type_name();
  help.name = joined(help.names);
  if (!help.value.empty()) help.name += " " + help.value;
  return help;
}

std::string row(const OptionHelp& option, std::size_t width) {
  // On a narrow terminal the text has the larger part of the line.
  const std::size_t column = std::min(kColumn, width / 3);
  const std::string name = "  " + option.name;
  const bool fits = columnsOf(name) + 2 <= column;
  return (fits ? paddedRight(name, column) : name + "\n" + std::string(column, ' ')) +
         wrapped(option.text, width, column);
}

}  // namespace

CommandHelp describe(const CLI::App& app) {
  CommandHelp help{app.get_name(), app.get_description(), {}, {{kOwnOptions, {}}}, app.get_footer()};
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_positional()) {
      help.arguments.push_back(describe(*option));
      continue;
    }
    const std::string& heading = option->get_group();
    auto group = std::find_if(help.groups.begin(), help.groups.end(),
                              [&](const OptionGroup& known) { return known.heading == heading; });
    if (group == help.groups.end()) group = help.groups.insert(group, {heading, {}});
    group->options.push_back(describe(*option));
  }
  return help;
}

CommandHelp describe(const Command& command) {
  const FactKeeper keeper;  // of this command alone: the next one's options may lie where these did
  CommandLine app("", "viewproj " + std::string(command.name));
  (void)define(command, app);
  app.addAll();
  return describe(app);
}

std::string usage(const CommandHelp& help) {
  std::string line = help.name + " [options]";
  for (const OptionHelp& argument : help.arguments) line += " [" + argument.name + "]";
  return line;
}

std::string helpText(const CommandHelp& help) {
  const std::size_t width = terminalWidth();
  std::string out = wrapped(help.description, width) + "\nUsage: " + usage(help) + "\n";
  if (!help.arguments.empty()) out += "\n";
  for (const OptionHelp& argument : help.arguments) out += row(argument, width);
  for (const OptionGroup& group : help.groups) {
    out += "\n" + group.heading + ":\n";
    for (const OptionHelp& option : group.options) out += row(option, width);
  }
  return out + "\nExample:\n" + indented(help.example, 2);
}

std::string helpText() {
  const std::size_t width = terminalWidth();
  constexpr std::size_t kNames = 14;
  const auto line = [&](std::string_view name, std::string_view text) {
    return paddedRight("  " + std::string(name), kNames) + wrapped(text, width, kNames);
  };
  std::string out =
      "viewproj: " + std::string(kSummary) + "\n\nUsage: viewproj <command> [options] [FILE]\n\nCommands:\n";
  for (const Command& command : allCommands()) out += line(command.name, command.summary);
  out += "\nTopics, for viewproj help:\n";
  for (const Topic& topic : topics()) out += line(topic.name, topic.summary);
  out += "\nExit status:\n";
  for (const auto& [status, meaning] : kStatuses) out += line(status, meaning);
  return out + "\n" + wrapped("viewproj <command> --help tells its options; viewproj --version the version.", width);
}

}  // namespace viewproj::cmd
