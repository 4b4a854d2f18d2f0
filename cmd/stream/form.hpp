// The forms a stream of records can have.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace viewproj::cmd {

enum class Form { json, csv, text };

/// json is a sequence of values on lines; jsonArray one array of them.
enum class OutputForm { lines, array, csv, text };

/// By the file's name, or nothing.
std::optional<Form> formOfName(std::string_view fileName);

/// By the first bytes: `{` or `[` begins JSON, a comma on the first line CSV, anything else with numbers text.
Form formOfBytes(std::string_view start);

}  // namespace viewproj::cmd
