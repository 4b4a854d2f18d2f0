// A JSON or YAML document read as a whole (a camera file), whose every complaint names the field: of JSON its line and
// column too.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "input/field.hpp"
#include "viewproj/vectors.hpp"

namespace viewproj::cmd {

struct Kind;

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
  /// whose only field, of this name, it is; the JSON itself may then start with "[" too. Under a key of no letters its
  /// entries are told by their numbers alone.
  Document(const std::string& source, const std::string& option, const char* arrayKey = nullptr);
  struct Typed {};
  /// An empty object that the command line fills: what is wrong in it is a UsageError, in the words of options.
  Document(Typed, const std::string& name);
  ~Document();
  Document(const Document&) = delete;
  Document& operator=(const Document&) = delete;

  const nlohmann::json& root() const { return *root_; }
  const std::string& name() const { return name_; }
  /// Whether it was an array.
  bool isArray() const { return isArray_; }

  /// The kinds of camera files that are tried before those that are built in. They must outlive the document.
  void setKinds(std::span<const Kind> kinds) { ownKinds_ = kinds; }
  std::span<const Kind> ownKinds() const { return ownKinds_; }

  /// Sets a field. Throws UsageError where there is no place for it.
  void set(const Assignment& assignment);

  /// Sets a field to what an option gives; empty: to what follows from one. Of a path, all but the last step is an
  /// object or not there.
  void give(const Path& path, nlohmann::json value, const std::string& option);
  void drop(const Path& path);
  /// Names a field in messages after the option that gives it.
  void label(const Path& path, const std::string& option);
  /// Whether all of it comes from options.
  bool isTyped() const { return isTyped_; }

  /// Whether the field or one within it was set.
  bool isSet(const std::string& field) const;

  /// The paths of the fields that were set.
  const std::vector<Path>& sets() const { return setPaths_; }
  /// What stands there; null where nothing does.
  const nlohmann::json* at(const Path& path) const;
  /// Calls look while another value stands at a path, where there is one. No note is kept of what it reads.
  void tryOut(const Path& path, nlohmann::json value, const std::function<void()>& look);

  /// Throws for a field that was set and that no reader has looked at. form: what the file is.
  void requireSetsRead(const std::string& form) const;

  /// Names the path, in JSON its place, and, unless told not to, the value there.
  [[noreturn]] void fail(const Path& path, const std::string& message, bool showValue = true) const;

  /// So many messages of one document have places: each takes a look through the text.
  static constexpr std::size_t kMostPlaced = 100;

  /// What is read as it stands, but probably not meant; with its place.
  void note(const Path& path, const std::string& message) const;
  const std::vector<std::string>& notes() const { return notes_; }
  /// Those since the last time.
  std::vector<std::string> takeNotes() const { return std::exchange(notes_, {}); }

  /// Something that holds as long as it is there.
  class [[nodiscard]] Meanwhile {
   public:
    explicit Meanwhile(bool& flag) : flag_(&flag), before_(std::exchange(flag, true)) {}
    ~Meanwhile() { *flag_ = before_; }
    Meanwhile(const Meanwhile&) = delete;
    Meanwhile& operator=(const Meanwhile&) = delete;

   private:
    bool* flag_;
    bool before_;
  };
  /// Messages name no line: looking one up takes a look through the text.
  Meanwhile withoutPlaces() const { return Meanwhile(leavesPlacesOut_); }
  /// What is looked at does not count as read.
  Meanwhile withoutReading() const { return Meanwhile(countsNoReads_); }

 private:
  /// The text as a value. Throws InputError.
  void readText();
  std::string placed(const Path& path, const std::string& message) const;
  friend class ObjectReader;
  friend class ObjectList;
  void noteRead(const Path& path, bool andBelow) const;
  bool isAllRead() const { return unread_.empty(); }

  std::string name_;
  std::string text_;
  std::unique_ptr<nlohmann::json> root_;
  bool isTyped_ = false, isArray_ = false, isYaml_ = false;
  std::set<std::string> set_;
  std::vector<Path> setPaths_;
  std::span<const Kind> ownKinds_;
  std::unordered_map<std::string, std::string> places_;  ///< of what is no JSON and no YAML, by its first two keys
  std::map<std::string, std::string> options_;           ///< by the fields that they give
  mutable std::set<std::string> unread_;                 ///< of set_
  mutable std::vector<std::string> notes_;
  mutable std::size_t noted_ = 0;  ///< in all
  mutable bool leavesPlacesOut_ = false, countsNoReads_ = false;
};

class ObjectList;

/// What a value of an object is looked for by: its name, or the row of its field, whose other names and forms then
/// count too.
struct Key {
  Key(const char* text) : name(text) {}              // NOLINT(google-explicit-constructor)
  Key(std::string_view text) : name(text) {}         // NOLINT(google-explicit-constructor)
  Key(const std::string& text) : name(text) {}       // NOLINT(google-explicit-constructor)
  Key(const Field& row) : name(row), field(&row) {}  // NOLINT(google-explicit-constructor)

  std::string_view name;
  const Field* field = nullptr;
};

/// An object of a document, read key by key. A key whose value is null counts as absent.
class ObjectReader {
 public:
  ObjectReader(const Document& document, const nlohmann::json& object, Path path);

  bool has(const Key& key) const;
  bool isString(const Key& key) const;
  bool isObject(const Key& key) const;
  bool isArray(const Key& key) const;
  std::optional<double> number(const Key& key) const;
  std::optional<bool> flag(const Key& key) const;
  std::optional<std::string> string(const Key& key) const;
  std::optional<std::string_view> text(const Key& key) const;  ///< a string, which stays the document's
  std::optional<std::vector<double>> numbers(const Key& key, std::size_t fewest, std::size_t most) const;
  std::optional<Vec3> vec3(const Key& key) const;
  std::optional<Mat4> mat4(const Key& key) const;
  std::optional<std::vector<Vec3>> vec3s(const Key& key, std::size_t count) const;
  std::optional<ObjectReader> object(const Key& key) const;

  /// The value of key as JSON text, where it is a string or a number.
  std::optional<std::string> label(const Key& key) const;
  /// The objects of an array; none where it is absent.
  ObjectList objects(const Key& key) const;
  /// A whole number from 0 on and below count, which is how many `what` there are.
  std::optional<std::size_t> index(const Key& key, std::size_t count, const char* what) const;
  std::vector<std::size_t> indices(const Key& key, std::size_t count, const char* what) const;

  double numberOr(const Key& key, double fallback) const { return number(key).value_or(fallback); }
  double requireNumber(const Key& key) const;

  /// The value of key as a name of a table of {name, value} rows.
  template <class Table>
  auto choice(const Key& key, const Table& table) const {
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

  [[noreturn]] void fail(const Key& key, const std::string& message) const;
  /// For the object as a whole.
  [[noreturn]] void fail(const std::string& message) const;

  /// The value of key, unless it is absent or null.
  const nlohmann::json* find(const Key& key) const;
  /// Where it stands.
  Path pathOf(const Key& key) const;

 private:
  [[noreturn]] void failChoice(const Key& key, const std::string& name,
                               const std::vector<std::string_view>& known) const;
  /// The name that it has in the object, and its value; or null.
  std::pair<std::string_view, const nlohmann::json*> lookUp(const Key& key) const;
  void allowKey(const std::string& key, const ObjectForm& form) const;

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
