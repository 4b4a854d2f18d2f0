// Names of matrices as names in source code.
#pragma once

#include <string>
#include <vector>

namespace viewproj::cmd {

/// A name of its own for each: `_` stands for what no language has in one, a word that one of the languages keeps for
/// itself gets a `_`, and names that would be the same get numbers. taken: names that stand there already.
std::vector<std::string> identifiersOf(const std::vector<std::string>& names, std::vector<std::string> taken);

}  // namespace viewproj::cmd
