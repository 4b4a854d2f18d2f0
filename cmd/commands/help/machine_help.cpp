#include "commands/help/machine_help.hpp"

#include <span>
#include <vector>

#include "commands/help/command_help.hpp"
#include "commands/help/topics.hpp"
#include "input/camera_fields.hpp"
#include "input/coordinates.hpp"
#include "input/projection_types.hpp"
#include "input/scene_fields.hpp"
#include "text/json_build.hpp"

namespace viewproj::cmd {
namespace {

constexpr const char* kLines = ",\n    ";

std::string optionAsJson(const OptionHelp& option, const std::string& heading) {
  JsonObject out;
  if (option.names.empty())
    out.add("name", option.name);
  else
    out.addText("names", jsonListOf(option.names));
  if (!option.value.empty()) out.add("value", option.value);
  if (!option.facts.choices.empty()) out.addText("choices", jsonListOf(option.facts.choices));
  if (!option.facts.otherwise.empty()) out.add("default", option.facts.otherwise);
  if (option.facts.severalChoices) out.add("several", true);
  if (option.facts.repeatable) out.add("repeatable", true);
  if (!heading.empty()) out.add("heading", heading);
  return out.add("help", option.text).text();
}

std::string commandAsJson(const Command& command) {
  const CommandHelp help = describe(command);
  std::vector<std::string> operands, options;
  for (const OptionHelp& argument : help.arguments) operands.push_back(optionAsJson(argument, ""));
  for (const OptionGroup& group : help.groups)
    for (const OptionHelp& option : group.options) options.push_back(optionAsJson(option, group.heading));
  JsonObject out;
  out.add("name", command.name).add("summary", command.summary).add("help", help.description);
  out.addText("operands", jsonList(operands)).addText("options", jsonList(options, ",\n      "));
  return out.add("example", help.example).text();
}

std::string fieldAsJson(const Field& field) {
  JsonObject out;
  out.add("name", field.name).add("type", formInWords(field));
  if (!field.aliases().empty()) out.addText("aliases", jsonListOf(field.aliases()));
  if (!field.option.empty()) out.add("option", field.option);
  if (field.words) out.addText("choices", jsonListOf(field.words()));
  return out.add("help", field.help).text();
}

std::string fieldsAsJson(FieldList fields) {
  std::vector<std::string> objects;
  for (const Field* field : fields) objects.push_back(fieldAsJson(*field));
  return jsonList(objects, kLines);
}

std::string coordinatesAsJson() {
  std::vector<std::string> objects;
  for (const Coordinate* row : allCoordinates()) {
    JsonObject out;
    out.add("name", row->name);
    std::vector<std::string_view> parts;
    for (const CoordinatePart& part : row->parts) parts.push_back(part.name);
    if (!row->aliases.empty()) out.addText("aliases", jsonListOf(row->aliases));
    if (!parts.empty()) out.addText("parts", jsonListOf(parts));
    objects.push_back(out.add("help", row->help).text());
  }
  return jsonList(objects, kLines);
}

}  // namespace

std::string helpAsJson() {
  std::vector<std::string> commands, pages;
  for (const Command& command : allCommands()) commands.push_back(commandAsJson(command));
  for (const Topic& topic : topics())
    pages.push_back(JsonObject().add("name", topic.name).add("summary", topic.summary).text());
  JsonObject files;
  files.addText("camera", fieldsAsJson(field::camera.fields));
  for (const ProjectionType& type : projectionTypes())
    files.addText("projection " + std::string(type.name), fieldsAsJson(type.form.fields));
  files.addText("viewport", fieldsAsJson(field::picture.fields));
  files.addText("scene", fieldsAsJson(field::scene.fields));
  files.addText("object of a scene", fieldsAsJson(field::sceneObject.fields));
  files.addText("record", coordinatesAsJson());
  JsonObject out;
  out.addText("commands", jsonList(commands, kLines))
      .addText("topics", jsonList(pages, kLines))
      .addText("fields", files.text());
  return out.text() + "\n";
}

}  // namespace viewproj::cmd
