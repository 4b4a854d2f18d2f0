// An explanation in words: what is wrong, and what mends it.
#pragma once

#include <string>

#include "commands/check/judge.hpp"

namespace viewproj::cmd::mistakes {

struct Mend {
  std::vector<Set> sets;  ///< fields of the document
  std::string options;    ///< "--set projection.fovY=42.1"; empty where the document is right, or cannot say it
  std::string pairs;      ///< "replace y by 720 - y in the pixels"; empty where they are right
};

/// With the fewest digits that leave what the explanation leaves, within a hundredth.
Mend mendOf(const CameraFile& file, const Explanation& explanation, std::span<const Pair> pairs);

/// "the focal length is 1.5 times this one's, which leaves 0.28 px"
std::string sentenceOf(const Explanation& explanation, double within);

/// What is wrong in a mistake, in a line. Empty where there is no such mistake.
std::string_view meaningOf(std::string_view mistake);
/// All mistakes, in the order of help.
std::vector<std::string_view> allMistakes();

}  // namespace viewproj::cmd::mistakes
