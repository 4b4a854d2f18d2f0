// Records through the command-line tool.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace rasterisers {

/// What the tool makes of them: one JSON value in, one out.
std::vector<nlohmann::json> filter(const std::vector<std::string>& arguments,
                                   const std::vector<nlohmann::json>& records);

}  // namespace rasterisers
