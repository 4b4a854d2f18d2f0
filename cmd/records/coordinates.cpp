#include "records/coordinates.hpp"

#include "text/names.hpp"

namespace viewproj::cmd {
namespace {

namespace all = coordinates;

constexpr const Coordinate* kAll[] = {&all::position, &all::xyz,       &all::place,  &all::direction,
                                      &all::segment,  &all::sphere,    &all::box,    &all::triangle,
                                      &all::plane,    &all::ellipsoid, &all::radius, &all::screen,
                                      &all::pixel,    &all::xy,        &all::depth,  &all::viewDistance};

}  // namespace

std::span<const Coordinate* const> allCoordinates() { return kAll; }

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
