// The command line tool, asked by the tests.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace rasterisers {

/// What the tool writes to standard output; the test fails where the tool does.
std::string runTool(const std::vector<std::string>& arguments, const std::string& input = "");

/// The same for records: one JSON value in, one out.
std::vector<nlohmann::json> filter(const std::vector<std::string>& arguments,
                                   const std::vector<nlohmann::json>& records);

}  // namespace rasterisers
