#include "records/coordinate_fields.hpp"

#include <algorithm>

#include "text/error.hpp"
#include "text/names.hpp"

namespace viewproj::cmd {
namespace {

RecordError twoAsGood(const RecordParts& record, std::size_t one, std::size_t other, std::string_view part) {
  const auto& names = record.shape.names;
  return {record.shape.form == Form::csv ? 0 : record.offset(other),
          "has both " + inQuotes(names[one]) + " and " + inQuotes(names[other]) + " for " + std::string(part) +
              "; --columns says which, as in " + std::string(part) + "=" + visible(names[one])};
}

/// A column or field each; nothing where one that is required is missing.
std::optional<Layout> findEach(const RecordParts& record, std::span<const CoordinatePart> parts, std::size_t required,
                               bool orNull, NameRule rule) {
  const auto& names = record.shape.names;
  const std::vector<NameMatch> matches = matchParts(names, parts, required, rule);
  if (!isWhole(matches, required)) return std::nullopt;
  Layout layout;
  for (std::size_t i = 0; i < parts.size() && matches[i].field; ++i) {
    const auto& [field, also] = matches[i];
    if (also) throw twoAsGood(record, *field, *also, parts[i].name);
    if (isSeaLevelName(names[*field])) layout.notes.push_back(seaLevelNote(names[*field]));
    layout.parts.push_back({*field, 1, 1, false, orNull});
  }
  return layout;
}

/// In CSV. Those of an array are NAME_x, NAME_y, ..., where NAME may be an alias.
std::optional<Layout> findColumns(const Coordinate& row, const RecordParts& record, NameRule rule) {
  std::optional<Layout> found;
  const auto search = [&](const std::vector<std::string>& names) {
    std::vector<CoordinatePart> parts;
    for (const std::string& name : names) parts.push_back({name});
    auto layout = findEach(record, parts, row.fewest, row.orNull, rule);
    if (layout && found)
      throw RecordError(0, "has both " + namesIn(*found, record.shape) + " and " + namesIn(*layout, record.shape) +
                               "; --columns says which, as in --columns " + namesIn(*found, record.shape));
    if (layout) found = std::move(layout);
  };
  const std::vector<std::string> names = columnsOf(row);
  if (!names.empty()) search(names);
  if (rule == NameRule::exact) return found;
  for (const std::string_view alias : row.aliases) {
    std::vector<std::string> columns;
    for (std::size_t i = 0; i < row.most; ++i) columns.push_back(std::string(alias) + std::string(kColumnSuffixes[i]));
    search(columns);
  }
  return found;
}

/// A field of JSON with a point: of the row's own name whatever its value; else where that has the form.
std::optional<Layout> findArray(const Coordinate& row, const RecordParts& record, std::vector<FormOfField>& forms,
                                NameRule rule) {
  const PointForm point = row.most < 3                ? PointForm::none
                          : row.kind == kindDirection ? PointForm::vector
                                                      : PointForm::point;
  const auto layoutOf = [&](std::size_t field) {
    return Layout{{{field, row.fewest, row.most, true, row.orNull, {}, 0, 0, point}}};
  };
  if (const auto own = record.shape.find(row.name)) return layoutOf(*own);
  if (rule == NameRule::exact) return std::nullopt;
  const auto& names = record.shape.names;
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto is = [&](std::string_view name) { return sameButForCase(names[i], name); };
    if (!is(row.name) && std::none_of(row.aliases.begin(), row.aliases.end(), is)) continue;
    forms.push_back({i, point == PointForm::none ? '[' : FormOfField::kPoint});
    forms.back().is = forms.back().holds(record.values[i]);
    if (!forms.back().is) continue;
    if (found)
      throw RecordError(record.offset(i), "has both " + inQuotes(names[*found]) + " and " + inQuotes(names[i]) +
                                              " for " + std::string(row.name) + "; expected one of the two");
    found = i;
  }
  return found ? std::optional(layoutOf(*found)) : std::nullopt;
}

}  // namespace

std::optional<Layout> find(const Coordinate& row, const RecordParts& record, std::vector<FormOfField>& forms,
                           NameRule rule) {
  const Shape& shape = record.shape;
  if (shape.isArray) return std::nullopt;
  const auto found = [&]() -> std::optional<Layout> {
    if (row.form == CoordinateForm::numbers)
      return findEach(record, row.parts.first(row.fewest), row.fewest, row.orNull, rule);
    if (shape.form == Form::csv) return findColumns(row, record, rule);
    if (row.form == CoordinateForm::array) return findArray(row, record, forms, rule);
    const auto field = shape.find(row.name);
    if (!field) return std::nullopt;
    const char first = row.first;
    forms.push_back({*field, first, record.values[*field].starts_with(first)});
    if (!forms.back().is) return std::nullopt;
    Layout layout;
    if (row.form == CoordinateForm::points)
      for (std::size_t i = 0; i < row.fewest; ++i)
        layout.parts.push_back({*field, 3, 3, true, false, {}, i, row.fewest, PointForm::point});
    else
      for (const CoordinatePart& part : row.parts)
        layout.parts.push_back({*field, part.size, part.size, part.size > 1, false, std::string(part.name), 0, 0,
                                part.size > 1 ? PointForm::point : PointForm::none});
    return layout;
  }();
  if (!found) return std::nullopt;
  Layout layout = *found;
  layout.kind = row.kind;
  return layout;
}

std::string partlyThere(const Coordinate& row, const Shape& shape) {
  if (row.form != CoordinateForm::numbers || row.fewest < 2) return "";
  const std::vector<NameMatch> matches = matchParts(shape.names, row.parts, row.fewest, NameRule::any);
  std::string there;
  std::string_view missing;
  std::size_t count = 0;
  for (std::size_t i = 0; i < row.fewest; ++i) {
    count += matches[i].field.has_value();
    if (matches[i].field)
      there += (there.empty() ? "" : " and ") + visible(shape.names[*matches[i].field]);
    else if (missing.empty())
      missing = row.parts[i].name;
  }
  // One of them that is not the first may be anything.
  return !matches[0].field && count < 2 ? "" : "has " + there + " but no " + std::string(missing);
}

std::string namesIn(const Layout& layout, const Shape& shape) {
  std::vector<std::string_view> names;
  for (const NumberField& part : layout.parts)
    if (names.empty() || names.back() != shape.names[part.field]) names.push_back(shape.names[part.field]);
  return visible(joined(names, ","));
}

}  // namespace viewproj::cmd
