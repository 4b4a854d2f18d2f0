#include "commands/help/topics.hpp"

#include "commands/help/pages.hpp"
#include "text/layout.hpp"

namespace viewproj::cmd {
namespace {

constexpr Topic kTopics[] = {
    {"camera",
     "the fields of a camera file",
     pages::camera,
     {"viewproj matrix samples/picking-a-pixel/camera.json --set projection.fovY=75 --to camera", "viewproj schema"}},
    {"projection",
     "what a camera sees: fields of view, windows, focal lengths",
     pages::projection,
     {"viewproj matrix --fov-y 60 --aspect 16/9 --near 0.1 --far 100 --which projection --to text",
      "viewproj matrix --ortho-height 10 --aspect 16/9 --near 0 --far 100 --to camera"}},
    {"viewport",
     "the picture that pixels are of",
     pages::viewport,
     {"viewproj project -c samples/picking-a-pixel/camera.json --viewport 640x360 --point 0,0,0",
      "viewproj project -c samples/picking-a-pixel/camera.json --set viewport.origin=bottom-left --point 0,0,0"}},
    {"points",
     "points and shapes, in JSON, CSV, text and f64",
     pages::points,
     {"printf 'id,x,y,z\\nA,0,0,0\\n' | viewproj project -c samples/picking-a-pixel/camera.json",
      "echo '0 0 0' | viewproj project -c samples/picking-a-pixel/camera.json --to table"}},
    {"pixels",
     "where pixels count from, and their depth",
     pages::pixels,
     {"viewproj ray -c samples/picking-a-pixel/camera.json --pixel 640,360",
      "viewproj ray -c samples/picking-a-pixel/camera.json --pixel 640,360,0.99"}},
    {"scene",
     "the shapes that rays may hit",
     pages::scene,
     {"viewproj ray -c samples/a-picture-of-a-harbour/camera.json --pixel 700,250 \\\n"
      "  --scene samples/a-picture-of-a-harbour/scene.json",
      "viewproj ray -c samples/a-picture-of-a-harbour/camera.json --pixel 700,250 \\\n"
      "  --scene samples/a-picture-of-a-harbour/scene.json --all-hits"}},
    {"conventions",
     "OpenGL, Direct3D and the others, axis by axis",
     pages::conventions,
     {"viewproj matrix samples/picking-a-pixel/camera.json --convention d3d --to hlsl",
      "viewproj matrix samples/picking-a-pixel/camera.json --convention vulkan --reverse-z --to text"}},
    {"formats",
     "the forms of files that are read and written",
     pages::formats,
     {"viewproj matrix samples/picking-a-pixel/camera.json --to numpy",
      "viewproj project -c samples/picking-a-pixel/camera.json --point 0,0,0 --to csv"}},
    {"precision",
     "what exact and standard promise",
     pages::precision,
     {"viewproj project -c samples/picking-a-pixel/camera.json --point 0,0,0 --fields screen,bound",
      "viewproj project -c samples/cornell-box/camera.json samples/cornell-box/quads.csv \\\n"
      "  --precision standard --fields screen,bound"}},
};

}  // namespace

std::span<const Topic> topics() { return kTopics; }

std::string helpText(const Topic& topic) {
  std::string out = topic.page(terminalWidth()) + "\nExamples:\n";
  for (const std::string_view example : topic.examples) out += indented(example, 2);
  return out;
}

}  // namespace viewproj::cmd
