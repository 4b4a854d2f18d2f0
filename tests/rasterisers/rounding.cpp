#include "rounding.hpp"

#include <cmath>

namespace rasterisers {
namespace {

using Vec = std::array<double, 4>;

/// A vector and a bound of its error, componentwise.
struct Inexact {
  Vec value{}, error{};
};

// Each entry of the matrix is rounded once; a dot product of four terms rounds each term at most four times, in
// whatever order it is summed and with or without fused operations.
Inexact times(const Mat& m, const Inexact& v) {
  Inexact out;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      const double magnitude = std::fabs(m[i][j] * v.value[j]);
      out.value[i] += m[i][j] * v.value[j];
      out.error[i] += std::fabs(m[i][j]) * v.error[j] + 5 * kUnit * magnitude;
    }
  return out;
}

}  // namespace

Mat fromMemory(const Matrix& memory, bool rowVectors, bool rowMajor) {
  Mat m{};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      m[i][j] = static_cast<double>(memory[rowVectors == rowMajor ? 4 * j + i : 4 * i + j]);
  return m;
}

Rounding roundingOf(const std::array<double, 3>& point, const Pipeline& p) {
  Inexact v{{point[0], point[1], point[2], 1}, {}};
  if (p.pointsRounded)
    for (std::size_t i = 0; i < 3; ++i) v.error[i] = kUnit * std::fabs(point[i]);
  if (!p.product) v = times(p.view, v);
  const Inexact clip = times(p.projection, v);
  const Vec& error = clip.error;

  // NDC is one quotient, or a reciprocal and a product: two roundings. The window is NDC * scale + offset: two more.
  const double w = clip.value[3];
  const auto window = [&](std::size_t axis, double scale, double offset) {
    const double ndc = clip.value[axis] / w;
    const double ndcError = (error[axis] + std::fabs(ndc) * error[3]) / w + 2 * kUnit * std::fabs(ndc);
    return std::fabs(scale) * ndcError + kUnit * (std::fabs(scale * ndc) + std::fabs(scale * ndc + offset));
  };
  const double near = p.depthRange[0], far = p.depthRange[1];
  const double depthScale = p.zeroToOne ? far - near : (far - near) / 2;
  const double depthOffset = p.zeroToOne ? near : (far + near) / 2;
  // The depth range is rounded as well, and so are its difference and its sum; 0 and 1 stay as they are.
  const bool plain = std::fabs(far - near) == 1;
  const double rangeError = plain ? 0 : 2 * kUnit * (std::fabs(near) + std::fabs(far));
  // What is of second order lies far below a thousandth.
  constexpr double secondOrder = 1.001;
  return {secondOrder * window(0, p.width / 2, p.x + p.width / 2),
          secondOrder * window(1, p.height / 2, p.y + p.height / 2),
          secondOrder * (window(2, depthScale, depthOffset) + rangeError), secondOrder * error[3]};
}

double storageStep(DepthFormat format) {
  if (format == DepthFormat::f32) return 0;
  return format == DepthFormat::d24 ? 1 / 16777215.0 : 1 / 65535.0;
}

}  // namespace rasterisers
