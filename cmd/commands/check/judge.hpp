// Which hypotheses explain the pixels: all are judged by one figure, evidence.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "commands/check/hypothesis.hpp"

namespace viewproj::cmd::mistakes {

/// In the order in which they are sought; the later ones only where the earlier find nothing.
enum class Stage { rows, families, rest, two, flips, poses, flippedPoses, wrongPairs };

struct Explanation {
  Hypothesis hypothesis;
  Stage stage = Stage::rows;
  double rms = 0;      ///< of the components of the misses that it leaves
  double largest = 0;  ///< miss that it leaves
  double evidence = 0;
  std::vector<Vec2> misses = {};        ///< of each pair
  std::vector<std::size_t> wrong = {};  ///< pairs that it does not explain, from 0
};

/// Of pairs that do not all agree within so many pixels: the best first, none where nothing explains them.
std::vector<Explanation> explain(const Document& document, const ReadOptions& reading, std::span<const Pair> pairs,
                                 double within);

/// The explanation of another camera's pairs for this camera: a row in its forms here, or the same numbers added.
std::vector<Hypothesis> madeAnew(const Hypothesis& hypothesis, const CameraFile& from, const CameraFile& to);

/// The pairs that alone miss by more than within: at most a quarter, of four or more. Else none.
std::vector<std::size_t> wrongPairs(std::span<const Vec2> misses, double within);

/// For each pair the pair whose pixel it should have, if each has one and not all their own.
std::vector<std::size_t> pixelOrder(const Camera& camera, std::span<const Pair> pairs, double within);

}  // namespace viewproj::cmd::mistakes
