#include "input/typed_value.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "input/camera_fields.hpp"
#include "input/value_form.hpp"
#include "text/error.hpp"
#include "text/parse_number.hpp"

namespace viewproj::cmd {
namespace {

using Json = nlohmann::json;

/// So that messages show 2, and not 2.0.
Json numberAsJson(double number) {
  constexpr double kMost = 1e15;
  if (number == std::trunc(number) && std::fabs(number) < kMost && !std::signbit(number))
    return static_cast<std::int64_t>(number);
  return number;
}

[[noreturn]] void fail(const std::string& option, const std::string& text, const std::string& expected) {
  throw UsageError(option + " " + text + ": expected " + expected);
}

std::optional<double> ratioOrNumber(const std::string& text) {
  const auto ratio = ratioIn(text);
  return ratio ? ratio : parseNumber(text);
}

Json numbers(const std::string& option, const std::string& text, std::size_t count, bool notZero,
             const std::string& expected) {
  const auto parts = parseNumberList(text);
  const bool isZero = parts && std::all_of(parts->begin(), parts->end(), [](double part) { return part == 0; });
  if (!parts || parts->size() != count || (notZero && isZero)) fail(option, text, expected);
  Json list = Json::array();
  for (const double part : *parts) list.push_back(numberAsJson(part));
  return list;
}

/// x=..,y=..,z=.. or lat=..,lon=..,height=.. in any order.
Json namedNumbers(const std::string& option, const std::string& text, const std::string& expected) {
  static constexpr Field kX{"x", ValueForm::number, ""}, kY{"y", ValueForm::number, ""}, kZ{"z", ValueForm::number, ""};
  const FieldList forms[] = {field::list<kX, kY, kZ>, field::place.fields};
  for (const FieldList fields : forms) {
    Json object = Json::object();
    bool good = true;
    for (std::size_t at = 0; good && at <= text.size();) {
      const std::size_t comma = std::min(text.find(',', at), text.size());
      const std::string part = text.substr(at, comma - at);
      at = comma + 1;
      good = false;
      for (const Field* field : fields) {
        const std::string name(*field);
        if (!part.starts_with(name + "=") || object.contains(name)) continue;
        const std::string value = part.substr(name.size() + 1);
        const auto number = field->form == ValueForm::number ? parseNumber(value) : degreesIn(value, false);
        if (!number) break;
        object[name] = numberAsJson(*number);
        good = true;
      }
    }
    if (good && object.size() == fields.size()) {
      if (fields.front() == &kX) return Json::array({object["x"], object["y"], object["z"]});
      return object;
    }
  }
  fail(option, text, expected);
}

}  // namespace

nlohmann::json typedValue(ValueForm form, const std::string& option, const std::string& text, std::string_view hint) {
  constexpr const char* kPlace = "X,Y,Z or lat=LAT,lon=LON,height=HEIGHT";
  const auto good = [&](std::optional<double> number, bool (*isGood)(double), const std::string& wanted) {
    if (!number || !isGood(*number)) fail(option, text, wanted);
    return numberAsJson(*number);
  };
  const auto angle = [&](bool (*isGood)(double), const std::string& range) {
    return good(degreesIn(text, false), isGood, "an angle" + range + ", as in 60, 60deg or 1.0472rad");
  };
  switch (form) {
    case ValueForm::positive:
      return good(
          parseNumber(text), [](double n) { return n > 0; }, "a number above 0" + std::string(hint));
    case ValueForm::ratio:
      return good(
          ratioOrNumber(text), [](double n) { return n > 0 && std::isfinite(n); },
          "a ratio above 0, as in 16/9 or 1.78");
    case ValueForm::angle:
      return angle([](double degrees) { return degrees > 0 && degrees < 180; }, " between 0 and 180 degrees");
    case ValueForm::elevation:
      return angle([](double degrees) { return degrees >= -90 && degrees <= 90; }, " from -90 to 90 degrees");
    case ValueForm::turn:
      return angle([](double degrees) { return std::isfinite(degrees); }, " in degrees");
    case ValueForm::pair:
      return numbers(option, text, 2, false, "two numbers, X,Y");
    case ValueForm::direction:
      return numbers(option, text, 3, true, "X,Y,Z, not all 0");
    case ValueForm::quaternion:
      return numbers(option, text, 4, true, "X,Y,Z,W, not all 0");
    case ValueForm::position:
      if (text.find('=') != std::string::npos) return namedNumbers(option, text, kPlace);
      return numbers(option, text, 3, false, kPlace);
    default:
      break;
  }
  const auto number = parseNumber(text);
  if (!number) fail(option, text, "a number" + std::string(hint));
  return numberAsJson(*number);
}

std::string_view valueWord(ValueForm form) {
  switch (form) {
    case ValueForm::ratio:
      return "W/H";
    case ValueForm::angle:
    case ValueForm::elevation:
    case ValueForm::turn:
      return "DEGREES";
    case ValueForm::pair:
      return "X,Y";
    case ValueForm::direction:
      return "X,Y,Z";
    case ValueForm::position:
      return "X,Y,Z|lat=..,lon=..,height=..";
    case ValueForm::quaternion:
      return "X,Y,Z,W";
    default:
      return "N";
  }
}

}  // namespace viewproj::cmd
