#include "commands/run.hpp"

#include <CLI/CLI.hpp>

#include "commands/help.hpp"
#include "output/output_file.hpp"
#include "text/error.hpp"
#include "text/names.hpp"

namespace viewproj::cmd {
namespace {

/// Throws UsageError, or HelpGiven after writing the help.
void parse(CLI::App& app, int argc, char** argv) {
  const auto help = [&]() -> HelpGiven {
    writeOutput(helpText(describe(app)));
    return {};
  };
  try {
    app.parse(argc, argv);
  } catch (const UsageError&) {  // of an option's value; help goes first
    if (app.get_help_ptr()->count() > 0) throw help();
    throw;
  } catch (const CLI::CallForHelp&) {
    throw help();
  } catch (const CLI::ExtrasError&) {
    const std::string extra = app.remaining().front();
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options())
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    const std::vector<std::string_view> known(names.begin(), names.end());
    throw UsageError("'" + extra + "' was not expected" +
                     (extra.starts_with('-') ? suggestion(extra.substr(0, extra.find('=')), known) : ""));
  } catch (const CLI::ParseError& e) {
    throw UsageError(e.what());
  }
}

}  // namespace

int runCommand(const Command& command, int argc, char** argv) {
  CLI::App app("", "viewproj " + std::string(command.name));
  const Action action = command.define(app);
  parse(app, argc, argv);
  return action();
}

}  // namespace viewproj::cmd
