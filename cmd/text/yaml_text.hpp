// YAML as text: what it says as JSON would. The one place that calls libyaml.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "text/json_text.hpp"

namespace viewproj::cmd {

/// Whether a text that is no JSON looks like YAML: a %YAML line, or a key and its colon, a --- or a - in its first line
/// that is no comment.
bool looksLikeYaml(std::string_view text);

/// Reads the value of one document, as OpenCV's FileStorage, ROS and others write it: objects, arrays, texts, numbers,
/// true, false and null. Tags say nothing. What JSON has no word for (.inf, .nan) stays a text. Returns
/// what is wrong with the text: a key twice, nesting deeper than `deepest`, and aliases that make more of the text than
/// it has bytes are faults too.
std::optional<JsonFault> parseYaml(std::string_view text, std::size_t deepest, nlohmann::json& value);

}  // namespace viewproj::cmd
