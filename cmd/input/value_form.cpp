#include "input/value_form.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "numbers/double_double.hpp"
#include "text/parse_number.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

/// 180 / pi in double-double.
constexpr DoubleDouble kDegreesOfRadian{57.29577951308232, -1.9878495670576283e-15};

bool isAngle(ValueForm form) {
  return form == ValueForm::angle || form == ValueForm::elevation || form == ValueForm::turn ||
         form == ValueForm::turns;
}

constexpr std::array<const char*, 4> kCoordinates = {"x", "y", "z", "w"};

}  // namespace

std::optional<double> degreesIn(std::string_view text, bool needsUnit) {
  for (const std::string_view unit : {"deg", "\xC2\xB0"})
    if (text.ends_with(unit)) return parseNumber(text.substr(0, text.size() - unit.size()));
  if (text.ends_with("rad")) {
    const auto radians = parseNumber(text.substr(0, text.size() - 3));
    if (!radians) return std::nullopt;
    return (DoubleDouble(*radians) * kDegreesOfRadian).hi;
  }
  return needsUnit ? std::nullopt : parseNumber(text);
}

std::optional<double> ratioIn(std::string_view text) {
  const std::size_t slash = text.find('/');
  if (slash == std::string_view::npos) return std::nullopt;
  const auto over = parseNumber(text.substr(0, slash)), under = parseNumber(text.substr(slash + 1));
  if (!over || !under || *under == 0) return std::nullopt;
  return *over / *under;
}

std::optional<double> numberIn(const nlohmann::json& value, ValueForm form) {
  if (value.is_number()) return value.get<double>();
  if (!value.is_string()) return std::nullopt;
  const std::string_view text = value.get_ref<const std::string&>();
  if (isAngle(form)) return degreesIn(text, true);
  if (form == ValueForm::ratio) return ratioIn(text);
  return std::nullopt;
}

std::string expectedNumber(ValueForm form) {
  if (isAngle(form)) return "a number of degrees, \"60deg\" or \"1.0472rad\"";
  if (form == ValueForm::ratio) return "a number or \"16/9\"";
  return "a number";
}

bool hasCoordinates(const nlohmann::json& value) { return value.is_object() && value.contains(kCoordinates[0]); }

std::optional<std::vector<double>> coordinatesIn(const nlohmann::json& value, std::size_t fewest, std::size_t most,
                                                 ValueForm form) {
  if (value.size() < fewest || value.size() > most) return std::nullopt;
  std::vector<double> numbers;
  if (value.is_array()) {
    for (const nlohmann::json& part : value) {
      const auto number = numberIn(part, form);
      if (!number) return std::nullopt;
      numbers.push_back(*number);
    }
    return numbers;
  }
  if (!value.is_object() || value.size() > kCoordinates.size()) return std::nullopt;
  for (std::size_t i = 0; i < value.size(); ++i) {
    const auto part = value.find(kCoordinates[i]);
    if (part == value.end() || !part->is_number()) return std::nullopt;
    numbers.push_back(part->get<double>());
  }
  return numbers;
}

bool fits(const nlohmann::json& value, const Field& field) {
  const std::size_t count = field.form == ValueForm::quaternion ? 4 : 3;
  if (coordinatesIn(value, count, count)) return true;
  return field.form == ValueForm::position && value.is_object() && !value.empty() &&
         field.object->has(value.begin().key());
}

}  // namespace viewproj::cmd
