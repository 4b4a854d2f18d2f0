#include "records/field_names.hpp"

#include <algorithm>

#include "text/names.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

bool isIn(Aliases names, std::string_view field) {
  return std::any_of(names.begin(), names.end(), [&](std::string_view name) { return sameButForCase(field, name); });
}

template <class Fits>
NameMatch matchIf(std::span<const std::string> fields, const Fits& fits) {
  NameMatch match;
  for (std::size_t i = 0; i < fields.size(); ++i)
    if (fits(fields[i])) (match.field ? match.also : match.field) = i;
  return match;
}

}  // namespace

bool isWhole(std::span<const NameMatch> matches, std::size_t required) {
  const auto first = matches.first(required);
  return std::all_of(first.begin(), first.end(), [](const NameMatch& match) { return match.field.has_value(); });
}

std::vector<NameMatch> matchParts(std::span<const std::string> fields, std::span<const CoordinatePart> parts,
                                  std::size_t required, NameRule rule) {
  std::vector<NameMatch> exact, any;
  for (const CoordinatePart& part : parts) {
    const std::string column = columnName(part.name);
    exact.push_back(matchIf(fields, [&](std::string_view field) { return field == part.name || field == column; }));
  }
  if (rule == NameRule::exact || isWhole(exact, required)) return exact;
  for (const CoordinatePart& part : parts) {
    const std::string column = columnName(part.name);
    const std::string_view names[] = {part.name, column};
    any.push_back(
        matchIf(fields, [&](std::string_view field) { return isIn(names, field) || isIn(part.aliases, field); }));
  }
  return any;
}

bool isSeaLevelName(std::string_view name) { return isIn(coordinates::kSeaLevelNames, name); }

std::string seaLevelNote(std::string_view name) {
  return inQuotes(name) +
         " is taken as height above the ellipsoid; heights above sea level differ from it by up to 107 m";
}

}  // namespace viewproj::cmd
