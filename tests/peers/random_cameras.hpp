// Moderate random cameras and points, for peers that work in double: each from one seed, magnitudes log-uniform.
#pragma once

#include <cmath>
#include <vector>

#include "measure.hpp"
#include "random.hpp"
#include "viewproj/viewproj.hpp"

namespace peers {

/// What lookAt takes. upSine: of the angle between up and the viewing direction, at least 0.1.
struct View {
  viewproj::Vec3 eye, target, up;
  double upSine = 1;
};

inline View randomView(Random& random, double largestEye = 1e4) {
  View v;
  v.eye = random.direction(random.logUniform(0.1, largestEye));
  const viewproj::Vec3 d = random.direction(random.logUniform(0.1, 1e3));
  v.target = {v.eye.x + d.x, v.eye.y + d.y, v.eye.z + d.z};
  do {
    v.up = random.direction(random.logUniform(0.01, 100));
    v.upSine = length(cross(d, v.up)) / (length(d) * length(v.up));
  } while (v.upSine < 0.1);
  return v;
}

inline viewproj::Pose poseOf(const View& v, viewproj::Handedness world) {
  return viewproj::lookAt(v.eye, v.target, v.up, world);
}

/// What glFrustum and glOrtho take.
struct Window {
  bool orthographic = false;
  double left = -1, right = 1, bottom = -1, top = 1, near = 1, far = 2;
};

inline viewproj::Projection projectionOf(const Window& w) {
  return w.orthographic ? viewproj::orthographic(w.left, w.right, w.bottom, w.top, w.near, w.far)
                        : viewproj::frustum(w.left, w.right, w.bottom, w.top, w.near, w.far);
}

enum class Shape { symmetric, offCentre, orthographic };

inline Window randomWindow(Random& random, Shape shape, bool infiniteFar = false) {
  Window w;
  w.orthographic = shape == Shape::orthographic;
  w.near = w.orthographic ? random.uniform(-100, 100) : random.logUniform(1e-3, 10);
  w.far = infiniteFar      ? viewproj::kInfiniteFar
          : w.orthographic ? w.near + random.logUniform(0.1, 1e4)
                           : w.near * random.logUniform(2, 1e6);
  const double halfWidth = w.orthographic ? random.logUniform(0.1, 1e3) : w.near * random.logUniform(0.1, 5);
  const double halfHeight = halfWidth * random.logUniform(0.3, 3);
  const double x = shape == Shape::symmetric ? 0 : halfWidth * random.uniform(-1.5, 1.5);
  const double y = shape == Shape::symmetric ? 0 : halfHeight * random.uniform(-1.5, 1.5);
  w.left = x - halfWidth;
  w.right = x + halfWidth;
  w.bottom = y - halfHeight;
  w.top = y + halfHeight;
  return w;
}

/// Every preset, with depth forward and reversed.
inline std::vector<viewproj::Convention> everyConvention() {
  std::vector<viewproj::Convention> all;
  for (const viewproj::ConventionPreset& p : viewproj::conventionPresets())
    for (bool reverseZ : {false, true}) {
      all.push_back(p.convention);
      all.back().reverseZ = reverseZ;
    }
  return all;
}

}  // namespace peers
