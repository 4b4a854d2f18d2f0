// viewproj schema: the JSON Schemas of what is read and written.
#include <CLI/CLI.hpp>
#include <memory>

#include "commands/command.hpp"
#include "commands/options.hpp"
#include "output/output_file.hpp"
#include "schema/schemas.hpp"
#include "text/error.hpp"
#include "text/names.hpp"

namespace viewproj::cmd {
namespace {

int run(const std::string& name) {
  std::vector<std::string_view> known;
  for (const NamedSchema& schema : kSchemas) {
    if (schema.name == name) {
      writeOutput(schema.text());
      return 0;
    }
    known.push_back(schema.name);
  }
  if (name.empty()) throw UsageError("NAME is needed: " + joined(known));
  failUnknown("NAME", name, known);
}

}  // namespace

Action defineSchema(CLI::App& app) {
  const auto name = std::make_shared<std::string>();
  app.description(
      "The JSON Schema (draft 2020-12) of a camera file, of points, of a scene, or of results, for editors and "
      "validators.");
  app.footer("viewproj schema camera");
  app.add_option("NAME", *name, "camera, points, scene or results");
  return [name] { return run(*name); };
}

}  // namespace viewproj::cmd
