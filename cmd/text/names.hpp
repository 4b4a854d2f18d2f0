// Helping with names that were mistyped.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace viewproj::cmd {

/// The candidate that takes the fewest edits from name, case aside; empty if none is near.
std::string_view nearestName(std::string_view name, std::span<const std::string_view> candidates);

/// "; did you mean 'fovY'?" or, with no near one, "; known are a, b, c".
std::string suggestion(std::string_view name, std::span<const std::string_view> candidates);

/// "a, b, c".
std::string joined(std::span<const std::string_view> names, std::string_view separator = ", ");

}  // namespace viewproj::cmd
