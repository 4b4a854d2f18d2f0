#include "commands/command.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <vector>

#include "camera/document.hpp"
#include "commands/cli.hpp"
#include "output/output_file.hpp"
#include "text/error.hpp"
#include "text/names.hpp"

namespace viewproj::cmd {
namespace {

constexpr std::string_view kPoints = "Points, pixels and the ground", kCameras = "Cameras and matrices",
                           kMistakes = "What is wrong, and how precise it is", kOther = "Help";

constexpr Command kCommands[] = {
    {kPoints, "project", "points to screen positions, depth and visibility", declareProject},
    {kPoints, "ray", "pixels to rays, and to the points behind them", declareRay},
    {kPoints, "cull", "which points and shapes lie in the view, and which plane decides", declareCull},
    {kPoints, "triangulate", "where the rays of pixels of several cameras meet", declareTriangulate},
    {kPoints, "footprint", "what each picture shows of the ground: outline, area, pixel size", declareFootprint},
    {kPoints, "draw", "an SVG of what the camera sees", declareDraw},
    {kCameras, "info", "a camera file, horizon and planes; or what a pasted matrix is", declareInfo},
    {kCameras, "matrix", "a camera's matrices in any convention", declareMatrix},
    {kCameras, "convert", "cameras as a file of another program, or as ours", declareConvert, 1, true},
    {kCameras, "fit", "the camera moved, or its lens opened, so that all of it is seen", declareFit},
    {kCameras, "schema", "the JSON Schema of a camera file", declareSchema},
    {kMistakes, "check", "whether points lie at their pixels, and which mistake explains it", declareCheck, 2},
    {kMistakes, "explain", "every stage of one point or pixel, by hand", declareExplain},
    {kMistakes, "depth", "what a depth buffer resolves at each distance", declareDepth},
    {kMistakes, "measure", "time and error of every precision on your own points", declareMeasure},
    {kOther, "help", "help on a command or on one of the topics below", declareHelp},
};

/// A command with its options.
struct Declared {
  explicit Declared(const Command& command) : app("", "viewproj " + std::string(command.name)) {
    prepare(app);
    run = command.declare(app);
  }
  CLI::App app;
  Action run;
};

/// To add to the message about an argument that was not expected: which commands have the option, or the nearest that
/// there is.
std::string adviceOn(const std::string& argument, const CLI::App& app) {
  const std::string name = argument.substr(0, argument.find('='));
  if (!name.starts_with('-')) {
    const CLI::Option* const camera = app.get_option_no_throw("--camera");
    return camera && camera->empty() && !fileIsCamera(app) ? "; -c FILE gives the camera" : "";
  }
  std::vector<std::string_view> owners;
  for (const Command& command : kCommands)
    if (Declared(command).app.get_option_no_throw(name)) owners.push_back(command.name);
  if (!owners.empty()) return "; it is an option of " + together(owners);
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& each : option->get_lnames()) names.push_back("--" + each);
  std::vector<std::string_view> near;
  constexpr std::size_t kShortest = 5;  // with its dashes
  std::copy_if(names.begin(), names.end(), std::back_inserter(near),
               [&](const std::string& known) { return name.size() >= kShortest && known.starts_with(name); });
  if (near.empty()) near.push_back(nearestName(name, std::vector<std::string_view>(names.begin(), names.end())));
  return near.front().empty() ? "; " + app.get_name() + " --help lists its options"
                              : "; did you mean " + alternatives(near) + "?";
}

/// Whether a message is of JSON that is typed: its place is the option that has it.
bool isOfTypedJson(const CLI::App& app, std::string_view message) {
  const auto options = app.get_options();
  return std::any_of(options.begin(), options.end(), [&](const CLI::Option* option) {
    const std::vector<std::string>& values = option->results();
    const std::string place = (option->get_lnames().empty() ? "" : "--") + option->get_single_name();
    return message.starts_with(place) && std::any_of(values.begin(), values.end(), isInlineJson);
  });
}

}  // namespace

std::span<const Command> allCommands() { return kCommands; }

const Command& findCommand(std::string_view name) {
  if (name == "inspect") throw UsageError("inspect has left; use info, and matrix to convert");
  std::vector<std::string_view> known;
  for (const Command& command : kCommands) {
    if (command.name == name) return command;
    known.push_back(command.name);
  }
  throw UsageError("'" + std::string(name) + "' is no command" + suggestion(name, known));
}

std::string helpOf(const Command& command) { return Declared(command).app.help(); }

int runCommand(const Command& command, std::span<const std::string> arguments) {
  setFailureStatus(command.failureStatus);
  // Help goes before whatever is wrong with the other arguments.
  const auto end = std::find(arguments.begin(), arguments.end(), "--");
  if (std::any_of(arguments.begin(), end, [](const auto& each) { return each == "--help" || each == "-h"; })) {
    writeOutput(helpOf(command));
    return 0;
  }
  Declared declared(command);
  CLI::App& app = declared.app;
  parse(app, arguments, [&](const std::string& argument) { return adviceOn(argument, app); });
  requireOneStandardInput(app);
  NamedOutput output(command.opensOutput ? "-" : outputFile(app));
  try {
    const int status = declared.run();
    if (status == 0 || !output.isEmpty()) output.keep();
    return status;
  } catch (const InputError& e) {
    if (isOfTypedJson(app, e.what())) throw UsageError(e.what());
    throw;
  }
}

}  // namespace viewproj::cmd
