// viewproj schema: the JSON Schemas of what is read and written.
#include <memory>

#include "commands/command.hpp"
#include "commands/notes.hpp"
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

Action defineSchema(CommandLine& line) {
  const auto o = std::make_shared<Options>();
  line.setDescription(
      "The JSON Schema (draft 2020-12) of a camera file, of points, of a scene, or of results, for editors and "
      "validators.");
  line.setExample("viewproj schema camera");
  addChoice(line, "NAME", "", o->schema, schemas(), "What the schema is of", "");
  addOnlyForm(line, "JSON", ".json");
  o->notes.add(line);
  return [o] { return run(*o); };
}

}  // namespace viewproj::cmd
