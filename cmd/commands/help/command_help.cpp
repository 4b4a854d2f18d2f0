#include "commands/help/command_help.hpp"

#include <algorithm>

#include "commands/definition.hpp"
#include "text/layout.hpp"
#include "text/names.hpp"

namespace viewproj::cmd {
namespace {

constexpr std::size_t kColumn = 30;
OptionHelp describe(const Option& option) {
  if (option.isOperand()) return {option.names, option.help};
  return {joined(option.spelled()) + (option.form.empty() ? "" : " " + option.form), option.help};
}

std::string row(const OptionHelp& option, std::size_t width) {
  // On a narrow terminal the text has the larger part of the line.
  const std::size_t column = std::min(kColumn, width / 3);
  return entry("  " + option.name, column, option.text, width);
}

}  // namespace

CommandHelp describe(const Command& command) {
  const CommandLine line = wholeCommand(command);
  CommandHelp help{line.name(), line.description(), {}, {{kOwnOptions, {}}}, line.example()};
  for (const Option& option : line.options()) {
    if (option.isOperand()) {
      help.arguments.push_back(describe(option));
      continue;
    }
    auto group = std::find_if(help.groups.begin(), help.groups.end(),
                              [&](const OptionGroup& known) { return known.heading == option.heading; });
    if (group == help.groups.end()) group = help.groups.insert(group, {option.heading, {}});
    group->options.push_back(describe(option));
  }
  std::stable_partition(help.groups.begin(), help.groups.end(),
                        [](const OptionGroup& group) { return group.heading != kCameraFields; });
  return help;
}

std::string helpText(const CommandHelp& help) {
  const std::size_t width = terminalWidth();
  std::string out = wrapped(help.description, width) + "\nUsage: " + help.name + " [options]";
  for (const OptionHelp& argument : help.arguments) out += " [" + argument.name + "]";
  out += "\n";
  if (!help.arguments.empty()) out += "\n";
  for (const OptionHelp& argument : help.arguments) out += row(argument, width);
  for (const OptionGroup& group : help.groups) {
    out += "\n" + group.heading + ":\n";
    for (const OptionHelp& option : group.options) out += row(option, width);
  }
  return out + "\nExample:\n" + indented(help.example, 2);
}

}  // namespace viewproj::cmd
