// The JSON Schemas of what is read and written.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace viewproj::cmd {

std::string cameraSchema();
std::string sceneSchema();
std::string pointsSchema();
std::string resultsSchema();

/// Of the schema of results the definitions of reports: what commands print that are no records. A file beside this
/// one.
std::string reportsText();

struct NamedSchema {
  std::string_view name;
  std::string (*text)();
};
inline constexpr NamedSchema kSchemas[] = {
    {"camera", cameraSchema}, {"points", pointsSchema}, {"scene", sceneSchema}, {"results", resultsSchema}};

}  // namespace viewproj::cmd
