// What mends a mistake: options, or words about the pairs.
#pragma once

#include <string>
#include <vector>

#include "commands/check/judge.hpp"

namespace viewproj::cmd::mistakes {

struct Mend {
  std::vector<std::string> sets;  ///< values for --set
  bool stretch = false;           ///< they need --allow-stretch
  PixelMap pixels;                ///< what the words say of the pixels

  /// "--set projection.fovY=42.1"; empty where the document is right, or has no form for it.
  std::string options() const;
};

/// With the fewest digits that leave what the explanation leaves, within a hundredth.
Mend mendOf(const CameraFile& file, const Explanation& explanation, std::span<const Pair> pairs);

/// What a mend leaves of these pairs of a camera; nothing where it makes no camera of it.
std::optional<std::vector<Vec2>> missesWith(const CameraFile& file, const Mend& mend, Hypothesis hypothesis,
                                            std::span<const Pair> pairs);

}  // namespace viewproj::cmd::mistakes
