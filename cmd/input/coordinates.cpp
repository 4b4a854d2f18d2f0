#include "input/coordinates.hpp"

#include "text/error.hpp"
#include "text/names.hpp"

namespace viewproj::cmd {
namespace {

namespace all = coordinates;

constexpr const Coordinate* kAll[] = {&all::position, &all::xyz,       &all::place,  &all::direction,
                                      &all::segment,  &all::sphere,    &all::box,    &all::triangle,
                                      &all::plane,    &all::ellipsoid, &all::radius, &all::screen,
                                      &all::pixel,    &all::xy,        &all::depth,  &all::viewDistance};

std::optional<std::size_t> fieldOf(const Shape& shape, std::string_view name, Aliases aliases) {
  if (const auto field = shape.find(name)) return field;
  for (const std::string_view alias : aliases)
    if (const auto field = shape.find(alias)) return field;
  return std::nullopt;
}

/// A column each: the first has to be there, and so many.
std::optional<Layout> findEach(const Shape& shape, std::span<const CoordinatePart> parts, std::size_t required,
                               bool orNull) {
  if (!fieldOf(shape, parts[0].name, parts[0].aliases)) return std::nullopt;
  Layout layout;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto field = fieldOf(shape, parts[i].name, parts[i].aliases);
    if (field)
      layout.parts.push_back({*field, 1, 1, false, orNull});
    else if (i < required)
      throw RecordError(0, "has " + std::string(parts[0].name) + " but no " + std::string(parts[i].name));
    else
      break;
  }
  return layout;
}

/// In CSV.
std::optional<Layout> findColumns(const Coordinate& row, const Shape& shape) {
  if (row.form == CoordinateForm::numbers)
    if (auto layout = findEach(shape, row.parts, row.fewest, row.orNull)) return layout;
  const std::vector<std::string> names = columnsOf(row);
  if (names.empty()) return std::nullopt;
  std::vector<CoordinatePart> parts;
  for (const std::string& name : names) parts.push_back({name});
  return findEach(shape, parts, row.fewest, row.orNull);
}

}  // namespace

std::span<const Coordinate* const> allCoordinates() { return kAll; }

std::optional<Layout> find(const Coordinate& row, const RecordParts& record, std::vector<FormOfField>& forms) {
  const Shape& shape = record.shape;
  if (shape.isArray) return std::nullopt;
  const auto found = [&]() -> std::optional<Layout> {
    if (shape.form == Form::csv) return findColumns(row, shape);
    if (row.form == CoordinateForm::numbers) return findEach(shape, row.parts, row.fewest, row.orNull);
    const auto field = fieldOf(shape, row.name, row.aliases);
    if (!field) return std::nullopt;
    if (row.form == CoordinateForm::array) return Layout{{{*field, row.fewest, row.most, true, row.orNull}}};
    const char first = row.first;
    forms.push_back({*field, first, record.values[*field].starts_with(first)});
    if (!forms.back().is) return std::nullopt;
    Layout layout;
    if (row.form == CoordinateForm::points)
      for (std::size_t i = 0; i < row.fewest; ++i)
        layout.parts.push_back({*field, 3, 3, true, false, {}, i, row.fewest});
    else
      for (const CoordinatePart& part : row.parts)
        layout.parts.push_back({*field, part.size, part.size, part.size > 1, false, std::string(part.name)});
    return layout;
  }();
  if (!found) return std::nullopt;
  Layout layout = *found;
  layout.kind = row.kind;
  return layout;
}

std::vector<std::string> columnsOf(const Coordinate& row) {
  std::vector<std::string> names;
  const auto add = [&](std::string_view name, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i)
      names.push_back(columnName(name) + std::string(size > 1 ? kColumnSuffixes[i] : ""));
  };
  if (row.form == CoordinateForm::array) add(row.name, row.most);
  if (row.form == CoordinateForm::object || row.form == CoordinateForm::numbers)
    for (const CoordinatePart& part : row.parts) add(part.name, part.size);
  return names;
}

const Coordinate* rowNamed(std::string_view field) {
  for (const Coordinate* row : kAll)
    if (row->name == field && row->form != CoordinateForm::numbers) return row;
  return nullptr;
}

std::string exampleOf(const Coordinate& row) {
  std::string text;
  if (row.form == CoordinateForm::object) {
    for (const CoordinatePart& part : row.parts)
      text += (text.empty() ? "{\"" : ", \"") + std::string(part.name) + "\": " + (part.size > 1 ? "[x, y, z]" : "r");
    return text + "}";
  }
  for (std::size_t i = 0; i < row.fewest; ++i) text += (text.empty() ? "" : ", ") + std::string("[x, y, z]");
  return "[" + text + "]";
}

std::string namesOf(std::span<const Coordinate* const> rows, std::string_view last) {
  std::string text;
  for (std::size_t i = 0; i < rows.size(); ++i)
    text += (i == 0 ? "" : i + 1 == rows.size() ? std::string(last) : ", ") + std::string(rows[i]->name);
  return text;
}

}  // namespace viewproj::cmd
