// Rays and shapes, at random and on purpose.
#pragma once

#include <span>

#include "reference/scene.hpp"
#include "reference/shapes/hit_truth.hpp"

namespace reference {

struct HitCase {
  viewproj::Ray ray;
  Shape shape;
};

struct HitFamily {
  const char* name;
  HitCase (*make)(Random&);
};

std::span<const HitFamily> hitFamilies();

}  // namespace reference
