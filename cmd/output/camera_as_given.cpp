// A camera's fields as the command line gave them.
#include "input/camera_fields.hpp"
#include "input/projection_types.hpp"
#include "output/camera_json.hpp"
#include "output/camera_text.hpp"

namespace viewproj::cmd {
namespace {

std::string objectOf(const ObjectReader& object, FieldList fields);

std::string valueOf(const ObjectReader& object, const Field& field) {
  switch (field.form) {
    case ValueForm::text:
    case ValueForm::word:
      return jsonOf(*object.string(field));
    case ValueForm::object:
      return objectOf(*object.object(field), field.object->fields);
    case ValueForm::position:
      if (object.isObject(field)) return objectOf(*object.object(field), field.object->fields);
      [[fallthrough]];
    case ValueForm::pair:
    case ValueForm::range:
    case ValueForm::triple:
    case ValueForm::turns:
    case ValueForm::direction:
    case ValueForm::quaternion:
      return jsonListOf(*object.numbers(field, 0, 4));
    default:
      return object.isString(field) ? jsonOf(*object.string(field)) : jsonOf(*object.number(field));
  }
}

std::string objectOf(const ObjectReader& object, FieldList fields) {
  JsonObject out;
  for (const Field* field : fields)
    if (object.has(*field)) out.addText(*field, valueOf(object, *field));
  return out.text();
}

}  // namespace

std::string writeFields(const Document& document, const Convention& convention, const ConventionPreset& preset) {
  const ObjectReader camera(document, document.root(), {});
  JsonObject out;
  constexpr std::string_view kLine = ",\n  ";
  out.addText(field::convention, conventionAsJson(convention, preset), kLine);
  for (const Field* field : field::camera.fields) {
    if (field == &field::convention || !camera.has(*field)) continue;
    if (field == &field::projection) {
      const ObjectReader projection = *camera.object(*field);
      out.addText(*field, objectOf(projection, requireProjectionType(projection).form.fields), kLine);
    } else {
      out.addText(*field, valueOf(camera, *field), kLine);
    }
  }
  return "{\n  " + out.members() + "\n}\n";
}

}  // namespace viewproj::cmd
