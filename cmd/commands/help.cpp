#include "commands/help.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>

namespace viewproj::cmd {
namespace {

constexpr std::size_t kWidth = 100, kColumn = 30;

OptionHelp describe(const CLI::Option& option) {
  std::string name = option.get_name(true);
  if (!option.get_positional()) {
    name.clear();
    for (const std::string& letter : option.get_snames()) name += (name.empty() ? "-" : ", -") + letter;
    for (const std::string& word : option.get_lnames()) name += (name.empty() ? "--" : ", --") + word;
    if (option.get_type_size() > 0 && !option.get_type_name().empty()) name += " " + option.get_type_name();
  }
  return {name, option.get_description()};
}

/// Broken between words, each line but the first after `indent` blanks.
std::string wrapped(const std::string& text, std::size_t indent) {
  std::string out, word;
  std::size_t column = indent;
  for (std::istringstream words(text); words >> word; column += word.size()) {
    if (column > indent && column + 1 + word.size() > kWidth) {
      out += "\n" + std::string(indent, ' ');
      column = indent;
    } else if (column > indent) {
      out += " ";
      ++column;
    }
    out += word;
  }
  return out + "\n";
}

std::string row(const OptionHelp& option) {
  std::string line = "  " + option.name;
  if (line.size() + 2 > kColumn) line += "\n" + std::string(kColumn, ' ');
  if (line.size() < kColumn) line.resize(kColumn, ' ');
  return line + wrapped(option.text, kColumn);
}

/// Each line two blanks further in.
std::string indented(const std::string& text) {
  std::string out, line;
  for (std::istringstream lines(text); std::getline(lines, line);) out += "  " + line + "\n";
  return out;
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

std::string usage(const CommandHelp& help) {
  std::string line = help.name + " [options]";
  for (const OptionHelp& argument : help.arguments) line += " [" + argument.name + "]";
  return line;
}

std::string helpText(const CommandHelp& help) {
  std::string out = wrapped(help.description, 0) + "\nUsage: " + usage(help) + "\n";
  if (!help.arguments.empty()) out += "\n";
  for (const OptionHelp& argument : help.arguments) out += row(argument);
  for (const OptionGroup& group : help.groups) {
    out += "\n" + group.heading + ":\n";
    for (const OptionHelp& option : group.options) out += row(option);
  }
  return out + "\nExample:\n" + indented(help.example);
}

std::string helpText() {
  std::string out =
      "viewproj: " + std::string(kSummary) + "\n\nUsage: viewproj <command> [options] [FILE]\n\nCommands:\n";
  for (const Command& command : allCommands()) {
    std::string line = "  " + std::string(command.name);
    line.resize(12, ' ');
    out += line + std::string(command.summary) + "\n";
  }
  out += "\nExit status:\n";
  for (const auto& [status, meaning] : kStatuses) out += "  " + std::string(status) + "         " + meaning + "\n";
  return out + "\nviewproj <command> --help tells its options; viewproj --version the version.\n";
}

}  // namespace viewproj::cmd
