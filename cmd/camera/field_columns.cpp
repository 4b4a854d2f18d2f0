#include "camera/field_columns.hpp"

#include <algorithm>
#include <iterator>

#include "camera/fields.hpp"
#include "camera/sea_level.hpp"
#include "text/names.hpp"

namespace viewproj::cmd {
namespace {

/// Paths, and the other names of each.
constexpr std::string_view kShort[][2] = {{"position", "eye"},
                                          {"target", "lookAt"},
                                          {"position.x", "x"},
                                          {"position.y", "y"},
                                          {"position.z", "z"},
                                          {"position.lat", "lat latitude"},
                                          {"position.lon", "lon lng longitude"},
                                          {"rotation.x", "qx"},
                                          {"rotation.y", "qy"},
                                          {"rotation.z", "qz"},
                                          {"rotation.w", "qw"},
                                          {"heading", "yaw"}};
/// Names that may be of something else: only their whole path is a camera's.
constexpr std::string_view kAmbiguous = "name $schema type left right bottom top width height matrix pixels origin";

/// The one of these words that is the name in any letter case; or nothing.
std::string_view wordFor(std::string_view name, std::string_view words) {
  for (const std::string_view word : wordsIn(words))
    if (sameButForCase(word, name)) return word;
  return "";
}
bool isOneOf(std::string_view name, std::string_view words) { return !wordFor(name, words).empty(); }

}  // namespace

bool isSeaLevelName(std::string_view name) {
  return std::any_of(std::begin(kSeaLevelNames), std::end(kSeaLevelNames),
                     [&](std::string_view known) { return sameButForCase(known, name); });
}

std::string pathOfColumn(std::string_view column, bool isOnEarth) {
  for (const auto& [path, names] : kShort)
    if (isOneOf(column, names)) return std::string(path);
  const bool isSeaLevel = isSeaLevelName(column);
  if (isSeaLevel || isOneOf(column, "height"))
    return !isOnEarth ? "" : isSeaLevel && hasGeoid() ? "position.altitude" : "position.height";
  if (isOneOf(column, kAmbiguous)) return "";
  if (const auto object = wordFor(column, "projection viewport convention"); !object.empty())
    return std::string(object);
  for (const Field& field : kFields)
    if (sameButForCase(column, field.path)) return std::string(field.path);
  for (const Field& field : kFields)
    if ((field.types != 0 || topName(field) == "viewport") &&
        sameButForCase(column, field.path.substr(field.path.rfind('.') + 1)))
      return std::string(field.path);
  // A member of a field's value.
  const std::size_t dot = column.rfind('.');
  if (dot == std::string_view::npos) return "";
  for (const Field& field : kFields) {
    const std::string members = "x y z w " + std::string(rowOf(field.kind).members);
    const std::string_view member = wordFor(column.substr(dot + 1), members);
    if (!member.empty() && sameButForCase(column.substr(0, dot), field.path))
      return std::string(field.path) + "." + std::string(member);
  }
  return "";
}

}  // namespace viewproj::cmd
