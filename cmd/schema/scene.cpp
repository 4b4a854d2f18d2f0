// The JSON Schema of a scene file.
#include "input/scene_fields.hpp"
#include "schema/parts.hpp"
#include "schema/schemas.hpp"

namespace viewproj::cmd {

std::string sceneSchema() {
  using schema::Json;
  Json schema = schema::head(
      "scene", "Scene file of viewproj",
      std::string(field::scene.help) +
          " ray --scene and draw --scene read it. What is null counts as absent. What a schema cannot say and the "
          "reader still asks for: no coordinate of a box's max is below that of its min; a height is not below "
          "-1000000; an angle that is a text lies in the range of a number; no key is given twice.");
  Json form = schema::objectOf(field::scene, false);
  form.erase("description");
  schema.update(form);
  return schema.dump(2) + "\n";
}

}  // namespace viewproj::cmd
