// Finds the command, runs it, and turns an error into one message and an exit status: 0 for success, 1 if an input is
// wrong or an output cannot be written, 2 if the command line is wrong.
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
  // A preloaded or linked library may have changed the arithmetic of the whole program.
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
