// Names: the columns of CSV, and suggestions for mistyped names.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace viewproj::cmd {

bool sameButForCase(std::string_view a, std::string_view b);
/// The letters and digits of a name, in lower case: image_width and ImageWidth are imagewidth.
std::string lettersOf(std::string_view name);

/// The candidate with the fewest edits from name, ignoring case and leading dashes. Empty if these are more than a
/// third of its letters.
std::string_view nearestName(std::string_view name, std::span<const std::string_view> candidates);

/// "; did you mean 'fovY'?", or without a near name "; known are a, b, c". If there are more than eight and page is
/// "help camera": "; viewproj help camera lists them".
std::string suggestion(std::string_view name, std::span<const std::string_view> candidates, std::string_view page = "");

/// CSV columns of a name with several numbers: viewDistance is view_distance, screen is screen_x and screen_y.
inline constexpr std::string_view kColumnSuffixes[] = {"_x", "_y", "_z", "_w"};
std::string columnName(std::string_view name);

/// "a, b or c".
std::string alternatives(const std::vector<std::string_view>& names);
/// "a, b and c".
std::string together(const std::vector<std::string_view>& names);

/// "a, b, c".
std::string joined(std::span<const std::string_view> names, std::string_view separator = ", ");
std::string joined(const std::vector<std::string>& names, std::string_view separator = ", ");
/// The parts between any of the separators, without empty ones.
std::vector<std::string_view> partsOf(std::string_view text, std::string_view separators);
/// The parts between separators.
std::vector<std::string_view> split(std::string_view text, std::string_view separator);
/// Whether a text is one of words separated by blanks.
bool isAmong(std::string_view word, std::string_view words);
/// A word of a command line, in quotes where a shell would change it.
std::string inShell(const std::string& word);
/// "a, b, c and 7 more".
std::string someOf(const std::vector<std::string>& names, std::size_t most);

}  // namespace viewproj::cmd
