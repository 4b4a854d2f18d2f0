// The records and the scene that a view is drawn of.
#pragma once

#include <string>
#include <vector>

#include "commands/draw/view.hpp"
#include "records/scene.hpp"
#include "stream/filter.hpp"

namespace viewproj::cmd {

/// Points, segments, boxes, triangles and spheres, each under its id, its name or its number counted from 1. Throws
/// InputError at the first bad one, or with setup.keepGoing leaves it out and returns the exit status 1.
int addRecords(View& view, const Frustum& frustum, const FilterSetup& setup, bool worldIsEcef);

/// Planes have no outline, which is noted.
void addScene(View& view, const Frustum& frustum, const std::vector<SceneObject>& scene);

/// A pixel, and with a scene the nearest hit of its ray.
void addPixel(View& view, const Vec2& screen, const std::vector<SceneObject>* scene);

}  // namespace viewproj::cmd
