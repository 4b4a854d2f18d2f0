// Reads YAML into JSON values. The only file that calls libyaml.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "text/json_text.hpp"

namespace viewproj::cmd {

/// Whether a text that is not JSON looks like YAML: it has a %YAML line, or its first line that is not a comment is ---
/// or begins with - or a key and its colon.
bool looksLikeYaml(std::string_view text);

/// Reads one document, such as OpenCV's FileStorage or ROS write: objects, arrays, texts, numbers, true, false and
/// null. Tags are ignored. Values that JSON does not have (.inf, .nan) stay texts. Returns what is wrong with the text.
/// A key twice, nesting deeper than `deepest`, and aliases that make the text several times larger are errors too.
std::optional<JsonFault> parseYaml(std::string_view text, std::size_t deepest, nlohmann::json& value);

}  // namespace viewproj::cmd
