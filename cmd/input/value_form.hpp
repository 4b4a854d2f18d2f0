// What the value of a field may look like: numbers, and what people write for them.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "input/field.hpp"

namespace viewproj::cmd {

/// "60deg", "1.0472rad" or "60\u00b0": the double nearest in degrees; and, for the command line, "60". needsUnit: that
/// is none.
std::optional<double> degreesIn(std::string_view text, bool needsUnit);

/// "16/9": the double nearest.
std::optional<double> ratioIn(std::string_view text);

/// A number, or a text that the form takes for one.
std::optional<double> numberIn(const nlohmann::json& value, ValueForm form);

/// What numberIn takes: "a number".
std::string expectedNumber(ValueForm form);

/// {"x", "y", "z"} or, of four, with "w".
bool hasCoordinates(const nlohmann::json& value);

/// [x, y, z] or an object of the coordinates, of fewest to most; otherwise nothing. form: of each.
std::optional<std::vector<double>> coordinatesIn(const nlohmann::json& value, std::size_t fewest, std::size_t most,
                                                 ValueForm form = ValueForm::number);

/// Whether the value looks as those of the field do, a position, direction or quaternion: what makes another name of
/// the field one.
bool fits(const nlohmann::json& value, const Field& field);

}  // namespace viewproj::cmd
