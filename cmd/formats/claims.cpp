#include "formats/claims.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "formats/value.hpp"
#include "formats/words.hpp"
#include "text/names.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {
namespace {

std::size_t countIn(std::string_view digits) {
  std::size_t count = 0;
  for (const char digit : digits) count = 10 * count + static_cast<std::size_t>(digit - '0');
  return count;
}

constexpr double kLeastPixels = 20;

bool isFocal(const std::vector<double>& n) {
  return n.size() >= 4 && n[0] > kLeastPixels && n[1] > kLeastPixels && n[2] > 0 && n[3] > 0 && !isIntrinsic(n);
}

bool isLost(const std::vector<double>& m) {
  return std::any_of(m.begin(), m.end(), [](double number) { return !std::isfinite(number); });
}

bool isTimedPose(const std::vector<double>& n) {
  constexpr double kTolerance = 2e-3;
  return n.size() == 8 &&
         (isLost(n) || std::fabs(n[4] * n[4] + n[5] * n[5] + n[6] * n[6] + n[7] * n[7] - 1) < kTolerance);
}

bool isPose(const std::vector<double>& m) {
  return isRigid(m) || ((m.size() == 12 || m.size() == 16) && isLost(m) && !isIntrinsic(m));
}

/// Rows of a kind. Some rows, but not all, may be of poses that are lost.
bool areRows(const Json& value, bool (*isOne)(const std::vector<double>&)) {
  if (!value.is_array() || value.empty()) return false;
  std::size_t count = 0;
  for (const Json& row : value) {
    const auto numbers = row.is_array() ? numbersIn(row) : std::nullopt;
    if (!numbers || (count != 0 && numbers->size() != count)) return false;
    count = numbers->size();
  }
  for (const Json& row : value)
    if (const auto numbers = numbersIn(row); !isLost(*numbers)) return isOne(*numbers);
  return false;
}

bool hasShape(const Json& value, std::string_view shape) {
  if (shape == "list") return value.is_array();
  if (shape == "object") return value.is_object();
  if (shape == "alone") return value.is_object() && value.size() == 1;
  if (shape == "two") return value.is_object() && value.size() == 2;
  if (shape == "few") return value.is_object() && value.size() <= 3;
  if (shape == "text") return value.is_string();
  if (shape == "PN")
    return value.is_array() && value.size() > 1 &&
           std::all_of(value.begin(), value.end(), [](const Json& row) { return hasShape(row, "P"); });
  if (shape == "MN") return areRows(value, isPose);
  if (shape == "QN") return areRows(value, isTimedPose);
  const auto numbers = numbersIn(value);
  if (!numbers || numbers->empty()) return false;
  if (shape == "xyzw") return contentOf(value).is_object() && numbers->size() == 4;
  const std::vector<std::size_t> dimensions = shapeOf(value);
  if (shape == "P") return isProjection(*numbers, kLeastPixels) && !(numbers->size() == 16 && isIntrinsic(*numbers));
  if (shape == "K") return isIntrinsic(*numbers);
  if (shape == "M") return (dimensions.size() == 1 || dimensions[1] == 4) && isPose(*numbers);
  if (shape == "Q") return dimensions.size() == 1 && isTimedPose(*numbers);
  const std::size_t count = countIn(shape.substr(shape.find_first_of("0123456789")));
  if (shape[0] == 'K') return dimensions == std::vector{count, count} && isIntrinsic(*numbers);
  if (shape[0] == 'L') return dimensions.size() == 1 && numbers->size() == count;
  if (shape[0] == 'F') return dimensions.size() == 1 && numbers->size() == count && isFocal(*numbers);
  if (shape[0] == 'N') return value.is_array() && !value.empty() && numbers->size() == value.size() * count;
  if (const std::size_t by = shape.find('x'); by != std::string_view::npos)
    return dimensions == std::vector{countIn(shape.substr(0, by)), countIn(shape.substr(by + 1))};
  return numbers->size() == count;
}

bool fits(const Node& node, std::string_view text, std::string_view shapes) {
  if (!text.empty() && !(node.json().is_string() && sameButForCase(node.json().get_ref<const std::string&>(), text)))
    return false;
  const std::vector<std::string_view> all = partsOf(shapes, "/");
  return all.empty() ||
         std::any_of(all.begin(), all.end(), [&](std::string_view shape) { return hasShape(node.json(), shape); });
}

bool holdsChoice(const Node& root, std::string_view choice, std::string_view container) {
  const std::size_t colon = choice.find(':');
  const std::string_view shapes = colon == std::string_view::npos ? "" : choice.substr(colon + 1);
  std::string_view path = choice.substr(0, colon);
  const std::size_t equals = path.find('=');
  const std::string_view text = equals == std::string_view::npos ? "" : path.substr(equals + 1);
  path = path.substr(0, equals);
  const std::string whole = path.starts_with('/') ? std::string(path.substr(1))
                            : path.empty()        ? std::string(container)
                                                  : joinedPath(container, path);
  if (whole.find('*') == std::string::npos) {
    const auto node = valueAt(root, whole);
    return node && fits(*node, text, shapes);
  }
  bool any = false;
  eachStar(root, whole, [&](std::string_view star) {
    const auto node = valueAt(root, withStar(whole, star));
    any = node && fits(*node, text, shapes);
    return !any;
  });
  return any;
}

}  // namespace

bool holds(const Node& root, std::string_view conditions, std::string_view container) {
  const std::vector<std::string_view> all = partsOf(conditions, " ");
  return std::all_of(all.begin(), all.end(), [&](std::string_view condition) {
    const bool isExcluded = condition.starts_with('!');
    const std::vector<std::string_view> choices = partsOf(condition.substr(isExcluded ? 1 : 0), "|");
    return isExcluded != std::any_of(choices.begin(), choices.end(),
                                     [&](std::string_view choice) { return holdsChoice(root, choice, container); });
  });
}

}  // namespace viewproj::cmd
