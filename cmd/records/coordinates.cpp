#include "records/coordinates.hpp"

#include <algorithm>

#include "text/names.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

namespace all = coordinates;

constexpr const Coordinate* kAll[] = {&all::position, &all::xyz,         &all::place, &all::map,      &all::direction,
                                      &all::segment,  &all::sphere,      &all::box,   &all::triangle, &all::radius,
                                      &all::screen,   &all::pixel,       &all::xy,    &all::uv,       &all::pxPy,
                                      &all::depth,    &all::viewDistance};

bool isAmong(Aliases names, std::string_view field) {
  return std::any_of(names.begin(), names.end(), [&](std::string_view name) { return sameButForCase(field, name); });
}

}  // namespace

std::span<const Coordinate* const> allCoordinates() { return kAll; }

std::vector<std::string> columnsOf(const Coordinate& row) {
  std::vector<std::string> names;
  const auto add = [&](std::string_view name, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i)
      names.push_back(columnName(name) + std::string(size > 1 ? kColumnSuffixes[i] : ""));
  };
  if (row.form == CoordinateForm::array) add(row.name, row.most);
  for (const CoordinatePart& part : row.parts) add(part.name, part.size);
  return names;
}

std::string exampleOf(const Coordinate& row) {
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  if (row.form == CoordinateForm::object) {
    for (const CoordinatePart& part : row.parts)
      add("\"" + std::string(part.name) + "\": " + (part.size > 1 ? "[x, y, z]" : "r"));
    return "{" + text + "}";
  }
  for (std::size_t i = 0; i < row.fewest; ++i) add("[x, y, z]");
  return "[" + text + "]";
}

std::string namesOf(std::span<const Coordinate* const> rows, std::string_view last) {
  std::string text;
  for (std::size_t i = 0; i < rows.size(); ++i)
    text += (i == 0 ? "" : i + 1 == rows.size() ? std::string(last) : ", ") + std::string(rows[i]->name);
  return text;
}

bool hasName(std::string_view field, const CoordinatePart& part) {
  return sameButForCase(field, part.name) ||
         (field.size() > part.name.size() && sameButForCase(field, columnName(part.name)));
}

bool isNamed(std::string_view field, const CoordinatePart& part) {
  return hasName(field, part) || isAmong(part.aliases, field);
}

std::vector<PartMatch> matchParts(std::span<const std::string> fields, std::span<const CoordinatePart> parts) {
  std::vector<PartMatch> matches(parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (const auto fits : {hasName, isNamed}) {
      if (matches[i].field) break;
      for (std::size_t field = 0; field < fields.size(); ++field)
        if (fits(fields[field], parts[i])) (matches[i].field ? matches[i].also : matches[i].field) = field;
    }
  return matches;
}

bool isWhole(std::span<const PartMatch> matches) {
  return std::all_of(matches.begin(), matches.end(), [](const PartMatch& match) { return match.field.has_value(); });
}

}  // namespace viewproj::cmd
