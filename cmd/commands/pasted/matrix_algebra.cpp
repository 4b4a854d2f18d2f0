#include "commands/pasted/matrix_algebra.hpp"

#include <array>
#include <cmath>

#include "camera/plain_vectors.hpp"
#include "numbers/vectors.hpp"

namespace viewproj::cmd {

using detail::crossOf;
using detail::dot;

Vec3 rowOf(const Mat4& m, std::size_t i) { return {m[i][0], m[i][1], m[i][2]}; }
Vec3 lastColumn(const Mat4& m) { return {m[0][3], m[1][3], m[2][3]}; }
bool isDiagonal(const Mat4& m) {
  return m[0][1] == 0 && m[0][2] == 0 && m[1][0] == 0 && m[1][2] == 0 && m[2][0] == 0 && m[2][1] == 0;
}

double determinant(const Mat4& m) { return dot(rowOf(m, 0), crossOf(rowOf(m, 1), rowOf(m, 2))); }

Mat4 diagonal(double x, double y, double z, double w) {
  return {{{{x, 0, 0, 0}, {0, y, 0, 0}, {0, 0, z, 0}, {0, 0, 0, w}}}};
}

Mat4 product(const Mat4& a, const Mat4& b) {
  Mat4 result;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t k = 0; k < 4; ++k) result[i][j] += a[i][k] * b[k][j];
  return result;
}

Mat4 absolute(Mat4 m) {
  for (auto& row : m.m)
    for (double& entry : row) entry = std::fabs(entry);
  return m;
}

std::optional<Mat4> inverseOf(const Mat4& m) {
  Mat4 result;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      std::array<Vec3, 3> rows;
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t l = 0; l < 3; ++l) rows[k][l] = m[k < i ? k : k + 1][l < j ? l : l + 1];
      result[j][i] = ((i + j) % 2 == 0 ? 1 : -1) * dot(rows[0], crossOf(rows[1], rows[2]));
    }
  double volume = 0;
  for (std::size_t j = 0; j < 4; ++j) volume += m[2][j] * result[j][2];
  if (!std::isfinite(volume) || volume == 0) return std::nullopt;
  for (auto& row : result.m)
    for (double& entry : row) entry = entry / volume + 0.0;
  return result;
}

}  // namespace viewproj::cmd
