// Finds the command, runs it, and turns what went wrong into one message and an exit status:
// 0 all went well, 1 an input was wrong or an output could not be written, 2 the command line was wrong.
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include "commands/help/command_help.hpp"
#include "commands/run.hpp"
#include "numbers/arithmetic.hpp"
#include "output/output_file.hpp"
#include "text/error.hpp"
#include "text/names.hpp"
#include "text/system.hpp"
#include "viewproj/camera.hpp"

namespace {

using namespace viewproj::cmd;

const Command& find(std::string_view name) {
  std::vector<std::string_view> known;
  for (const Command& command : allCommands()) {
    if (command.name == name) return command;
    known.push_back(command.name);
  }
  throw UsageError("'" + std::string(name) + "' is no command" + suggestion(name, known));
}

int run(int argc, char** argv) {
  const std::string_view name = argc > 1 ? argv[1] : "";
  const int most = name == "--help" || name == "-h" || name == "--version" ? 2 : argc;
  if (argc > most)
    throw UsageError("'" + std::string(argv[most]) + "' was not expected after " + std::string(argv[most - 1]));
  if (name == "--help" || name == "-h") {
    writeOutput(helpText());
    return 0;
  }
  if (name == "--version") {
    writeOutput("viewproj " VIEWPROJ_VERSION "\n");
    return 0;
  }
  if (name.empty()) {
    complain("a command is needed\n\n" + helpText());
    return 2;
  }
  return runCommand(find(name), argc - 1, argv + 1);
}

}  // namespace

int main(int argc, char** argv) {
  prepareSystem();
  // What is preloaded or linked may have changed it for the whole program.
  if (const char* fault = viewproj::detail::arithmeticFault()) {
    complain(fault);
    return 1;
  }
  std::set_new_handler(endWithoutMemory);
  try {
    return run(argc, argv);
  } catch (...) {
    return reportException();
  }
}
