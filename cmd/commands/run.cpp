#include "commands/run.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "commands/help.hpp"
#include "output/output_file.hpp"
#include "text/error.hpp"
#include "text/names.hpp"

namespace viewproj::cmd {
namespace {

/// What was typed is checked as it was typed: an option of one value is given once, and no value is empty.
void requireOneValueEach(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_items_expected_max() == 0) continue;  // a flag
    const std::vector<std::string>& values = option->results();
    const std::string name = option->get_name();
    if (std::find(values.begin(), values.end(), "") != values.end())
      throw UsageError(name + " has an empty value; is a variable of a script not set?");
    if (values.size() > 1 && option->get_multi_option_policy() == CLI::MultiOptionPolicy::TakeLast)
      throw UsageError(name + " is given twice: " + values[0] + " and " + values[1]);
  }
}

/// Throws UsageError, or HelpGiven after writing the help.
void parse(CLI::App& app, int argc, char** argv) {
  for (CLI::Option* option : app.get_options())
    if (option->get_multi_option_policy() == CLI::MultiOptionPolicy::Throw)
      option->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  try {
    app.parse(argc, argv);
    requireOneValueEach(app);
  } catch (const CLI::CallForHelp&) {
    writeOutput(helpText(describe(app)));
    throw HelpGiven{};
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
