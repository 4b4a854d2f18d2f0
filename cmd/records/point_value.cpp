#include "records/point_value.hpp"

#include <functional>

#include "records/field_names.hpp"
#include "records/record.hpp"
#include "text/error.hpp"
#include "text/json_text.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

struct Members {
  std::vector<std::string> names;
  std::vector<std::string_view> values;
};

Members membersOf(std::string_view json) {
  Members members;
  JsonParts parts(json);
  while (const auto part = parts.next()) {
    members.names.push_back(unescaped(part->key));
    members.values.push_back(part->value);
  }
  return members;
}

/// Of a row's parts, all that are required; empty where one is missing.
std::vector<NameMatch> matchRow(const Members& members, const Coordinate& row) {
  auto matches = matchParts(members.names, row.parts.first(row.fewest), row.fewest, NameRule::any);
  if (!isWhole(matches, row.fewest)) matches.clear();
  return matches;
}

bool isNumberStart(std::string_view json) {
  return !json.empty() && (json[0] == '-' || (json[0] >= '0' && json[0] <= '9'));
}

}  // namespace

std::string bareTriple(const std::string& way) {
  return "three numbers without names may be a place or metres from the Earth's centre; say which: " + way;
}

bool isPointValue(std::string_view json) {
  if (json.starts_with('{')) {
    const Members members = membersOf(json);
    return !matchRow(members, coordinates::xyz).empty() || !matchRow(members, coordinates::place).empty();
  }
  if (!json.starts_with('[')) return false;
  std::size_t count = 0;
  JsonParts parts(json);
  while (const auto part = parts.next())
    if (!isNumberStart(part->value) || ++count > coordinates::position.most) return false;
  return count >= coordinates::position.fewest;
}

std::optional<PointObject> pointObject(std::string_view json) {
  const Members members = membersOf(json);
  if (const auto again = firstRepeated(members.names, std::identity()))
    throw RecordError(0, "has " + inQuotes(members.names[*again]) + " twice");
  std::vector<NameMatch> matches = matchRow(members, coordinates::xyz);
  const std::vector<NameMatch> place = matchRow(members, coordinates::place);
  if (!matches.empty() && !place.empty())
    throw RecordError(0, "has both x, y, z and lat, lon, height; expected one of the two");
  if (matches.empty() && place.empty()) return std::nullopt;
  PointObject object;
  object.isPlace = !place.empty();
  if (object.isPlace) matches = place;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const auto& [field, also] = matches[i];
    if (also)
      throw RecordError(0, "has both " + inQuotes(members.names[*field]) + " and " + inQuotes(members.names[*also]) +
                               "; expected one of the two");
    object.names[i] = (object.isPlace ? coordinates::place : coordinates::xyz).parts[i].name;
    object.parts[i] = members.values[*field];
    if (isSeaLevelName(members.names[*field])) object.seaLevel = members.names[*field];
  }
  return object;
}

}  // namespace viewproj::cmd
