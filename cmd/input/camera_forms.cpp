#include "input/camera_forms.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "input/camera_fields.hpp"
#include "input/projection_types.hpp"
#include "text/names.hpp"

namespace viewproj::cmd {

std::string whereItBelongs(std::string_view name, const ObjectForm& form) {
  constexpr std::string_view kInProjection = "in projection";
  std::vector<std::pair<const ObjectForm*, std::string_view>> objects = {{&field::camera, "at the top of the file"},
                                                                         {&field::picture, "in viewport"}};
  std::vector<std::string_view> types;
  for (const ProjectionType& type : projectionTypes()) {
    objects.emplace_back(&type.form, kInProjection);
    if (type.form.has(name)) types.push_back(type.name);
  }
  objects.emplace_back(&field::axes, "in convention");
  const auto own = std::find_if(objects.begin(), objects.end(), [&](const auto& row) { return row.first == &form; });
  if (own == objects.end()) return "";
  if (own->second == kInProjection && !types.empty()) return "; it goes with the type " + alternatives(types);
  for (const auto& [object, place] : objects)
    if (object->has(name)) return "; it belongs " + std::string(place);
  return "";
}

}  // namespace viewproj::cmd
