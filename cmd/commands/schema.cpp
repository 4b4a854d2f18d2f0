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

/// The text is made when it is asked for.
using WriteSchema = std::string (*)();

Names<WriteSchema> schemas() {
  Names<WriteSchema> texts;
  for (const NamedSchema& schema : kSchemas) texts.emplace_back(schema.name, schema.text);
  return texts;
}

int run(const std::optional<WriteSchema>& text) {
  if (!text) throw UsageError("NAME is needed: " + joined(known(schemas())));
  writeOutput((*text)());
  return 0;
}

}  // namespace

Action defineSchema(CLI::App& app) {
  const auto text = std::make_shared<std::optional<WriteSchema>>();
  app.description(
      "The JSON Schema (draft 2020-12) of a camera file, of points, of a scene, or of results, for editors and "
      "validators.");
  app.footer("viewproj schema camera");
  addChoice(app, "NAME", "", *text, schemas(), "What the schema is of", "");
  return [text] { return run(*text); };
}

}  // namespace viewproj::cmd
