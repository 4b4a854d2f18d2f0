#include "formats/words.hpp"

#include <algorithm>
#include <cmath>

#include "camera/fields.hpp"
#include "numbers/vectors.hpp"
#include "text/number.hpp"
#include "text/pattern.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

bool isUpper(char c) { return c >= 'A' && c <= 'Z'; }
char lower(char c) { return isUpper(c) ? static_cast<char>(c - 'A' + 'a') : c; }

}  // namespace

std::vector<std::string> wordsOf(std::string_view name) {
  std::vector<std::string> words;
  char before = ' ';
  for (std::size_t i = 0; i < name.size(); ++i) {
    const char c = name[i];
    if (!isLetter(c) && !isDigit(c)) {
      before = ' ';
      continue;
    }
    const bool isNext = i + 1 < name.size() && isLetter(name[i + 1]) && !isUpper(name[i + 1]);
    const bool begins = before == ' ' || isDigit(before) != isDigit(c) || (isUpper(c) && !isUpper(before)) ||
                        (isUpper(c) && isUpper(before) && isNext);
    if (begins) words.emplace_back();
    words.back() += lower(c);
    before = c;
  }
  return words;
}

std::string lowered(std::string_view text) {
  std::string all;
  for (const char c : text) all += lower(c);
  return all;
}

bool hasWord(std::string_view name, std::string_view words) {
  const std::vector<std::string> each = wordsOf(name);
  return std::any_of(each.begin(), each.end(), [&](const std::string& word) { return isAmong(word, words); });
}

bool fitsAny(std::string_view name, std::string_view patterns) {
  const std::vector<std::string_view> all = wordsIn(patterns);
  return std::any_of(all.begin(), all.end(), [&](std::string_view pattern) { return fitsPattern(name, pattern); });
}

std::string_view quaternionOrderOf(std::string_view name) {
  const std::string letters = lettersOf(name);
  for (const std::string_view order : {"wxyz", "xyzw"})
    if (letters.find(order) != std::string::npos) return order;
  return letters.ends_with("rotationinquaternion") ? "xyzw" : "";  // of ROS, as tf2_echo prints it
}

bool areZero(std::span<const double> numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double number) { return number == 0; });
}

std::vector<double> withThirdRow(std::vector<double> m) {
  for (std::size_t i = 0; m.size() < 9 && i < 3 && m.size() >= 6; ++i)
    m.push_back(m[(i + 1) % 3] * m[3 + (i + 2) % 3] - m[(i + 2) % 3] * m[3 + (i + 1) % 3]);
  return m;
}

bool isRotation(const std::vector<double>& m) {
  if (m.size() != 9) return false;
  constexpr double kTolerance = 1e-3;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      double product = 0;
      for (std::size_t k = 0; k < 3; ++k) product += m[3 * i + k] * m[3 * j + k];
      if (!(std::fabs(product - (i == j ? 1 : 0)) < kTolerance)) return false;
    }
  return m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) + m[2] * (m[3] * m[7] - m[4] * m[6]) >
         0;
}

bool isRigid(const std::vector<double>& m) {
  if (m.size() != 12 && m.size() != 16) return false;
  if (m.size() == 16 && !(m[12] == 0 && m[13] == 0 && m[14] == 0 && std::fabs(m[15] - 1) < 1e-5)) return false;
  return isRotation({m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]});
}

bool isProjection(const std::vector<double>& m, double least) {
  if ((m.size() != 12 && m.size() != 16) || isRigid(m)) return false;
  if (m.size() == 16 && !(m[12] == 0 && m[13] == 0 && m[14] == 0 && m[15] == 1)) return false;
  const double scale = detail::hypotenuse(m[8], m[9], m[10]);
  if (!(scale > 1e-9) || !std::isfinite(scale)) return false;
  const double c[3] = {m[8] / scale, m[9] / scale, m[10] / scale};
  const auto across = [&](std::size_t row, double(&out)[3]) {
    const double a[3] = {m[row] / scale, m[row + 1] / scale, m[row + 2] / scale};
    for (std::size_t i = 0; i < 3; ++i) out[i] = a[(i + 1) % 3] * c[(i + 2) % 3] - a[(i + 2) % 3] * c[(i + 1) % 3];
    return a[0] * c[0] + a[1] * c[1] + a[2] * c[2];
  };
  double p[3], q[3];
  const double cx = across(0, p), cy = across(4, q);
  const double fx = detail::hypotenuse(p[0], p[1], p[2]), fy = detail::hypotenuse(q[0], q[1], q[2]);
  const double skew = std::fabs(p[0] * q[0] + p[1] * q[1] + p[2] * q[2]);
  return fx > least && fy > least && fx / fy > 0.1 && fx / fy < 10 && skew < 0.01 * fx * fy && cx > 0 && cy > 0;
}

bool isIntrinsic(const std::vector<double>& m) {
  if (m.size() != 9 && m.size() != 12 && m.size() != 16) return false;
  const std::size_t columns = m.size() == 9 ? 3 : 4;
  const auto at = [&](std::size_t i, std::size_t j) { return m[i * columns + j]; };
  constexpr double kLeast = 5;
  if (!(at(0, 0) > kLeast && at(1, 1) > kLeast) || at(1, 0) != 0 || at(2, 0) != 0 || at(2, 1) != 0 || at(2, 2) != 1)
    return false;
  for (std::size_t i = 0; columns == 4 && i < 3; ++i)
    if (at(i, 3) != 0) return false;
  return m.size() != 16 || (m[12] == 0 && m[13] == 0 && m[14] == 0 && m[15] == 1);
}

}  // namespace viewproj::cmd
