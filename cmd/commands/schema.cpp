// viewproj schema: the JSON Schemas of what is read and written.
#include "commands/command.hpp"
#include "commands/options.hpp"
#include "input/error.hpp"
#include "input/names.hpp"
#include "output/output_file.hpp"
#include "schema/schemas.hpp"

namespace viewproj::cmd {

int runSchema(int argc, char** argv) {
  CLI::App app(
      "The JSON Schema (draft 2020-12) of a camera file, of points, of a scene, or of results.\n"
      "Example: viewproj schema camera > camera.schema.json",
      "viewproj schema");
  std::string name;
  app.add_option("NAME", name, "camera, points, scene or results");
  parse(app, argc, argv);

  std::vector<std::string_view> known;
  for (const NamedSchema& schema : kSchemas) {
    if (schema.name == name) {
      writeOutput(std::string(schema.text));
      return 0;
    }
    known.push_back(schema.name);
  }
  if (name.empty()) throw UsageError("NAME is needed: " + joined(known));
  failUnknown("NAME", name, known);
}

}  // namespace viewproj::cmd
