// Which fields of a record are meant by the names of a row's parts.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "records/coordinates.hpp"

namespace viewproj::cmd {

enum class NameRule { exact, any };

struct NameMatch {
  std::optional<std::size_t> field;
  std::optional<std::size_t> also = {};  ///< another that fits as well
};

/// The field of each part, by its very name or its column's; with the rule any, unless these give all that are
/// required, by its name or an alias in any letter case.
std::vector<NameMatch> matchParts(std::span<const std::string> fields, std::span<const CoordinatePart> parts,
                                  std::size_t required, NameRule rule);

/// Whether the first `required` parts have a field.
bool isWhole(std::span<const NameMatch> matches, std::size_t required);

/// Whether a place's height is called so that it may be counted from the sea.
bool isSeaLevelName(std::string_view name);
std::string seaLevelNote(std::string_view name);

}  // namespace viewproj::cmd
