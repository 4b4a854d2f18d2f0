#include "commands/definition.hpp"

#include <memory>

#include "commands/output_option.hpp"

namespace viewproj::cmd {

std::string fullName(const Command& command) { return "viewproj " + std::string(command.name); }

Action define(const Command& command, CommandLine& line) {
  const auto output = std::make_shared<OutputOption>();
  const Action action = command.define(line);
  output->add(line);
  return [output, action] {
    output->open();
    const int status = action();
    output->keep();
    return status;
  };
}

CommandLine wholeCommand(const Command& command) {
  CommandLine line(fullName(command));
  if (command.define) (void)define(command, line);
  return line;
}

}  // namespace viewproj::cmd
