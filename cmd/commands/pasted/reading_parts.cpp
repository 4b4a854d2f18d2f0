// Arithmetic of pasted matrices: their parts and products, and what the digits of their entries leave open.
#include "commands/pasted/reading_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string_view>

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

namespace {

struct Digits {
  int significant = 0, decimals = 0, last = 0;  ///< last: the power of ten of the last one
  bool hasPoint = false, hasExponent = false, keepsZero = false;
};

Digits digitsOf(std::string_view text) {
  Digits d;
  const std::size_t exponent = text.find_first_of("eE");
  d.hasExponent = exponent != std::string_view::npos;
  const std::string_view mantissa = text.substr(0, exponent);
  const std::size_t point = mantissa.find('.');
  d.hasPoint = point != std::string_view::npos;
  const std::string_view decimals = d.hasPoint ? mantissa.substr(point + 1) : std::string_view();
  d.decimals = static_cast<int>(decimals.size());
  d.keepsZero = d.decimals > 1 && mantissa.ends_with('0');
  for (const char c : decimals == "0" ? mantissa.substr(0, point) : mantissa)  // the 0 of 23.0 is no digit of a %g
    if (c >= '0' && c <= '9' && (d.significant > 0 || c != '0')) ++d.significant;
  d.last = (d.hasExponent ? std::atoi(std::string(text.substr(exponent + 1)).c_str()) : 0) - d.decimals;
  return d;
}

}  // namespace

std::vector<double> printedErrors(std::span<const PrintedNumber> numbers) {
  constexpr int kFewest = 3;  // nobody prints fewer significant digits
  int mostDecimals = 0, mostDigits = kFewest;
  bool haveExponents = false, keepZero = false;
  std::set<int> decimals;
  for (const PrintedNumber& n : numbers) {
    const Digits d = digitsOf(n.text);
    haveExponents = haveExponents || d.hasExponent;
    if (!d.hasExponent) mostDecimals = std::max(mostDecimals, d.decimals);
    if (n.value != 0) mostDigits = std::max(mostDigits, d.significant);
    if (d.decimals > 0) decimals.insert(d.decimals);
    keepZero = keepZero || d.keepsZero;
  }
  const bool areTyped = !haveExponents && decimals.size() > 1 && keepZero;
  const double finest = std::pow(10.0, -mostDecimals);
  std::vector<double> errors;
  for (const PrintedNumber& n : numbers) {
    const Digits d = digitsOf(n.text);
    double unit = 0;
    if (haveExponents || mostDecimals > 0) {
      const bool isCutZero = !haveExponents && d.hasPoint && (d.decimals == 0 || d.decimals == mostDecimals);
      if (n.value == 0)
        unit = isCutZero ? finest : 0;
      else if (areTyped && d.decimals > 0)
        unit = std::pow(10.0, d.last);
      else
        unit = std::max(std::pow(10.0, std::floor(std::log10(std::fabs(n.value))) - mostDigits + 1),
                        haveExponents ? 0 : finest);
    }
    errors.push_back(std::isfinite(n.value) ? unit / 2 : 0);
  }
  return errors;
}

bool areFloats(std::span<const PrintedNumber> numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](const PrintedNumber& n) {
    const double away = std::fabs(double{static_cast<float>(n.value)} - n.value);
    return n.value == 0 || away <= 0.5 * std::pow(10.0, digitsOf(n.text).last) + 0x1p-52 * std::fabs(n.value);
  });
}

void addRounding(Mat4& errors, const Mat4& m, bool isFloat, const Vec3& eye) {
  const double unit = 3 * (isFloat ? 0x1p-24 : 0x1p-53);
  for (std::size_t i = 0; i < 4; ++i) {
    const double ofEye = std::fabs(m[i][0] * eye.x) + std::fabs(m[i][1] * eye.y) + std::fabs(m[i][2] * eye.z);
    for (std::size_t j = 0; j < 4; ++j)
      if (m[i][j] != 0 || errors[i][j] != 0)
        errors[i][j] += unit * (j < 3 ? detail::hypotenuse(m[i][0], m[i][1], m[i][2]) : std::fabs(m[i][3]) + ofEye);
  }
}

}  // namespace viewproj::cmd
