// Which fields of a record are meant by the names of a row's parts: those of the very names, else of these names in
// another case, else of aliases too.
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
  bool isAlias = false;
};

/// The fields of the parts, as many as there are. They are of one set: where several fields may be a part, those that
/// are cased alike go together. A part behind the first `required` counts where it is cased as the first: w beside x,
/// W beside X.
std::vector<NameMatch> matchParts(std::span<const std::string> fields, std::span<const CoordinatePart> parts,
                                  std::size_t required, NameRule rule);

/// What a place's height is called that may be counted from the sea, and is taken as it is.
std::string seaLevelNote(std::string_view name);

}  // namespace viewproj::cmd
