#include "commands/command.hpp"

#include <CLI/CLI.hpp>

#include "commands/help.hpp"
#include "input/error.hpp"
#include "input/names.hpp"
#include "output/output_file.hpp"

namespace viewproj::cmd {
namespace {

constexpr Command kCommands[] = {
    {"project", "points to screen positions, depth and visibility", defineProject},
    {"ray", "pixels to rays, and to the points behind them", defineRay},
    {"cull", "which points and shapes lie in the view, and which plane decides", defineCull},
    {"matrix", "a camera's matrices in any convention", defineMatrix},
    {"inspect", "which camera and which convention a matrix is of", defineInspect},
    {"explain", "every stage of one point or pixel, by hand", defineExplain},
    {"depth", "what a depth buffer resolves at each distance", defineDepth},
    {"measure", "speed and error of every precision on your own points", defineMeasure},
    {"draw", "an SVG of what the camera sees", defineDraw},
    {"schema", "the JSON Schema of a camera, of points, a scene or results", defineSchema},
};

/// Throws UsageError, or HelpGiven after writing the help.
void parse(CLI::App& app, int argc, char** argv) {
  // An option given again replaces what was given before, unless it collects.
  for (CLI::Option* option : app.get_options())
    if (option->get_multi_option_policy() == CLI::MultiOptionPolicy::Throw)
      option->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  try {
    app.parse(argc, argv);
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

std::span<const Command> allCommands() { return kCommands; }

int runCommand(const Command& command, int argc, char** argv) {
  CLI::App app("", "viewproj " + std::string(command.name));
  const Action action = command.define(app);
  parse(app, argc, argv);
  return action();
}

}  // namespace viewproj::cmd
