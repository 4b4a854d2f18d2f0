// viewproj schema: the JSON Schema of a camera file.
#include <memory>

#include "commands/command.hpp"
#include "commands/notes.hpp"
#include "commands/output_option.hpp"
#include "output/output_file.hpp"
#include "schema/camera.hpp"

namespace viewproj::cmd {

Action defineSchema(CommandLine& line) {
  const auto notes = std::make_shared<Notes>();
  line.setDescription("The JSON Schema (draft 2020-12) of a camera file, for editors and validators.");
  line.setExample("viewproj schema > camera.schema.json");
  addOnlyForm(line, "JSON", ".json");
  notes->add(line);
  return [notes] {
    writeOutput(cameraSchema());
    return 0;
  };
}

}  // namespace viewproj::cmd
