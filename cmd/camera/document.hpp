// A JSON or YAML document as a value, and its parts with their paths. All code that reads a document reports errors
// through Node, so every message names the file and the field.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

#include "viewproj/vectors.hpp"

namespace viewproj::cmd {

using Json = nlohmann::json;

struct Document {
  std::string name;                                          ///< in messages
  std::shared_ptr<Json> root;                                ///< shared by copies
  bool isTyped = false;                                      ///< made of options only: errors are UsageErrors
  std::map<std::string, std::string, std::less<>> labels{};  ///< by path: the option that set the field
  /// The values that were read, by their addresses; null: nobody asks.
  std::shared_ptr<std::unordered_set<const void*>> marks = nullptr;
  std::shared_ptr<const std::string> text{};  ///< of the file, where it is short
  bool isPlainText = false;          ///< the file is no JSON, YAML, XML or table: keys and numbers, or anything else
  std::vector<std::string> notes{};  ///< on what options made of it
  std::string fault{};               ///< of a text that began like JSON, YAML or XML: what is wrong with it as that
};

/// The longest text of a document, in bytes.
inline constexpr std::size_t kMostDocumentBytes = 64 << 20;

/// Reads a file, "-" for standard input, or the JSON itself if source begins with "{" or, without a file of that name,
/// with "[". Accepts JSON with comments, and YAML. option: the name for inline JSON in messages. Throws InputError,
/// also for longer texts, values nested deeper than 200, and a key that an object has twice.
Document load(const std::string& source, const std::string& option);
/// Whether load() takes it for the JSON itself.
bool isInlineJson(const std::string& source);
/// Reads a text. name: of its file, in messages.
Document parseDocument(const std::string& name, std::string text);

/// Renames aliases of our own form to the fields' names, and turns a convention's name into an object. Throws if both
/// names are there.
void normalize(Document& document);
/// The value at a path of an object, or null.
const Json* valueAt(const Json& root, std::string_view path);
/// The same place to put a value. Objects on the way are made. Throws Json::exception if a value is in the way.
Json& placeAt(Json& root, std::string_view path);

/// A value of a document and its path, such as "projection.fovY". The document must outlive it.
class Node {
 public:
  explicit Node(const Document& document);
  Node(const Document& document, const Json& value, std::string path);

  const Document& document() const { return *document_; }
  const Json& json() const { return *value_; }
  const std::string& path() const { return path_; }

  /// Notes that the value was read: its numbers, text or flag, or all of it.
  void mark() const;
  bool isMarked() const;

  /// A member of an object; null counts as absent. Throws if this is not an object.
  std::optional<Node> find(std::string_view key) const;
  /// The first of several aliases that is present.
  std::optional<Node> findAny(std::initializer_list<std::string_view> keys) const;
  Node require(std::string_view key) const;
  /// The size of an array. Throws if this is not an array.
  std::size_t size() const;
  Node operator[](std::size_t index) const;

  double number() const;
  const std::string& text() const;
  bool flag() const;
  /// This many numbers (0: any): an array of any nesting, {"x", "y", "z"}, or a matrix of OpenCV ({"rows", "cols",
  /// "data"}).
  std::vector<double> numbers(std::size_t count = 0) const;
  bool holdsNumbers(std::size_t count) const;
  Vec3 vec3() const;
  /// 4 rows of 4, or 16 numbers. For 3 rows of 4, or 12 numbers, the last row is 0 0 0 1.
  Mat4 mat4() const;

  /// "FILE: projection.fovY", or the option or --set that set it; and whether it came from the command line.
  std::pair<std::string, bool> place() const;
  /// Fails with "FILE: projection.fovY: expected MESSAGE, got 200", or with an option or --set instead of file and
  /// field. Throws InputError, or UsageError for what came from the command line.
  [[noreturn]] void fail(const std::string& message) const;

 private:
  const Document* document_;
  const Json* value_;
  std::string path_;
};

/// "projection.fovY" from "projection" and "fovY".
std::string joinedPath(std::string_view path, std::string_view key);

}  // namespace viewproj::cmd
