// viewproj schema: the JSON Schemas of what is read and written.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "commands/command.hpp"
#include "commands/options.hpp"
#include "commands/schema/json_schema.hpp"
#include "output/output_file.hpp"
#include "schema/schemas.hpp"
#include "text/error.hpp"
#include "text/names.hpp"

namespace viewproj::cmd {
namespace {

std::string fileOf(std::string_view name) {
  return std::string(std::find_if(std::begin(kSchemas), std::end(kSchemas), [&](const NamedSchema& schema) {
                       return schema.name == name;
                     })->text);
}

struct Schema {
  std::string_view name;
  std::string (*text)();
};
constexpr Schema kKnown[] = {
    {"camera", [] { return fileOf("camera"); }},
    {"points", pointsSchema},
    {"scene", [] { return fileOf("scene"); }},
    {"results", [] { return resultsSchema(fileOf("reports")); }},
};

int run(const std::string& name) {
  std::vector<std::string_view> known;
  for (const Schema& schema : kKnown) {
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
