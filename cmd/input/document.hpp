// A JSON document read as a whole (a camera file), whose every complaint names a line and a column.
#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "input/field.hpp"
#include "viewproj/vectors.hpp"

namespace viewproj::cmd {

/// Keys from the root on.
using Path = std::vector<std::string>;

/// "projection.fovY".
std::string dotted(const Path& path);
Path undotted(std::string_view path);

/// A field and its value, null to remove it.
struct Assignment {
  Path path;
  std::string text;  ///< as it was typed, for messages
  std::shared_ptr<const nlohmann::json> value;
};

/// "projection.fovY=75" or "nodes.3.camera=0"; the value is JSON, or else text. Throws UsageError.
Assignment readAssignment(const std::string& text);

class Document {
 public:
  /// source: a file name, "-" for standard input, or the JSON itself if it starts with "{". Of a .glb file the JSON in
  /// it counts, places too. option names it in messages. arrayKey: a document that is an array counts as an object
  /// whose only field, of this name, it is; the JSON itself may then start with "[" too.
  Document(const std::string& source, const std::string& option, const char* arrayKey = nullptr);
  ~Document();
  Document(const Document&) = delete;
  Document& operator=(const Document&) = delete;

  const nlohmann::json& root() const { return *root_; }
  const std::string& name() const { return name_; }

  /// Sets a field. Throws UsageError where there is no place for it.
  void set(const Assignment& assignment);

  /// Whether the field or one within it was set.
  bool isSet(const std::string& field) const;

  /// Throws for a field that was set and that no reader has looked at. form: what the file is.
  void requireSetsRead(const std::string& form) const;

  /// Names the place of the path and, unless told not to, the value there.
  [[noreturn]] void fail(const Path& path, const std::string& message, bool showValue = true) const;

  /// What is read as it stands, but probably not meant; with its place.
  void note(const Path& path, const std::string& message) const;
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  std::string placed(const Path& path, const std::string& message) const;
  friend class ObjectReader;
  friend class ObjectList;
  void noteRead(const Path& path, bool andBelow) const;
  bool isAllRead() const { return unread_.empty(); }

  std::string name_;
  std::string text_;
  std::unique_ptr<nlohmann::json> root_;
  std::set<std::string> set_;
  mutable std::set<std::string> unread_;  ///< of set_
  mutable std::vector<std::string> notes_;
};

class ObjectList;

/// An object of a document, read key by key. A key whose value is null counts as absent.
class ObjectReader {
 public:
  ObjectReader(const Document& document, const nlohmann::json& object, Path path);

  bool has(std::string_view key) const;
  bool isString(std::string_view key) const;
  bool isObject(std::string_view key) const;
  std::optional<double> number(std::string_view key) const;
  std::optional<bool> flag(std::string_view key) const;
  std::optional<std::string> string(std::string_view key) const;
  std::optional<std::string_view> text(std::string_view key) const;  ///< a string, which stays the document's
  std::optional<std::vector<double>> numbers(std::string_view key, std::size_t fewest, std::size_t most) const;
  std::optional<Vec3> vec3(std::string_view key) const;
  std::optional<Mat4> mat4(std::string_view key) const;
  std::optional<std::vector<Vec3>> vec3s(std::string_view key, std::size_t count) const;
  std::optional<ObjectReader> object(std::string_view key) const;

  /// The value of key as JSON text, where it is a string or a number.
  std::optional<std::string> label(std::string_view key) const;
  /// The objects of an array; none where it is absent.
  ObjectList objects(std::string_view key) const;
  /// A whole number from 0 on and below count, which is how many `what` there are.
  std::optional<std::size_t> index(std::string_view key, std::size_t count, const char* what) const;
  std::vector<std::size_t> indices(std::string_view key, std::size_t count, const char* what) const;

  double numberOr(std::string_view key, double fallback) const { return number(key).value_or(fallback); }
  double requireNumber(std::string_view key) const;

  /// The value of key as a name of a table of {name, value} rows.
  template <class Table>
  auto choice(std::string_view key, const Table& table) const {
    std::optional<decltype(std::begin(table)->second)> result;
    if (const auto name = string(key)) {
      std::vector<std::string_view> names;
      for (const auto& [known, value] : table) {
        names.push_back(known);
        if (known == *name) result = value;
      }
      if (!result) failChoice(key, *name, names);
    }
    return result;
  }

  /// Throws at a key that is not one of the form's, naming the nearest.
  void allow(const ObjectForm& form) const;
  /// The one way of the form that the object uses: all that it needs is there, and no field of another. Null where it
  /// uses none and need not.
  const Way* way(const ObjectForm& form) const;

  const nlohmann::json& json() const { return *object_; }
  const Document& document() const { return *document_; }
  const Path& path() const { return path_; }

  [[noreturn]] void fail(std::string_view key, const std::string& message) const;
  /// For the object as a whole.
  [[noreturn]] void fail(const std::string& message) const;

  /// The value of key, unless it is absent or null.
  const nlohmann::json* find(std::string_view key) const;

 private:
  [[noreturn]] void failChoice(std::string_view key, const std::string& name,
                               const std::vector<std::string_view>& known) const;
  Path pathOf(std::string_view key) const;

  const Document* document_;
  const nlohmann::json* object_;
  Path path_;
};

/// The objects of an array. What reads one is made when it is asked for, so that a million of them take no room.
class ObjectList {
 public:
  ObjectList() = default;
  /// Throws where one of them is no object.
  ObjectList(const Document& document, const nlohmann::json& array, Path path);

  std::size_t size() const;
  bool empty() const { return size() == 0; }
  ObjectReader operator[](std::size_t index) const;

  struct Iterator {
    const ObjectList* list;
    std::size_t index;
    ObjectReader operator*() const { return (*list)[index]; }
    Iterator& operator++() {
      ++index;
      return *this;
    }
    bool operator!=(const Iterator& other) const { return index != other.index; }
  };
  Iterator begin() const { return {this, 0}; }
  Iterator end() const { return {this, size()}; }

 private:
  Path pathOf(std::size_t index) const;

  const Document* document_ = nullptr;
  const nlohmann::json* array_ = nullptr;
  Path path_;
};

}  // namespace viewproj::cmd
