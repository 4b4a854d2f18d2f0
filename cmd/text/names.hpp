// Names: those of CSV's columns, and help with those that were mistyped.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace viewproj::cmd {

bool sameButForCase(std::string_view a, std::string_view b);

/// The candidate that takes the fewest edits from name, case and dashes in front aside; empty where that are more than
/// a third of its letters.
std::string_view nearestName(std::string_view name, std::span<const std::string_view> candidates);

/// "; did you mean 'fovY'?" or, with no near one, "; known are a, b, c"; in place of more than eight of these, where
/// page is "help camera", "; viewproj help camera lists them".
std::string suggestion(std::string_view name, std::span<const std::string_view> candidates, std::string_view page = "");

/// How a name's numbers spread over the columns of CSV: viewDistance is view_distance, screen is screen_x, screen_y.
inline constexpr std::string_view kColumnSuffixes[] = {"_x", "_y", "_z", "_w"};
std::string columnName(std::string_view name);

/// "a, b or c".
std::string alternatives(const std::vector<std::string_view>& names);
/// "a, b and c".
std::string together(const std::vector<std::string_view>& names);

/// "a, b, c".
std::string joined(std::span<const std::string_view> names, std::string_view separator = ", ");
std::string joined(const std::vector<std::string>& names, std::string_view separator = ", ");

}  // namespace viewproj::cmd
