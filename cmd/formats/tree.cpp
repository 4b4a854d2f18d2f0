#include "formats/tree.hpp"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "formats/format.hpp"
#include "formats/value.hpp"
#include "text/error.hpp"
#include "text/file.hpp"
#include "text/json_text.hpp"
#include "text/npy.hpp"
#include "text/number.hpp"
#include "text/system.hpp"
#include "text/utf8.hpp"
#include "text/xml_text.hpp"
#include "text/yaml_text.hpp"

namespace viewproj::cmd {
namespace {

/// The longest text that is kept beside the tree.
constexpr std::size_t kShort = 1 << 20;

/// Whether the first line with words is a heading, such as [image].
bool beginsWithHeading(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string_view line = text.substr(at, end - at);
    at = end + 1;
    if (line.ends_with('\r')) line.remove_suffix(1);
    line = trimmed(line);
    if (line.empty() || line[0] == '#') continue;
    return line.size() > 2 && line[0] == '[' && isLetter(line[1]) && line.find(']') == line.size() - 1;
  }
  return false;
}

/// "[OpenXR] eye 0" of a log: a bracket and a word that is none of JSON's.
bool beginsWithWord(std::string_view text) {
  std::size_t end = 1;
  while (end < text.size() && isLetter(text[end])) ++end;
  const std::string_view word = text.substr(1, end - 1);
  return text[0] == '[' && !word.empty() && word != "true" && word != "false" && word != "null" && word != "NaN" &&
         word != "Infinity" && word != "nan" && word != "inf";
}

/// [{"name": "k1", "value": 0.1}, ...]: an object, as some programs write it.
bool isNamedValues(const Json& value) {
  return value.is_array() && !value.empty() && std::all_of(value.begin(), value.end(), [](const Json& part) {
           return part.is_object() && part.size() == 2 && part.contains("value") && part.contains("name") &&
                  part["name"].is_string();
         });
}

/// A matrix {"rows", "cols", "data"} becomes its rows, or the list of its numbers if it has one row or column; a list
/// of names and values their object.
void unfoldMatrices(Json& value) {
  const auto sideOf = [&](const char* key) {
    const auto numbers = value.contains(key) ? numbersIn(value[key]) : std::nullopt;
    return numbers && numbers->size() == 1 ? numbers->front() : 1;
  };
  if (value.is_object() && value.contains("data") && (value.contains("rows") || value.contains("cols")))
    if (const auto numbers = value["data"].is_object() ? std::nullopt : numbersIn(value["data"])) {
      const double rows = sideOf("rows"), columns = sideOf("cols");
      const bool isMatrix = rows > 1 && columns > 1 && rows * columns == static_cast<double>(numbers->size());
      value = isMatrix ? rowsOf(*numbers, static_cast<std::size_t>(columns)) : Json(*numbers);
      return;
    }
  if (isNamedValues(value)) {
    Json members = Json::object();
    for (const Json& part : value) members[part["name"].get<std::string>()] = part["value"];
    if (members.size() == value.size()) value = std::move(members);
  }
  if (value.is_structured() && !(value.is_array() && !value.empty() && value.front().is_number()))
    for (Json& part : value) unfoldMatrices(part);
}

/// Whether texts with numbers in them are all that it holds, "(1, 2, 3)", "X=1 Y=2", or all beside numbers.
bool holdsTexts(const Json& root) {
  if (root.is_array())  // items of a list, as "Rotation: in Quaternion [1, 0, 0, 0]"
    return std::any_of(root.begin(), root.end(), [](const Json& item) {
      return item.is_object() && item.size() == 1 && item.front().is_string() && holdsTexts(item) &&
             item.front().get_ref<const std::string&>().ends_with(']');
    });
  if (!root.is_object()) return false;
  bool hasTexts = false, hasMarks = false, hasNumbers = false;
  for (const Json& value : root) {
    if (value.is_structured()) return false;
    const std::string text = value.is_string() ? value.get<std::string>() : "";
    const bool isText = text.find_first_of("0123456789") != std::string::npos;
    hasTexts = hasTexts || (isText && isLetter(text.front()));
    hasMarks = hasMarks || (isText && text.find_first_of("(=") != std::string::npos);
    hasNumbers = hasNumbers || value.is_number();
  }
  return hasMarks || (hasTexts && !hasNumbers);
}

/// Sets the document's tree, and what it keeps of the text.
void readText(Document& document, std::string text, bool isInline) {
  document.text = std::make_shared<const std::string>(text.size() <= kShort ? text : "");
  document.root = std::make_shared<Json>();
  Json& root = *document.root;
  const auto fail = [&](const JsonFault& fault) {
    const std::string full = place(document.name, positionAt(text, fault.offset)) + ": " + visible(fault.message);
    // What begins like an object of JSON is meant as one.
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    const std::size_t second = text.find_first_not_of(" \t\r\n", first + 1);
    if (text[first] == '{' && second != std::string::npos && (text[second] == '"' || text[second] == '}'))
      throw InputError(full);
    document.fault = full;
    document.isPlainText = true;
    bool hasHeadings = false;
    root = textTree(text, &hasHeadings);
    if (hasHeadings) document.fault.clear();
    if (root.empty()) throw UnknownFormat(full, *document.text);
  };
  text.erase(0, text.size() - withoutByteOrderMark(text).size());
  std::size_t start = text.find_first_not_of(" \t\r\n");
  if (start == std::string::npos) throw InputError(document.name + ": is empty; expected JSON");
  if (text[start] == '/') {  // a comment of JSON
    std::string bare = text;
    blankComments(bare);
    const std::size_t next = bare.find_first_not_of(" \t\r\n");
    if (next != std::string::npos && opensJson(bare[next])) start = next;
  }
  const char first = text[start];
  if (first == '<' && start + 1 < text.size() &&
      (isLetter(text[start + 1]) || text[start + 1] == '?' || text[start + 1] == '!')) {
    if (const auto fault = parseXml(text, kDeepestJson, root)) fail(*fault);
    return;
  }
  if (opensJson(first) && !beginsWithWord(std::string_view(text).substr(start)) && !beginsWithHeading(text)) {
    blankComments(text);
    if (const auto fault = parseJson(text, root)) fail(*fault);
    return;
  }
  if (isInline) return;
  root = tableTree(text);
  if (root.is_null()) root = tagTree(text);
  if (!root.is_null()) return;
  if (looksLikeYaml(text)) {
    const auto fault = parseYaml(text, kDeepestJson, root);
    if (fault) return fail(*fault);
    if (root.is_structured() && !holdsTexts(root)) return;
  }
  Json keys = textTree(text);
  if (keys.empty() && root.is_structured()) return;
  document.isPlainText = true;
  root = std::move(keys);
  if (root.empty())
    throw UnknownFormat(
        document.name + ": is neither JSON nor YAML, as camera files are; viewproj help formats lists them",
        *document.text);
}

/// Of a folder of a stereo calibration, its first file.
std::string insideFolder(const std::string& source) {
  for (const char* file : {"/intrinsics.yml", "/intrinsics.yaml", "/intri.yml"})
    if (isFile(pathOf(source + file))) return source + file;
  return source;
}

}  // namespace

void addOtherFile(const Document& file) {
  for (const auto& [word, other] : {std::pair{"intri", "extri"}, {"extri", "intri"}}) {
    std::string name = file.name;
    const std::size_t at = name.rfind(word);
    if (at == std::string::npos) continue;
    name.replace(at, std::string_view(word).size(), other);
    if (!isFile(pathOf(name))) continue;
    const Document beside = readTree(name, "");
    if (beside.root->is_object()) file.root->insert(beside.root->begin(), beside.root->end());
  }
}

Document readTree(const std::string& source, const std::string& option, ReadingTree taken) {
  const bool isInline = isInlineJson(source);
  const std::string name = isInline ? option : insideFolder(source);
  Document document{isInline ? option : shownName(name), nullptr};
  if (isInline) {
    readText(document, source, true);
  } else {
    std::string bytes = readWithoutGlb(name, kMostDocumentBytes);
    if (const char* const why = taken.mayBeRefused ? nullptr : refusalOf(name, bytes))
      throw InputError(document.name + ": " + why);
    if (isNumpy(bytes)) {
      Json arrays = readNumpy(document.name, bytes);
      document.root = std::make_shared<Json>(arrays.is_object() ? std::move(arrays) : Json{{"#1", std::move(arrays)}});
      return document;
    }
    requireNarrow(document.name, bytes);
    readText(document, std::move(bytes), false);
  }
  if (!document.fault.empty() && !taken.mayBeFaulty) throw UnknownFormat(document.fault, *document.text);
  unfoldMatrices(*document.root);
  return document;
}

}  // namespace viewproj::cmd
