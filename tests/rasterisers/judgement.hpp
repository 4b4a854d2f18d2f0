// One camera's points: what the tool expects, and what a rasteriser makes of them.
#pragma once

#include <string>
#include <vector>

#include "cameras.hpp"
#include "rasteriser.hpp"
#include "rounding.hpp"

namespace rasterisers {

struct Point {
  std::array<double, 3> position;
  Vertex vertex;  ///< what is drawn of it
  bool visible = false;
  double screen[2] = {0, 0};
  double depth = 0, viewDistance = 0;
  std::vector<std::string> outside;
  Rounding rounding;
  int column = 0, row = 0;  ///< its pixel, from the framebuffer's upper left corner; where visible
};

struct Scene {
  CameraCase camera;
  Draw draw;                  ///< but for the points
  bool upsideDown = false;    ///< the picture's first row in memory is its lowest
  std::vector<Point> points;  ///< that are judged
  int besideBorder = 0;       ///< points left out: within 1/256 pixel of their pixel's border
  int besideBoundary =
      0;  ///< points left out: within 1/256 pixel, or what float32 leaves open, of being clipped or not
};

/// Asks the tool. The points are random, by the camera's index.
Scene prepare(const CameraCase& camera);

struct Judgement {
  int visible = 0;
  int misplaced = 0, wronglyDeep = 0;  ///< of the visible
  int appeared = 0;                    ///< of the clipped
  double worstPixels = 0;              ///< what float32 may move a point by, the largest
  std::vector<std::string> words;      ///< about the first disagreements

  int disagreements() const { return misplaced + wronglyDeep + appeared; }
};

/// Draws the scene.
Judgement judge(const Scene& scene);

}  // namespace rasterisers
