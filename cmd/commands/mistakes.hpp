// The mistakes that people make between a camera and its pixels, each as a changed camera, point or pixel. To add one:
// a row in mistakes.cpp.
#pragma once

#include <array>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "camera/document.hpp"
#include "camera/read_camera.hpp"
#include "viewproj/camera.hpp"

namespace viewproj::cmd {

/// Of a coordinate: scale * value + offset.
struct Affine {
  double scale = 1, offset = 0;
  double operator()(double value) const { return scale * value + offset; }
};

/// A mistake as it may have been made, in one of its forms.
struct Hypothesis {
  std::string_view mistake;             ///< "y-flipped"
  std::shared_ptr<const Json> value;    ///< the mistake's parameter, or null
  std::string mend;                     ///< options, or words
  Camera camera;                        ///< the mended one
  bool hasCamera = false;               ///< another than the document's
  std::array<int, 3> axes = {1, 2, 3};  ///< of a mended point, from 1; negative: the axis the other way
  Affine x = {}, y = {};                ///< the mended pixel of a given one

  Vec4 point(const Vec4& p) const;
  bool movesPoints() const { return axes != std::array{1, 2, 3}; }
};

/// What is wrong, in words.
std::string_view sentenceOf(std::string_view mistake);

/// Of a camera document that can be read. Those that need a form which it does not have are left out.
std::vector<Hypothesis> hypotheses(const Document& document, const ReadOptions& reading);

}  // namespace viewproj::cmd
