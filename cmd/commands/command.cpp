#include "commands/command.hpp"

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
    {"fit", "the camera moved, or its lens opened, so that all of it is seen", defineFit},
    {"schema", "the JSON Schema of a camera file", defineSchema},
    {"help", "what a command or one of the topics below is about", defineHelp},
};

}  // namespace

std::span<const Command> allCommands() { return kCommands; }

}  // namespace viewproj::cmd
