// viewproj schema: the JSON Schema of a camera file.
#include <CLI/CLI.hpp>

#include "commands/cli.hpp"
#include "commands/command.hpp"
#include "output/output_file.hpp"
#include "schema/camera.hpp"

namespace viewproj::cmd {

Action declareSchema(CLI::App& app) {
  app.description("The JSON Schema (draft 2020-12) of a camera file, for editors and validators.");
  app.footer("Example:\n  viewproj schema > camera.schema.json");
  addOnlyForm(app, "JSON", ".json");
  return [] {
    writeOutput(cameraSchema());
    return 0;
  };
}

}  // namespace viewproj::cmd
