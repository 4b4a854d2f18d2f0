#include "commands/run.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "commands/cli.hpp"
#include "commands/definition.hpp"
#include "commands/help/command_help.hpp"
#include "output/output_file.hpp"
#include "text/error.hpp"
#include "text/names.hpp"

namespace viewproj::cmd {
namespace {

/// What does here what an option that only other commands have may be wanted for.
struct InPlace {
  std::string_view of, option, help;
};
constexpr InPlace kInPlace[] = {{"--convention", "--read-as", "says how a camera's numbers are meant"}};

/// Arguments that are gone, and what to use. For one release.
struct GoneArgument {
  std::string_view command;  ///< empty: several
  std::string_view argument, instead;
};
constexpr GoneArgument kGone[] = {
    {"", "--comment", "remove comment lines first, as with grep -v '^#'"},
    {"", "--decimal", "replace decimal commas first, as with tr , ."},
    {"", "--first-line", "messages count lines from the start of the input"},
    {"", "--format", "make the file a camera file with jq: samples/cameras-from-elsewhere has recipes"},
    {"", "--force", "pipe the output, as in --to f64 | cat"},
    {"", "--list", "viewproj info FILE lists the cameras"},
    {"", "--tolerance", "use --precision standard, and --fields bound for its error"},
    {"cull", "--corners", "viewproj info FILE has the corners"},
    {"cull", "--planes", "viewproj info FILE has the planes"},
    {"depth", "--gap", "the table tells the gap at each distance"},
    {"depth", "--resolve", "the table tells the gap at each distance"},
    {"help", "--json", "COMMAND --help tells the options, help TOPIC the fields"},
    {"inspect", "--exact", "the intervals of near and far go by the digits as written"},
    {"inspect", "--reading", "use --read-as NAME"},
    {"inspect", "--world", "use --read-as NAME"},
    {"measure", "--seconds", "measure chooses how long it runs"},
    {"ray", "--bound", "use --fields bound"},
    {"ray", "--clipped", "--pixel X,Y,0 and X,Y,1 give the points on near and far; choose hits by their distance"},
    {"ray", "--ray-from", "--pixel X,Y,0 gives the point on near"},
    {"schema", "camera", "schema prints the schema of a camera"},
    {"schema", "points", "help points tells the fields"},
    {"schema", "results", "help points and help pixels tell the results"},
    {"schema", "scene", "help scene tells the fields"},
};

// OLD
/// "; --read-as says ...".
std::string inPlaceOf(const std::string& name, const CommandLine& whole) {
  for (const auto& [of, option, help] : kInPlace)
    if (of == name && whole.find(std::string(option))) return "; " + std::string(option) + " " + std::string(help);
  return "";
}

/// "; it is an option of project and ray", what does the same here, or the nearest that the command has.
std::string oldAdviceOn(const std::string& argument, const Command& command, const CommandLine& line) {
  const std::string name = argument.substr(0, argument.find('='));
  for (const GoneArgument& gone : kGone)
    if (gone.argument == name && (gone.command.empty() || gone.command == command.name))
      return "; it is gone: " + std::string(gone.instead);
  if (!argument.starts_with('-')) {
    const CommandLine whole = wholeCommand(command);
    const bool takesCamera = std::any_of(whole.options().begin(), whole.options().end(), [](const Option& option) {
      return option.isOperand() && option.heading == kOwnOptions;
    });
    return whole.find(kCameraOption) && !takesCamera && !line.has(kCameraOption) ? "; -c FILE gives the camera" : "";
  }
  std::vector<std::string_view> owners;
  for (const Command& other : allCommands())
    if (wholeCommand(other).find(name)) owners.push_back(other.name);
  const CommandLine whole = wholeCommand(command);
  if (!owners.empty()) return "; it is an option of " + together(owners) + inPlaceOf(name, whole);
  std::vector<std::string> names;
  for (const Option& option : whole.options())
    for (const std::string& known : option.spelled())
      if (known.starts_with("--")) names.push_back(known);
  std::vector<std::string_view> begun, all(names.begin(), names.end());
  std::copy_if(all.begin(), all.end(), std::back_inserter(begun), [&](auto known) { return known.starts_with(name); });
  if (!begun.empty() && name.size() > 2) return "; did you mean " + alternatives(begun) + "?";
  if (nearestName(name, all).empty()) return "; " + whole.name() + " --help tells its options";
  return suggestion(name, all);
}

/// "; it is an option of project and ray", what stands in for an option that is gone, or the nearest that there is.
std::string adviceOn(const std::string& argument, const Command& command, const CLI::App& app) {
  const std::string name = argument.substr(0, argument.find('='));
  for (const GoneArgument& gone : kGone)
    if (gone.argument == name && (gone.command.empty() || gone.command == command.name))
      return "; it is gone: " + std::string(gone.instead);
  const CLI::Option* const camera = app.get_option_no_throw("--camera");
  if (!argument.starts_with('-')) return camera && camera->empty() ? "; -c FILE gives the camera" : "";
  std::vector<std::string_view> owners;
  for (const Command& other : allCommands()) {
    if (!other.declare) continue;
    CLI::App whole;
    prepare(whole);
    const Action action = other.declare(whole);
    if (whole.get_option_no_throw(name)) owners.push_back(other.name);
  }
  if (!owners.empty()) {
    const bool reads = name == "--convention" && app.get_option_no_throw("--read-as");
    return "; it is an option of " + together(owners) + (reads ? "; --read-as says how a camera is read" : "");
  }
  // Without dashes, which all have in common.
  const std::string bare = name.substr(std::min(name.find_first_not_of('-'), name.size()));
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    names.insert(names.end(), option->get_lnames().begin(), option->get_lnames().end());
  std::vector<std::string_view> near;
  std::copy_if(names.begin(), names.end(), std::back_inserter(near),
               [&](const std::string& known) { return bare.size() > 2 && known.starts_with(bare); });
  if (const std::string_view nearest = nearestName(bare, std::vector<std::string_view>(names.begin(), names.end()));
      near.empty() && !nearest.empty())
    near.push_back(nearest);
  if (near.empty()) return "; " + app.get_name() + " --help lists its options";
  std::vector<std::string> dashed;
  for (const std::string_view one : near) dashed.push_back("--" + std::string(one));
  return "; did you mean " + alternatives({dashed.begin(), dashed.end()}) + "?";
}

/// What names the cameras of a file does nothing else.
void requireAlone(const CommandLine& line) {
  if (!line.has(kListOption)) return;
  for (const Option& option : line.options())
    if (option.isGiven && option.heading != kCameraHeading && option.heading != kEverywhere &&
        !(option.isOperand() && option.heading == kOwnOptions))
      throw UsageError("--list names the cameras of the file and does nothing else; leave out " + option.name());
}

int runOld(const Command& command, int argc, const char* const* argv) {
  CommandLine line(fullName(command), std::vector<std::string_view>(argv + 1, argv + argc));
  const Action action = define(command, line);
  try {
    line.parse(argc, argv);
  } catch (const CommandLine::HelpAsked&) {
    writeOutput(helpText(describe(command)));
    return 0;
  } catch (const CommandLine::NotExpected& e) {
    throw UsageError("'" + e.argument + "' was not expected" + oldAdviceOn(e.argument, command, line));
  }
  requireAlone(line);
  return action();
}

}  // namespace

std::string helpOf(const Command& command) {
  if (!command.declare) return helpText(describe(command));
  CLI::App app("", fullName(command));
  prepare(app);
  const Action action = command.declare(app);
  return app.help();
}

int runCommand(const Command& command, std::span<const std::string> arguments) {
  if (!command.declare) {
    std::vector<const char*> argv = {"viewproj"};
    for (const std::string& argument : arguments) argv.push_back(argument.c_str());
    return runOld(command, static_cast<int>(argv.size()), argv.data());
  }
  if (asksForHelp(arguments)) {
    writeOutput(helpOf(command));
    return 0;
  }
  CLI::App app("", fullName(command));
  prepare(app);
  const Action action = command.declare(app);
  parse(app, arguments, [&](const std::string& argument) { return adviceOn(argument, command, app); });
  const CLI::Option* const file = app.get_option("--output");
  NamedOutput output(file->empty() ? "-" : file->results().front());
  const int status = action();
  output.keep();
  return status;
}

}  // namespace viewproj::cmd
