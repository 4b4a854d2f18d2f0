#include "input/field_names.hpp"

#include <algorithm>

#include "text/names.hpp"
#include "text/visible.hpp"

namespace viewproj::cmd {

NameMatch matchName(std::span<const std::string> fields, std::string_view name, std::string_view columnName,
                    Aliases aliases, NameRule rule) {
  NameMatch found;
  const auto first = [&](std::string_view exact) {
    const auto at = std::find(fields.begin(), fields.end(), exact);
    if (at != fields.end()) found.field = static_cast<std::size_t>(at - fields.begin());
    return found.isExact = found.field.has_value();
  };
  if (first(name) || (columnName != name && first(columnName)) || rule == NameRule::exact) return found;
  const auto search = [&](const auto& fits) {
    for (std::size_t i = 0; i < fields.size() && !found.also; ++i)
      if (fits(fields[i])) (found.field ? found.also : found.field) = i;
    return found.field.has_value();
  };
  if (search([&](std::string_view field) { return sameButForCase(field, name) || sameButForCase(field, columnName); }))
    return found;
  found.isAlias = search([&](std::string_view field) {
    return std::any_of(aliases.begin(), aliases.end(),
                       [&](std::string_view alias) { return sameButForCase(field, alias); });
  });
  return found;
}

std::vector<NameMatch> matchParts(std::span<const std::string> fields, std::span<const CoordinatePart> parts,
                                  std::size_t required, NameRule rule) {
  std::vector<NameMatch> matches;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const CoordinatePart& part = parts[i];
    matches.push_back(matchName(fields, part.name, columnName(part.name), part.aliases, rule));
    const NameMatch& match = matches.back();
    if (i < required || !match.field || match.isExact == matches.front().isExact) continue;
    matches.back().field.reset();
  }
  return matches;
}

std::string seaLevelNote(std::string_view name) {
  return quoted(name) +
         " is taken as height above the ellipsoid; heights above sea level differ from it by up to 107 m";
}

}  // namespace viewproj::cmd
