#include "records/arguments.hpp"

#include <algorithm>
#include <cmath>

#include "camera/sea_level.hpp"
#include "records/columns.hpp"
#include "text/error.hpp"
#include "text/number.hpp"
#include "viewproj/geodesy.hpp"

namespace viewproj::cmd {
namespace {

UsageError wrong(const std::string& option, const std::string& text, const std::string& message) {
  return UsageError(option + " " + text + ": " + message);
}

std::vector<double> numbersOf(const std::string& option, const std::string& text, std::size_t count,
                              const std::string& form) {
  const auto numbers = parseNumberList(text);
  if (!numbers || numbers->size() != count) throw wrong(option, text, "expected " + form);
  return *numbers;
}

/// "[1,2,3]" from three numbers, beginning at first.
std::string vectorAt(const std::vector<double>& n, std::size_t first) {
  return "[" + formatNumber(n[first]) + "," + formatNumber(n[first + 1]) + "," + formatNumber(n[first + 2]) + "]";
}

}  // namespace

PointArgument readPointArgument(const std::string& option, const std::string& text) {
  const ColumnChoice values = readValues(option, text, kPointValues);
  PointArgument point{option + " " + text, {}, values.hasRoles};
  for (const auto& value : values.picks) {
    const auto number = parseNumber(value.name);
    if (!number) throw wrong(option, text, std::string(value.role) + " is not a finite number");
    point.numbers.emplace_back(value.altitude.empty() ? std::string(value.role) : value.altitude, *number);
    point.isAltitude |= !value.altitude.empty();
  }
  return point;
}

std::string PointArgument::json() const {
  const bool hasNames = hasRoles && numbers.size() == 3;
  std::string json;
  for (const auto& [role, number] : numbers)
    json += (json.empty() ? "" : ",") + (hasNames ? "\"" + std::string(role) + "\":" : "") + formatNumber(number);
  return hasNames ? "{" + json + "}" : "[" + json + "]";
}

void PointArgument::requireFit(bool worldIsEcef) const {
  if (!hasRoles && numbers.size() == 3 && worldIsEcef)
    throw UsageError(text + ": " + bareTriple("lat=LAT,lon=LON,height=HEIGHT or x=X,y=Y,z=Z"));
  if (isPlace() && !worldIsEcef) throw UsageError(text + ": a place needs a camera on the Earth");
}

Vec4 PointArgument::point() const {
  const double a = numbers[0].second, b = numbers[1].second, c = numbers[2].second;
  if (!isPlace()) {
    const Vec4 point{a, b, c, numbers.size() > 3 ? numbers[3].second : 1};
    if (point == Vec4{0, 0, 0, 0}) throw UsageError(text + ": 0,0,0,0 is neither a point nor a direction");
    return point;
  }
  Geodetic place{a, b, c};
  if (const std::string fault = faultOf(place); !fault.empty()) throw UsageError(text + ": " + fault);
  if (isAltitude) place.height += seaLevelAt(place.lat, place.lon);
  const Vec3 p = geodeticToEcef(place);
  return {p.x, p.y, p.z, 1};
}

namespace {

const PlaneEquation& inRange(const PlaneEquation& plane, const std::string& option, const std::string& text) {
  if (!isValid(Plane{{plane.offset, 0, 0}, plane.normal})) throw wrong(option, text, "has a number beyond 1e46");
  return plane;
}

}  // namespace

PlaneEquation readPlaneArgument(const std::string& option, const std::string& text) {
  constexpr const char* kForm = "z=0, x=..., y=... or A,B,C,D of Ax + By + Cz + D = 0";
  constexpr std::string_view kAxes = "xyz";
  if (const std::size_t axis = text.empty() ? kAxes.npos : kAxes.find(text[0]); axis != kAxes.npos) {
    const auto at = text[1] == '=' ? parseNumber(text.substr(2)) : std::nullopt;
    if (!at) throw wrong(option, text, std::string("expected ") + kForm);
    PlaneEquation plane{{}, -*at};
    plane.normal[axis] = 1;
    return inRange(plane, option, text);
  }
  const std::vector<double> n = numbersOf(option, text, 4, kForm);
  const PlaneEquation plane{{n[0], n[1], n[2]}, n[3]};
  if (plane.normal == Vec3{}) throw wrong(option, text, "is not a plane; A, B and C must not all be 0");
  return inRange(plane, option, text);
}

std::string readSphereArgument(const std::string& option, const std::string& text) {
  const std::vector<double> n = numbersOf(option, text, 4, "X,Y,Z,R");
  return "{\"sphere\":{\"center\":" + vectorAt(n, 0) + ",\"radius\":" + formatNumber(n[3]) + "}}";
}

std::string readBoxArgument(const std::string& option, const std::string& text) {
  const std::vector<double> n = numbersOf(option, text, 6, "X,Y,Z,X,Y,Z, the lower and the upper corner");
  return "{\"box\":{\"min\":" + vectorAt(n, 0) + ",\"max\":" + vectorAt(n, 3) + "}}";
}

}  // namespace viewproj::cmd
