// Reads XML into JSON values. The only file that calls pugixml.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string_view>

#include "text/json_scan.hpp"

namespace viewproj::cmd {

/// The root element becomes {"tag": value}, except that of OpenCV's FileStorage, which becomes its members. An element
/// is an object of its attributes ("@name"), its text ("#text") and its children; children of one name are an array.
/// An element of text alone is that text, one of a name and a value or text is a member of that name, and one of <_>
/// elements an array. All values are texts. Returns what is wrong with the text. Nesting deeper than `deepest` and a
/// document type are errors too.
std::optional<JsonFault> parseXml(std::string_view text, std::size_t deepest, nlohmann::json& value);

}  // namespace viewproj::cmd
