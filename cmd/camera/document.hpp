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
  std::shared_ptr<const std::string> text{};                 ///< of the file, where it is short
};

/// Reads a file, "-" for standard input, or the JSON itself if source begins with "{". Accepts JSON with comments,
/// YAML, the JSON of a .glb, a folder of COLMAP. option: the name for inline JSON in messages. Throws InputError, also
/// for more than 64 MiB, values nested deeper than 200, and a key that an object has twice.
Document load(const std::string& source, const std::string& option);

/// A value of a document and its path, such as "projection.fovY". The document must outlive it.
class Node {
 public:
  explicit Node(const Document& document);
  Node(const Document& document, const Json& value, std::string path);

  const Document& document() const { return *document_; }
  const Json& json() const { return *value_; }
  const std::string& path() const { return path_; }

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

  /// "FILE: projection.fovY", or the option that set it; and whether it is an option.
  std::pair<std::string, bool> place() const;
  /// Fails with "FILE: projection.fovY: MESSAGE (is 200)", or the option instead of file and field. Throws InputError,
  /// or UsageError for a document of options.
  [[noreturn]] void fail(const std::string& message) const;

 private:
  const Document* document_;
  const Json* value_;
  std::string path_;
};

/// "projection.fovY" from "projection" and "fovY".
std::string joinedPath(std::string_view path, std::string_view key);

}  // namespace viewproj::cmd
