#include "commands/command.hpp"

namespace viewproj::cmd {
namespace {

constexpr Command kCommands[] = {
    {"project", "points to screen positions, depth and visibility", declareProject},
    {"ray", "pixels to rays, and to the points behind them", declareRay},
    {"cull", "which points and shapes lie in the view, and which plane decides", declareCull},
    {"matrix", "a camera's matrices in any convention", declareMatrix},
    {"check", "whether points lie at their pixels, and which mistake explains it", declareCheck, 2},
    {"info", "what is in a camera file", declareInfo},
    {"inspect", "which camera and which convention a matrix is of", declareInspect},
    {"explain", "every stage of one point or pixel, by hand", declareExplain},
    {"depth", "what a depth buffer resolves at each distance", declareDepth},
    {"measure", "time and error of every precision on your own points", declareMeasure},
    {"draw", "an SVG of what the camera sees", declareDraw},
    {"fit", "the camera moved, or its lens opened, so that all of it is seen", declareFit},
    {"schema", "the JSON Schema of a camera file", declareSchema},
    {"help", "what a command or one of the topics below is about", declareHelp},
};

}  // namespace

std::span<const Command> allCommands() { return kCommands; }

}  // namespace viewproj::cmd
