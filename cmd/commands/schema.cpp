// viewproj schema: the JSON Schemas of what is read and written.
#include <CLI/CLI.hpp>
#include <memory>

#include "commands/command.hpp"
#include "commands/options.hpp"
#include "commands/output_option.hpp"
#include "output/output_file.hpp"
#include "schema/schemas.hpp"
#include "text/error.hpp"
#include "text/names.hpp"

namespace viewproj::cmd {
namespace {

Names<const NamedSchema*> schemas() {
  Names<const NamedSchema*> known;
  for (const NamedSchema& schema : kSchemas) known.emplace_back(schema.name, &schema);
  return known;
}

struct Options {
  std::optional<const NamedSchema*> schema;
  Notes notes;
};

int run(const Options& o) {
  if (!o.schema) throw UsageError("NAME is needed: " + joined(known(schemas())));
  writeOutput((*o.schema)->text());
  return 0;
}

}  // namespace

Action defineSchema(CLI::App& app) {
  const auto o = std::make_shared<Options>();
  app.description(
      "The JSON Schema (draft 2020-12) of a camera file, of points, of a scene, or of results, for editors and "
      "validators.");
  app.footer("viewproj schema camera");
  addChoice(app, "NAME", "", o->schema, schemas(), "What the schema is of", "");
  addOnlyForm(app, "JSON", ".json");
  o->notes.add(app);
  return [o] { return run(*o); };
}

}  // namespace viewproj::cmd
