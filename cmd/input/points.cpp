#include "input/points.hpp"

#include <array>

#include "input/error.hpp"

namespace viewproj::cmd {
namespace {

std::vector<double> allNumbers(const Record& record) {
  std::vector<double> numbers;
  for (const Field& field : record.fields) numbers.push_back(numberOf(field, record.form));
  return numbers;
}

Vec4 toPoint(const std::vector<double>& n, double w) { return {n[0], n[1], n[2], n.size() > 3 ? n[3] : w}; }

/// The fields of these names, if the record has the first of them. Throws RecordError if it lacks another.
std::optional<std::vector<double>> namedNumbers(const Record& record, const std::vector<std::string>& names,
                                                std::size_t required) {
  if (!record.find(names[0])) return std::nullopt;
  std::vector<double> numbers;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Field* field = record.find(names[i]);
    if (field)
      numbers.push_back(numberOf(*field, record.form));
    else if (i < required)
      throw RecordError(0, "has " + names[0] + " but no " + names[i]);
    else
      break;
  }
  return numbers;
}

/// The fields NAME_x, NAME_y, ... of a CSV line.
std::optional<std::vector<double>> suffixedNumbers(const Record& record, const std::string& name, std::size_t required,
                                                   std::size_t most) {
  static constexpr const char* kSuffixes[] = {"_x", "_y", "_z", "_w"};
  std::vector<std::string> names;
  for (std::size_t i = 0; i < most; ++i) names.push_back(name + kSuffixes[i]);
  return namedNumbers(record, names, required);
}

std::optional<double> optionalNumber(const Record& record, const char* name) {
  const Field* field = record.find(name);
  if (!field || isAbsent(*field, record.form)) return std::nullopt;
  return numberOf(*field, record.form);
}

Vec4 readAnyPoint(const Record& record, const std::vector<std::string>& columns) {
  if (record.form == Form::text || record.isArray) {
    const auto numbers = allNumbers(record);
    if (numbers.size() != 3 && numbers.size() != 4)
      throw RecordError(0, "has " + std::to_string(numbers.size()) + " numbers; expected x y z or x y z w");
    return toPoint(numbers, 1);
  }
  if (record.form == Form::csv) {
    if (!columns.empty()) {
      const auto numbers = namedNumbers(record, columns, 3);
      if (!numbers) throw RecordError(0, "has no column " + columns[0] + ", which --columns names");
      return toPoint(*numbers, 1);
    }
    if (const auto numbers = suffixedNumbers(record, "position", 3, 4)) return toPoint(*numbers, 1);
  } else if (const Field* position = record.find("position")) {
    return toPoint(numbersOf(*position, 3, 4), 1);
  }
  if (const auto numbers = namedNumbers(record, {"x", "y", "z", "w"}, 3)) return toPoint(*numbers, 1);
  if (record.form == Form::csv) {
    if (const auto numbers = suffixedNumbers(record, "direction", 3, 3)) return toPoint(*numbers, 0);
    throw RecordError(0, "has no columns x, y, z; --columns names the three coordinates");
  }
  if (const Field* direction = record.find("direction")) return toPoint(numbersOf(*direction, 3, 3), 0);
  throw RecordError(0, "has no point; expected position, x y z, or direction");
}

std::optional<Vec2> toScreen(const std::optional<std::vector<double>>& numbers) {
  if (!numbers) return std::nullopt;
  return Vec2{(*numbers)[0], (*numbers)[1]};
}

}  // namespace

Vec4 readPoint(const Record& record, const std::vector<std::string>& columns) {
  const Vec4 point = readAnyPoint(record, columns);
  if (point == Vec4{0, 0, 0, 0}) throw RecordError(0, "0 0 0 0 is neither a point nor a direction");
  return point;
}

Pixel readPixel(const Record& record, const std::vector<std::string>& columns) {
  Pixel pixel;
  if (record.form == Form::text) {
    const std::size_t size = record.fields.size();
    if (size != 2 && size != 3)
      throw RecordError(0, "has " + std::to_string(size) + " numbers; expected x y or x y depth");
    pixel.hasDistance = size == 3;
    const auto present = [&](std::size_t i) { return record.fields[i].value != "NaN"; };
    const auto number = [&](std::size_t i) { return numberOf(record.fields[i], Form::text); };
    if (present(0) && present(1)) pixel.screen = Vec2{number(0), number(1)};
    if (pixel.hasDistance && present(2)) pixel.depth = number(2);
    return pixel;
  }
  if (record.isArray) {
    const auto numbers = allNumbers(record);
    if (numbers.size() != 2)
      throw RecordError(0, "has " + std::to_string(numbers.size()) +
                               " numbers; expected [x, y], or {\"screen\": [x, y], \"depth\": d}");
    pixel.screen = Vec2{numbers[0], numbers[1]};
    return pixel;
  }

  const bool csv = record.form == Form::csv;
  pixel.depth = optionalNumber(record, "depth");
  pixel.viewDistance = optionalNumber(record, "viewDistance");
  if (csv && !pixel.viewDistance) pixel.viewDistance = optionalNumber(record, "view_distance");
  pixel.hasDistance = record.find("depth") || record.find("viewDistance") || record.find("view_distance");
  if (csv && !columns.empty()) {
    pixel.screen = toScreen(namedNumbers(record, columns, 2));
    if (!pixel.screen) throw RecordError(0, "has no column " + columns[0] + ", which --columns names");
    return pixel;
  }
  for (const char* name : {"screen", "pixel"}) {
    const Field* field = record.find(csv ? std::string(name) + "_x" : name);
    if (!field) continue;
    if (isAbsent(*field, record.form)) return pixel;
    pixel.screen = csv ? toScreen(suffixedNumbers(record, name, 2, 2)) : toScreen(numbersOf(*field, 2, 2));
    return pixel;
  }
  if (const Field* z = record.find("z"); z && record.find("x"))
    throw RecordError(z->offset, "x, y, z is a point of the world, not a pixel; expected screen, pixel or x y alone");
  pixel.screen = toScreen(namedNumbers(record, {"x", "y"}, 2));
  if (!pixel.screen)
    throw RecordError(0, csv ? "has no columns screen_x, screen_y or x, y; --columns names the two"
                             : "has no pixel; expected screen, pixel, or x y");
  return pixel;
}

}  // namespace viewproj::cmd
