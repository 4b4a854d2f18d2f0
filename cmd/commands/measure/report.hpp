// A measurement as text: a table, JSON.
#pragma once

#include <string>

#include "commands/measure/measurement.hpp"

namespace viewproj::cmd {

std::string measurementAsTable(const Measurement& m);

std::string measurementAsJson(const Measurement& m, std::size_t leftOut);

}  // namespace viewproj::cmd
