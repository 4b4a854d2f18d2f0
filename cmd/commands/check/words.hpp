// What is wrong, in words.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "commands/check/judge.hpp"

namespace viewproj::cmd::mistakes {

struct Mistake {
  std::string_view name, meaning;
};
/// In the order of help. {}, {0} and {1} stand for the value and its parts, {1p} for one in pixels, {-} for its
/// negative.
std::span<const Mistake> allMistakes();
/// In that order; of two at once the sum.
std::size_t placeOf(std::string_view mistake);
/// Whether it is told as well where it brings all pairs within the tolerance.
bool isLongKnown(std::string_view mistake);

/// "the focal length is 1.5 times this one's, which leaves 0.28 px"
std::string sentenceOf(const CameraFile& file, const Explanation& explanation, double within);

/// "lines 5 and 9"
std::string shownLines(std::span<const std::size_t> lines);

/// "replace y by 720 - y in the pixels"; empty where the pairs are right.
std::string wordsForPairs(const Hypothesis& hypothesis, const PixelMap& pixels);

}  // namespace viewproj::cmd::mistakes
