// A kind of camera file as data: a row says what a file is known by and where in it the numbers of a camera stand.
// kinds.json holds the rows that are built in; --format FILE brings others, in the same words.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "input/document.hpp"

namespace viewproj::cmd {

/// What a word of a row is followed by.
enum class KindValue {
  text,
  path,   ///< one place or several, of which the file has one; or a number that holds for every file
  paths,  ///< places, each by itself
  known,  ///< places with their shapes; an array among them: one of these
  word,   ///< one of some words
  number,
  preset,   ///< the name of a convention
  axes,     ///< where a camera's x, y, z point, in letters of right or left, up or down, forward or back
  views,    ///< names, and for each what differs
  allowed,  ///< places, and the values that are no obstacle there
  euler,    ///< an order, and the places of its angles
};

/// A word that a row may say. The grammar is the table of these, in kind.cpp; kind_rows.cpp reads it.
struct KindField {
  std::string_view name;
  KindValue value;
  std::string_view help;
  std::array<std::string_view, 4> words = {};  ///< of a word; the first holds where the row says none
  std::size_t numbers = 0;                     ///< of a path: how many; each of them may have a place of its own
  bool ofView = true;                          ///< may differ in the views of a kind
};
std::span<const KindField> kindFields();
/// Null where there is none of the name.
const KindField* kindField(std::string_view name);
/// How many numbers a place of this word has; 0: one, or not so many each time.
std::size_t numbersOfWord(std::string_view word);

/// Words that give a focal length: a row has one of them.
inline constexpr const char* kLensWords[] = {"K", "intrinsics", "P", "fx", "fy", "fovX", "fovY"};
/// Words that turn a camera, the first of which places it too.
inline constexpr const char* kTurnWords[] = {"matrix", "rotation", "quaternion", "rotationVector", "euler"};

/// Keys from an object on; "*" is each entry of an array or an object, "{key}" the text that the camera has under key.
using Steps = std::vector<std::string>;

/// Where a number, an array or a text stands: the first of these that the file has.
struct Where {
  std::vector<Steps> paths;
  std::optional<double> constant = {};  ///< for every file
  bool isGiven() const { return !paths.empty() || constant.has_value(); }
};

/// A place that has to be there.
struct Known {
  Steps path;
  bool fromRoot = false;                  ///< or from the camera
  std::optional<std::size_t> count = {};  ///< of numbers, in arrays of any nesting
  bool isArray = false, isObject = false;
};

struct Kind {
  std::string name, form, help;  ///< "bop", "a scene_camera.json of BOP", what it is known by
  std::vector<std::vector<Known>> known;
  std::vector<Steps> cameras, beside, needs, models;
  std::map<std::string, Where, std::less<>> places;
  std::map<std::string, std::string, std::less<>> words;
  std::map<std::string, double, std::less<>> numbers;
  struct Allowed {
    Steps path;
    std::vector<double> numbers;
    bool identity = false;
    std::vector<Steps> sameAs;
  };
  std::vector<Allowed> only;
  std::optional<std::vector<Steps>> distortion;  ///< nothing: wherever it is
  std::vector<std::string> passedOver;
  std::string view;  ///< its name, where it is one of the views of another
  std::vector<Kind> views;

  /// The places of a word of the grammar; none where the row says nothing of it.
  const Where& at(std::string_view word) const;
  bool has(std::string_view word) const { return at(word).isGiven(); }
  /// The word of the row, or the first of the grammar's.
  std::string_view word(std::string_view asked) const;
};

/// Whether a field of the name is at the end of the path, or on it where it holds others.
bool leadsTo(const Steps& path, const std::string& name, const nlohmann::json& value);
/// Whether the row looks for numbers under a name, or in what stands there.
bool readsField(const Kind& kind, const std::string& name, const nlohmann::json& value);

/// The rows of a document: one, an array of them, or an object whose "kinds" they are. earlier: those that they can be
/// like. Throws InputError.
std::vector<Kind> readKinds(const Document& document, std::span<const Kind> earlier);

/// The rows that are built in, in the order in which a file is tried.
const std::vector<Kind>& builtInKinds();
/// Their text.
std::string kindsText();

}  // namespace viewproj::cmd
