// Writes the manual page from what the commands say of their options.
//   viewproj_man VERSION DATE CAMERA_FILE FOLDER > viewproj.1
// CAMERA_FILE is shown as an example; FOLDER is where samples/ is installed.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "commands/help/command_help.hpp"
#include "man/roff.hpp"
#include "text/file.hpp"

namespace {

using namespace viewproj::cmd;

std::string entry(const OptionHelp& option) {
  // Names in bold, the word for a value in italics.
  const std::size_t value = option.name.starts_with('-') ? option.name.rfind(' ') : std::string::npos;
  const bool hasValue = value != std::string::npos && option.name[value + 1] != '-';
  std::string names = roff::bold(hasValue ? option.name.substr(0, value) : option.name);
  if (hasValue) names += " " + roff::italic(option.name.substr(value + 1));
  return ".TP\n" + names + "\n" + roff::filled(option.text);
}

std::string sectionOf(const Command& command, const CommandHelp& help) {
  std::string out = ".SS " + std::string(command.name) + "\n" + roff::filled(help.description) + ".PP\n" +
                    roff::bold(help.name) + " " + roff::escaped(usage(help).substr(help.name.size() + 1)) + "\n";
  for (const OptionHelp& argument : help.arguments) out += entry(argument);
  std::string shared;
  for (const OptionGroup& group : help.groups) {
    if (group.heading != kOwnOptions) {
      shared += (shared.empty() ? "" : ", ") + group.heading;
      continue;
    }
    for (const OptionHelp& option : group.options)
      if (option.name != kHelpOption) out += entry(option);
  }
  if (!shared.empty()) out += ".PP\n" + roff::filled("And the options under: " + shared + ".");
  return out + ".PP\nExample:\n" + roff::verbatim(help.example);
}

/// The groups that commands share, each once, in the order in which the commands have them.
std::vector<OptionGroup> sharedGroups(const std::vector<CommandHelp>& commands) {
  std::vector<OptionGroup> shared;
  std::map<std::string, std::size_t> places;
  for (const CommandHelp& command : commands)
    for (const OptionGroup& group : command.groups) {
      if (group.heading == kOwnOptions) continue;
      const auto [place, isNew] = places.try_emplace(group.heading, shared.size());
      if (isNew)
        shared.push_back(group);
      else if (group.options != shared[place->second].options)
        throw std::runtime_error(command.name + ": other options under '" + group.heading + "' than another command");
    }
  return shared;
}

std::string page(const std::string& version, const std::string& date, const std::string& camera,
                 const std::string& folder) {
  std::vector<CommandHelp> commands;
  for (const Command& command : allCommands()) commands.push_back(describe(command));

  std::string out = ".TH VIEWPROJ 1 \"" + date + "\" \"viewproj " + version +
                    "\"\n.nh\n.ad l\n.SH NAME\nviewproj \\- " + roff::escaped(kSummary) + "\n.SH SYNOPSIS\n" +
                    roff::bold("viewproj") + " " + roff::italic("command") + " [options] [" + roff::italic("FILE") +
                    "]\n.br\n" + roff::bold("viewproj help") + " [" + roff::italic("command") + "]\n.br\n" +
                    roff::bold("viewproj --version") + "\n.SH DESCRIPTION\n";
  out += roff::filled(
      "A camera is a JSON file. Every command but inspect, which reads matrices, and schema reads one, and writes its "
      "answer to standard output. FILE absent or - is standard input. Options that commands share are told once, "
      "after the commands; viewproj help command tells all options of one.");
  out += ".PP\n" + roff::filled("The examples are for the folder " + folder + " of the installation (/usr/" + folder +
                                " for a package), where samples/ is.");
  out += ".SH COMMANDS\n";
  for (std::size_t i = 0; i < commands.size(); ++i) out += sectionOf(allCommands()[i], commands[i]);
  out += ".SH OPTIONS\n";
  for (const OptionGroup& group : sharedGroups(commands)) {
    out += ".SS " + group.heading + "\n";
    for (const OptionHelp& option : group.options) out += entry(option);
  }
  out += ".SH EXIT STATUS\n";
  for (const auto& [status, meaning] : kStatuses) out += ".TP\n" + roff::bold(status) + "\n" + roff::filled(meaning);
  out += ".SH FILES\n" + roff::filled("A camera file:") + roff::verbatim(camera);
  out += ".TP\n" + roff::italic(folder + "/README.md") + "\n" +
         roff::filled("Cameras, conventions, streams and errors, the library, and what precision promises.");
  out += ".TP\n" + roff::italic(folder + "/samples") + "\n" + roff::filled("Cameras, points and scenes to try.");
  return out;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) {
    std::fprintf(stderr, "usage: viewproj_man VERSION DATE CAMERA_FILE FOLDER\n");
    return 2;
  }
  try {
    const std::string text = page(argv[1], argv[2], readWholeFile(argv[3], 1 << 20), argv[4]);
    return std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0 ? 0 : 1;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "viewproj_man: %s\n", e.what());
    return 1;
  }
}
