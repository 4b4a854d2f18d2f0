// The value of a camera field as it is typed.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "input/field.hpp"

namespace viewproj::cmd {

/// As a camera file would have it. Throws UsageError with what was expected.
nlohmann::json typedValue(ValueForm form, const std::string& option, const std::string& text,
                          std::string_view hint = {});

/// The word for it in the help: "DEGREES".
std::string_view valueWord(ValueForm form);

}  // namespace viewproj::cmd
