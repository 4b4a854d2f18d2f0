// What the readings of a matrix mean for a picture, in words.
#pragma once

#include <string>
#include <vector>

#include "input/readings/readings.hpp"

namespace viewproj::cmd {

/// What the numbers leave open, and what is seen where one reading is taken for another.
std::vector<std::string> notesOn(const std::vector<Reading>& readings);

/// A decimal number of the interval with as few digits as there is one.
std::string shortestWithin(const Estimate& estimate);

}  // namespace viewproj::cmd
