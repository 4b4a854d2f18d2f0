// A JSON or YAML document as a value, and the values in it with their paths. All that reads one fails through Node, so
// that every message names the file and the field.
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
  std::string name;                                          ///< as messages name it
  std::shared_ptr<Json> root;                                ///< copies share it
  bool isTyped = false;                                      ///< made of options alone: what is wrong is a UsageError
  std::map<std::string, std::string, std::less<>> labels{};  ///< by path: the option that gave the field
};

/// Reads a file, "-" for standard input, or the JSON itself where it starts with "{": JSON with comments, YAML, the
/// JSON of a .glb, a folder of COLMAP. option names inline JSON in messages. Throws InputError: also for more than 64
/// MiB, values nested deeper than 200, and a key that an object has twice.
Document load(const std::string& source, const std::string& option);

/// A value of a document and the path that leads to it, "projection.fovY". The document must outlive it.
class Node {
 public:
  explicit Node(const Document& document);
  Node(const Document& document, const Json& value, std::string path);

  const Document& document() const { return *document_; }
  const Json& json() const { return *value_; }
  const std::string& path() const { return path_; }

  /// The member of an object; null counts as absent. Throws where this is no object.
  std::optional<Node> find(std::string_view key) const;
  /// The first of several names of one member that is there.
  std::optional<Node> findAny(std::initializer_list<std::string_view> keys) const;
  Node require(std::string_view key) const;
  /// Elements of an array. Throws where this is none.
  std::size_t size() const;
  Node operator[](std::size_t index) const;

  double number() const;
  const std::string& text() const;
  bool flag() const;
  /// So many numbers (0: any): an array of any nesting, {"x", "y", "z"}, or a matrix of OpenCV ({"rows", "cols",
  /// "data"}).
  std::vector<double> numbers(std::size_t count = 0) const;
  bool holdsNumbers(std::size_t count) const;
  Vec3 vec3() const;
  /// 4 rows of 4; of 3 rows of 4, or of 12 numbers, the last row is 0 0 0 1.
  Mat4 mat4() const;

  /// "FILE: projection.fovY", or the option that gave it; and whether it is an option.
  std::pair<std::string, bool> place() const;
  /// "FILE: projection.fovY: MESSAGE (is 200)", or the option in place of file and field. Throws InputError, and
  /// UsageError for a document of options.
  [[noreturn]] void fail(const std::string& message) const;

 private:
  const Document* document_;
  const Json* value_;
  std::string path_;
};

/// "projection.fovY" from "projection" and "fovY".
std::string joinedPath(std::string_view path, std::string_view key);

}  // namespace viewproj::cmd
