// Which field of a record is meant by a name: the one of that very name, else of the name in another case, else of an
// alias in any case.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "input/coordinates.hpp"

namespace viewproj::cmd {

enum class NameRule { exact, any };

struct NameMatch {
  std::optional<std::size_t> field;
  std::optional<std::size_t> also = {};  ///< another that is as good
  bool isExact = false, isAlias = false;
};

/// Among the fields' names. columnNames: a column of CSV has it too, exactly.
NameMatch matchName(std::span<const std::string> fields, std::string_view name, std::string_view columnName,
                    Aliases aliases, NameRule rule);

/// The fields of the parts, as many from the first on as there are. A part behind the first `required` counts where it
/// is in the case of the first: w beside x, W beside X.
std::vector<NameMatch> matchParts(std::span<const std::string> fields, std::span<const CoordinatePart> parts,
                                  std::size_t required, NameRule rule);

/// What a place's height is called that may be counted from the sea, and is taken as it is.
std::string seaLevelNote(std::string_view name);

}  // namespace viewproj::cmd
