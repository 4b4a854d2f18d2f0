#include "commands/definition.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include "commands/output_option.hpp"

namespace viewproj::cmd {

Action define(const Command& command, CLI::App& app) {
  const auto output = std::make_shared<OutputOption>();
  const Action action = command.define(app);
  output->add(app);
  return [output, action] {
    output->open();
    const int status = action();
    output->keep();
    return status;
  };
}

}  // namespace viewproj::cmd
