#include "input/field_names.hpp"

#include <algorithm>
#include <cctype>

#include "text/names.hpp"
#include "text/visible.hpp"

namespace viewproj::cmd {
namespace {

/// lat, Lat, LAT, positionX: names of one set are cased alike.
struct Casing {
  bool startsUpper = false, hasUpper = false, hasLower = false;  ///< of the first letter; of those behind it
  bool operator==(const Casing&) const = default;
};

Casing casingOf(std::string_view name) {
  Casing casing;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const auto c = static_cast<unsigned char>(name[i]);
    if (i == 0) casing.startsUpper = std::isupper(c) != 0;
    if (i > 0 && std::isupper(c)) casing.hasUpper = true;
    if (i > 0 && std::islower(c)) casing.hasLower = true;
  }
  return casing;
}

/// The fields that may be a part.
struct Candidates {
  std::vector<std::size_t> named = {}, aliased = {};

  std::size_t count() const { return named.size() + aliased.size(); }
};

template <class Fits>
std::vector<std::size_t> fieldsThat(std::span<const std::string> fields, const Fits& fit) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < fields.size(); ++i)
    if (fit(fields[i])) found.push_back(i);
  return found;
}

std::vector<std::size_t> namedAs(std::span<const std::string> fields, const CoordinatePart& part) {
  const std::string column = columnName(part.name);
  return fieldsThat(fields, [&](std::string_view field) {
    return sameButForCase(field, part.name) || sameButForCase(field, column);
  });
}

std::vector<std::size_t> aliasesOf(std::span<const std::string> fields, const CoordinatePart& part) {
  return fieldsThat(fields, [&](std::string_view field) {
    return std::any_of(part.aliases.begin(), part.aliases.end(),
                       [&](std::string_view alias) { return sameButForCase(field, alias); });
  });
}

/// A name goes before an alias.
NameMatch firstOf(const Candidates& candidates) {
  const bool isAlias = candidates.named.empty();
  const auto& fields = isAlias ? candidates.aliased : candidates.named;
  return {fields.empty() ? std::nullopt : std::optional(fields[0]),
          fields.size() < 2 ? std::nullopt : std::optional(fields[1]), isAlias};
}

bool isWhole(const std::vector<NameMatch>& matches) {
  return std::all_of(matches.begin(), matches.end(), [](const NameMatch& match) { return match.field.has_value(); });
}

std::vector<NameMatch> matchExactly(std::span<const std::string> fields, std::span<const CoordinatePart> parts) {
  std::vector<NameMatch> matches(parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    auto at = std::find(fields.begin(), fields.end(), parts[i].name);
    if (at == fields.end()) at = std::find(fields.begin(), fields.end(), columnName(parts[i].name));
    if (at != fields.end()) matches[i].field = static_cast<std::size_t>(at - fields.begin());
  }
  return matches;
}

/// Where each part has a candidate: those that are cased alike, if some part has several.
std::vector<NameMatch> matchSet(std::span<const std::string> fields, const std::vector<Candidates>& candidates) {
  const bool one =
      std::all_of(candidates.begin(), candidates.end(), [](const Candidates& c) { return c.count() == 1; });
  std::vector<NameMatch> set;
  std::vector<Casing> seen;
  for (const auto* firsts : {&candidates[0].named, &candidates[0].aliased})
    for (const std::size_t first : *firsts) {
      const Casing casing = casingOf(fields[first]);
      if (one || std::find(seen.begin(), seen.end(), casing) != seen.end()) continue;
      seen.push_back(casing);
      std::vector<NameMatch> alike;
      for (Candidates some : candidates) {
        const auto isOther = [&](std::size_t field) { return casingOf(fields[field]) != casing; };
        std::erase_if(some.named, isOther);
        std::erase_if(some.aliased, isOther);
        alike.push_back(firstOf(some));
      }
      if (!isWhole(alike)) continue;
      if (set.empty())
        set = std::move(alike);
      else if (!set[0].also)
        set[0].also = alike[0].field;
    }
  if (!set.empty()) return set;
  for (const Candidates& some : candidates) {
    set.push_back(firstOf(some));
    if (!set.back().also && !some.named.empty() && !some.aliased.empty()) set.back().also = some.aliased[0];
  }
  return set;
}

/// Of the parts that are required.
std::vector<NameMatch> matchRequired(std::span<const std::string> fields, std::span<const CoordinatePart> parts,
                                     NameRule rule) {
  std::vector<NameMatch> matches = matchExactly(fields, parts);
  if (rule == NameRule::exact || isWhole(matches)) return matches;
  std::vector<Candidates> candidates(parts.size());
  const auto areWhole = [&] {
    return std::all_of(candidates.begin(), candidates.end(), [](const Candidates& c) { return c.count() > 0; });
  };
  for (std::size_t i = 0; i < parts.size(); ++i) candidates[i].named = namedAs(fields, parts[i]);
  if (areWhole()) return matchSet(fields, candidates);
  for (std::size_t i = 0; i < parts.size(); ++i) candidates[i].aliased = aliasesOf(fields, parts[i]);
  if (areWhole()) return matchSet(fields, candidates);
  for (std::size_t i = 0; i < parts.size(); ++i) matches[i] = firstOf(candidates[i]);
  return matches;
}

}  // namespace

std::vector<NameMatch> matchParts(std::span<const std::string> fields, std::span<const CoordinatePart> parts,
                                  std::size_t required, NameRule rule) {
  std::vector<NameMatch> matches = matchRequired(fields, parts.first(required), rule);
  const auto first = matches[0].field;
  for (const CoordinatePart& part : parts.subspan(required)) {
    matches.emplace_back();
    if (!first) continue;
    for (const std::size_t field : namedAs(fields, part))
      if (casingOf(fields[field]) == casingOf(fields[*first])) matches.back().field = field;
  }
  return matches;
}

std::string seaLevelNote(std::string_view name) {
  return quoted(name) +
         " is taken as height above the ellipsoid; heights above sea level differ from it by up to 107 m";
}

}  // namespace viewproj::cmd
