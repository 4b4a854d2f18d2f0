// A measurement as text: a table, JSON.
#pragma once

#include <span>
#include <string>

#include "commands/measure/measurement.hpp"

namespace viewproj::cmd {

std::string measurementAsTable(const Measurement& m);

/// notes: what standard error says of this run.
std::string measurementAsJson(const Measurement& m, std::size_t leftOut, std::span<const std::string> notes);

}  // namespace viewproj::cmd
