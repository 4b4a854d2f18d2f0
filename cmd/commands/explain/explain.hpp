// A point's way to its pixel, and a pixel's way back, each number with what it is made of.
#pragma once

#include <optional>

#include "commands/explain/explanation.hpp"
#include "viewproj/camera.hpp"

namespace viewproj::cmd {

/// local: the point before the model matrix, if there is one. Ends in what `project` gives for the world point. Throws
/// InputError where the model takes the point out of the range of doubles.
Explanation explainPoint(const Camera& camera, const Convention& writing, const Vec4& local,
                         const std::optional<Mat4>& model);

/// Ends in what `ray` gives. Throws InputError for a depth beyond infinity.
Explanation explainPixel(const Camera& camera, const Convention& writing, const Vec2& pixel,
                         std::optional<double> depth);

/// digits: significant digits of every number; 17 for all.
std::string explanationAsTable(const Explanation& explanation, int digits);
std::string explanationAsJson(const Explanation& explanation, int digits);

/// The part of both ways that tells what the file said: eye, window edges, near and far.
void explainCamera(Explanation& explanation, const Camera& camera);

}  // namespace viewproj::cmd
