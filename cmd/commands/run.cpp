#include "commands/run.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "commands/cli.hpp"
#include "output/output_file.hpp"
#include "text/error.hpp"
#include "text/names.hpp"

namespace viewproj::cmd {
namespace {

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
    {"matrix", "--type", "the camera is written in the form in which it was read"},
    {"measure", "--seconds", "measure chooses how long it runs"},
    {"ray", "--bound", "use --fields bound"},
    {"ray", "--clipped", "--pixel X,Y,0 and X,Y,1 give the points on near and far; choose hits by their distance"},
    {"ray", "--ray-from", "--pixel X,Y,0 gives the point on near"},
    {"schema", "camera", "schema prints the schema of a camera"},
    {"schema", "points", "help points tells the fields"},
    {"schema", "results", "help points tells the results"},
    {"schema", "scene", "help points tells the fields"},
};

/// "; it is an option of project and ray", what stands in for an option that is gone, or the nearest that there is.
std::string adviceOn(const std::string& argument, const Command& command, const CLI::App& app) {
  const std::string name = argument.substr(0, argument.find('='));
  for (const GoneArgument& gone : kGone)
    if (gone.argument == name && (gone.command.empty() || gone.command == command.name))
      return "; it is gone: " + std::string(gone.instead);
  if (!argument.starts_with('-')) {
    const CLI::Option *const camera = app.get_option_no_throw("--camera"), *const file =
                                                                               app.get_option_no_throw("FILE");
    const bool fileIsCamera = file && file->get_group() == kCameraGroup;
    return camera && camera->empty() && !fileIsCamera ? "; -c FILE gives the camera" : "";
  }
  std::vector<std::string_view> owners;
  for (const Command& other : allCommands()) {
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

}  // namespace

std::string helpOf(const Command& command) {
  CLI::App app("", "viewproj " + std::string(command.name));
  prepare(app);
  const Action action = command.declare(app);
  return app.help();
}

int runCommand(const Command& command, std::span<const std::string> arguments) {
  setFailureStatus(command.failureStatus);
  if (asksForHelp(arguments)) {
    writeOutput(helpOf(command));
    return 0;
  }
  CLI::App app("", "viewproj " + std::string(command.name));
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
