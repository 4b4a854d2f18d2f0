// Families of cameras and points at the ends of what doubles can say, as data.
#pragma once

#include <span>

#include "reference/scene.hpp"

namespace reference {

struct Family {
  const char* name;
  void (*change)(Random&, Scene&);  ///< of a plain scene
  viewproj::Vec3 (*point)(Random&, const Scene&, const viewproj::Camera&);
  double leastInPicture = 0.5;  ///< share of the points whose true pixel lies in the picture, at least
};

std::span<const Family> families();

/// A plain camera: 60 degrees, 1920x1080, looking from a random place in a random direction.
Scene plainScene(Random& random);

/// The scene of a family's trial; the point after point of the trial come from the same random numbers.
Scene sceneOf(const Family& family, Random& random);

void scaleScene(Scene& scene, double factor);

/// To a random place up to distance from the origin, where doubles still tell the target from the eye.
void moveTo(Random& random, Scene& scene, double distance);

/// up differs from the viewing direction by about angle.
void nearlyParallelUp(Random& random, Scene& scene, double angle);

}  // namespace reference
