#include "commands/run.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "commands/definition.hpp"
#include "commands/help/command_help.hpp"
#include "commands/values.hpp"
#include "output/output_file.hpp"
#include "text/error.hpp"
#include "text/names.hpp"

namespace viewproj::cmd {
namespace {

/// As they are typed: CLI11 would take the argument after "--prefix=" for its value, and "=cam.json" for that of
/// "-c=cam.json".
void requireValuesAfterEquals(const CLI::App& app, std::span<const std::string_view> all) {
  for (const std::string_view help : {"--help", "-h"})  // which goes first
    if (std::find(all.begin(), all.end(), help) != all.end()) return;
  for (const std::string_view typed : all) {
    if (typed == "--") return;
    const std::size_t equals = typed.find('=');
    if (!typed.starts_with('-') || equals == std::string_view::npos) continue;
    const std::string name(typed.substr(0, equals));
    const CLI::Option* const option = app.get_option_no_throw(name);
    if (!option) continue;
    if (option->get_items_expected_max() == 0) throw UsageError(name + " takes no value");
    if (!name.starts_with("--"))
      throw UsageError(std::string(typed) + ": the value of " + name + " follows after a blank, without =");
    if (equals + 1 == typed.size()) throw UsageError(name + kEmptyValue);
  }
}

/// "; it is an option of project and ray", or the nearest that the command has.
std::string adviceOn(const std::string& extra, CommandLine& app) {
  if (!extra.starts_with('-')) return "";
  const std::string name = extra.substr(0, extra.find('='));
  std::vector<std::string_view> owners;
  for (const Command& command : allCommands()) {
    CommandLine other;
    (void)define(command, other);
    other.addAll();
    if (other.get_option_no_throw(name)) owners.push_back(command.name);
  }
  if (!owners.empty()) return "; it is an option of " + together(owners);
  app.addAll();
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& known : option->get_lnames()) names.push_back("--" + known);
  std::vector<std::string_view> begun, all(names.begin(), names.end());
  std::copy_if(all.begin(), all.end(), std::back_inserter(begun), [&](auto known) { return known.starts_with(name); });
  if (!begun.empty() && name.size() > 2) return "; did you mean " + alternatives(begun) + "?";
  if (nearestName(name, all).empty()) return "; " + app.get_name() + " --help tells its options";
  return suggestion(name, all);
}

/// Throws UsageError, or HelpGiven after writing the help.
void parse(CommandLine& app, int argc, char** argv) {
  const std::vector<std::string_view> all(argv + 1, argv + argc);
  const auto help = [&]() -> HelpGiven {
    app.addAll();
    writeOutput(helpText(describe(app)));
    return {};
  };
  try {
    app.addTyped(all);
    requireValuesAfterEquals(app, all);
    app.parse(argc, argv);
  } catch (const UsageError&) {  // of an option's value; help goes first
    if (app.get_help_ptr()->count() > 0) throw help();
    throw;
  } catch (const CLI::CallForHelp&) {
    throw help();
  } catch (const CLI::ExtrasError&) {
    const std::string extra = app.remaining().front();
    throw UsageError("'" + extra + "' was not expected" + adviceOn(extra, app));
  } catch (const CLI::ParseError& e) {
    throw UsageError(e.what());
  }
}

}  // namespace

int runCommand(const Command& command, int argc, char** argv) {
  CommandLine app("", "viewproj " + std::string(command.name));
  const Action action = define(command, app);
  parse(app, argc, argv);
  return action();
}

}  // namespace viewproj::cmd
