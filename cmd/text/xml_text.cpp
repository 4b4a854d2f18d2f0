#include "text/xml_text.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>
#include <string>

#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

using nlohmann::json;

class Reader {
 public:
  explicit Reader(std::size_t deepest) : deepest_(deepest) {}

  /// Throws JsonFault.
  json valueOf(const pugi::xml_node& element, std::size_t depth) const {
    if (depth == deepest_) fail(element, "nested deeper than " + std::to_string(deepest_));
    json object = json::object();
    for (const pugi::xml_attribute& attribute : element.attributes())
      if (!object.emplace("@" + std::string(attribute.name()), attribute.value()).second)
        fail(element, "the attribute " + inQuotes(attribute.name()) + " is given twice");
    std::string text;
    json::object_t children;  // of each name
    for (const pugi::xml_node& child : element.children()) {
      if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata) text += child.value();
      if (child.type() != pugi::node_element) continue;
      json value = valueOf(child, depth + 1);
      std::string name = child.name();
      if (isNameAndValue(value)) {  // <float name="fov" value="35"/>, <float name="fov">35</float>
        name = value["@name"].get<std::string>();
        value = std::move(value[value.contains("#text") ? "#text" : "@value"]);
      }
      json& list = children[name];
      if (list.is_null()) list = json::array();
      list.push_back(std::move(value));
    }
    text = unquoted(trimmed(text));
    if (object.empty() && children.empty()) return text;
    if (!text.empty()) object["#text"] = text;
    if (object.empty() && children.size() == 1 && children.begin()->first == "_") return children.begin()->second;
    for (auto& [name, list] : children) object[name] = list.size() == 1 ? std::move(list.front()) : std::move(list);
    return object;
  }

 private:
  [[noreturn]] static void fail(const pugi::xml_node& element, const std::string& message) {
    throw JsonFault{static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, element.offset_debug())), message};
  }
  static bool isNameAndValue(const json& value) {
    return value.is_object() && value.size() == 2 && value.contains("@name") &&
           (value.contains("@value") || value.contains("#text"));
  }
  static std::string trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    if (first == std::string_view::npos) return "";
    return std::string(text.substr(first, text.find_last_not_of(" \t\r\n") + 1 - first));
  }
  static std::string unquoted(std::string text) {
    if (text.size() > 1 && text.front() == '"' && text.find('"', 1) == text.size() - 1)
      return text.substr(1, text.size() - 2);
    return text;
  }

  std::size_t deepest_;
};

}  // namespace

std::optional<JsonFault> parseXml(std::string_view text, std::size_t deepest, json& value) {
  if (const std::size_t at = text.find("<!DOCTYPE"); at != std::string_view::npos)
    return JsonFault{at, "has a document type, which is not read; take it out"};
  pugi::xml_document document;
  const pugi::xml_parse_result result =
      document.load_buffer(text.data(), text.size(), pugi::parse_default, pugi::encoding_utf8);
  if (result.status == pugi::status_out_of_memory) throw std::bad_alloc();
  const pugi::xml_node root = document.document_element();
  if (!result || !root)
    return JsonFault{std::min(text.size(), static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, result.offset))),
                     "not valid XML: an element does not end, or a name or a quote is missing"};
  try {
    json read = Reader(deepest).valueOf(root, 0);
    value = std::string_view(root.name()) == "opencv_storage" ? std::move(read) : json{{root.name(), std::move(read)}};
  } catch (const JsonFault& fault) {
    return fault;
  }
  return std::nullopt;
}

}  // namespace viewproj::cmd
