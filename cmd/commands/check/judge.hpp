// Which hypotheses explain the pixels: all are judged by one figure, evidence.
#pragma once

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
  std::vector<std::size_t> wrong = {};  ///< the lines of pairs that it does not explain
};

/// Of pairs that do not all agree within so many pixels: the best first, none where nothing explains them. keepsSame:
/// also mistakes that give the same pixels under another name; of another camera they may not.
std::vector<Explanation> explain(const CameraFile& file, std::span<const Pair> pairs, double within,
                                 bool keepsSame = false);

constexpr double kThreshold = 7;  ///< of evidence that is told

/// Logarithm of the ways to choose so many of all.
double logChoices(std::size_t all, std::size_t some);

/// The miss from which on a pair is wrong, where so many may be: the tolerance, and four times the rms of the others.
double wrongFrom(std::vector<double> distances, std::size_t wrong, double within);

/// Whether they leave the same misses of the given pixels; with either sign, where one of them moves the pixels and one
/// the camera.
bool isSame(const Explanation& a, const Explanation& b, bool anySign);

/// The explanation of another camera's pairs for this camera: its rows of that mistake, or the same numbers added.
std::vector<Hypothesis> madeAnew(const Hypothesis& hypothesis, const CameraFile& from, const CameraFile& to,
                                 const std::vector<Hypothesis>& rows);

}  // namespace viewproj::cmd::mistakes
