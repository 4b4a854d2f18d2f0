// Points and the pixels that somebody has for them, compared with what the camera says.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "camera/read_camera.hpp"
#include "numbers/double_double.hpp"
#include "output/report.hpp"

namespace viewproj::cmd {

/// Of a coordinate: scale * value + offset.
struct Affine {
  double scale = 1, offset = 0;
  double operator()(double value) const { return scale * value + offset; }
};

/// A mistake that people make between a camera and its pixels, in one of its forms, as a changed camera, point or
/// pixel. To add one: a row in mistakes.cpp.
struct Hypothesis {
  std::string_view mistake;             ///< "y-flipped"
  std::shared_ptr<const Json> value;    ///< the mistake's parameter, or null
  std::string mend;                     ///< options, or words
  Camera camera;                        ///< the mended one
  bool hasCamera = false;               ///< another than the document's
  std::array<int, 3> axes = {1, 2, 3};  ///< of a mended point, from 1; negative: the axis the other way
  Affine x = {}, y = {};                ///< the mended pixel of a given one
  int distortions = 0;                  ///< how often the lens then bends it; negative: unbends it

  Vec4 point(const Vec4& p) const;
  /// NaN where the lens has none.
  Vec2 pixel(const Vec2& given) const;
  bool movesPoints() const { return axes != std::array{1, 2, 3}; }
};

/// What is wrong, in words.
std::string_view sentenceOf(std::string_view mistake);

/// Of a camera document that can be read. Those that need a form which it does not have are left out.
std::vector<Hypothesis> hypotheses(const Document& document, const ReadOptions& reading);

/// Takes pairs one by one; its size does not grow with them.
class PairCheck {
 public:
  /// within: the largest miss, in pixels, that still agrees.
  PairCheck(const Camera& camera, std::vector<Hypothesis> hypotheses, double within);

  /// line: of the record.
  void add(const Vec4& point, const Vec2& pixel, std::size_t line);

  bool agrees() const { return noPixel_ == 0 && misses_.largest <= within_; }
  std::size_t records() const { return records_; }
  /// Agreement, misses, explanations and fit. All members are always there; what has no value is null.
  OrderedJson report() const;

 private:
  struct Misses {
    double largest = 0, sum = 0;
    std::size_t worst = 0;  ///< line of the largest
    void add(double miss, std::size_t line);
  };
  struct Trial {
    Hypothesis hypothesis;
    Misses misses;
  };
  /// Of one axis: sums over the pairs that have a pixel, of computed and given positions from the first pair's.
  struct AxisSums {
    detail::DoubleDouble computed, given, computedSquared, givenSquared, product;
  };

  OrderedJson explanations() const;
  OrderedJson fit() const;

  Camera camera_;
  double within_;
  std::size_t records_ = 0, noPixel_ = 0;
  Misses misses_;
  std::vector<Trial> trials_;  ///< those that every pair so far agrees with
  std::array<AxisSums, 2> sums_;
  std::array<double, 2> origin_{};
};

}  // namespace viewproj::cmd
