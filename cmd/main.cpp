// Finds the command, runs it, and turns what went wrong into one message and an exit status:
// 0 all went well, 1 an input was wrong or an output could not be written, 2 the command line was wrong.
#include <algorithm>
#include <new>
#include <string>
#include <vector>

#include "commands/command.hpp"
#include "numbers/arithmetic.hpp"
#include "output/output_file.hpp"
#include "text/error.hpp"
#include "text/system.hpp"
#include "viewproj/camera.hpp"

namespace {

using namespace viewproj::cmd;

int run(std::vector<std::string> arguments) {
  if (arguments.empty()) {
    complain("a command is needed\n\n" + overview());
    return 2;
  }
  std::string name = arguments.front();
  arguments.erase(arguments.begin());
  if (name == "--version") {
    if (!arguments.empty()) throw UsageError("'" + arguments.front() + "' was not expected after --version");
    writeOutput("viewproj " VIEWPROJ_VERSION "\n");
    return 0;
  }
  if (name == "--help" || name == "-h") name = "help";
  return runCommand(findCommand(name), arguments);
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
    return run({argv + std::min(argc, 1), argv + argc});
  } catch (...) {
    return reportException();
  }
}
