// What a document may say. A field is declared once, as a row; its readers, the schema of a camera and help go by
// the row.
#pragma once

#include <array>
#include <functional>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace viewproj::cmd {

/// What the value of a field has to be. null stands for an absent field everywhere.
enum class ValueForm {
  anything,
  text,
  label,  ///< a text or a number
  flag,
  number,
  positive,    ///< a number above 0
  natural,     ///< a number from 0 on
  zero,        ///< a number that can only be 0
  ratio,       ///< a number above 0, or a text as in 16/9
  angle,       ///< degrees between 0 and 180; like all angles also a text with a unit, 60deg or 1.0472rad
  elevation,   ///< degrees from -90 to 90
  turn,        ///< degrees
  pair,        ///< two numbers
  range,       ///< two numbers that differ
  triple,      ///< three numbers
  turns,       ///< three turns
  direction,   ///< x, y, z of any length but 0
  position,    ///< x, y, z, or a place
  quaternion,  ///< x, y, z, w of any length but 0
  rigid,       ///< a matrix of a rotation and a translation
  points,      ///< three points
  word,        ///< one of the row's words
  object,      ///< of the row's fields
  objects,     ///< an array of them
};

using Words = std::vector<std::string_view> (*)();

/// The first column of a table of names and values.
template <const auto& Table>
std::vector<std::string_view> namesOf() {
  std::vector<std::string_view> names;
  for (const auto& row : Table) names.push_back(row.first);
  return names;
}

struct ObjectForm;

struct Field {
  std::string_view name;
  ValueForm form;
  std::string_view help;                        ///< one line: what it is, its unit, what it is by default
  Words words = nullptr;                        ///< of a word
  const ObjectForm* object = nullptr;           ///< of an object
  std::string_view option = {};                 ///< by which the command line gives it
  std::array<std::string_view, 4> others = {};  ///< names that count too where their value has the form; empty: none
  std::string_view hint = {};                   ///< after what was expected in place of a value that is none

  /// The row with an option.
  consteval Field typed(std::string_view name_) const {
    Field row = *this;
    row.option = name_;
    return row;
  }
  /// The row with other names.
  consteval Field also(std::initializer_list<std::string_view> names) const {
    Field row = *this;
    std::size_t count = 0;
    for (const std::string_view other : names) row.others[count++] = other;
    return row;
  }
  /// The row with a hint.
  consteval Field hinting(std::string_view text) const {
    Field row = *this;
    row.hint = text;
    return row;
  }
  constexpr std::span<const std::string_view> aliases() const {
    std::size_t count = 0;
    while (count < others.size() && !others[count].empty()) ++count;
    return std::span(others).first(count);
  }

  constexpr operator std::string_view() const noexcept { return name; }  // NOLINT(google-explicit-constructor)
};

/// What the value of a field is, in a few words: "degrees", "[x, y, z]", "top-left or bottom-left".
std::string formInWords(const Field& field);

using FieldList = std::span<const Field* const>;

/// One of the ways in which an object can say what it has to.
struct Way {
  FieldList keys;       ///< what it is known by
  FieldList with = {};  ///< what has to stand beside these
  FieldList may = {};   ///< what may
  bool anyKey = false;  ///< one of the keys is enough

  bool uses(const Field& field) const noexcept;
};

/// A name that says too little, and what to write instead.
struct VagueName {
  std::string_view name, message;
};

/// An object's fields, and the ways of which it uses one.
struct ObjectForm {
  std::string_view help;
  FieldList fields;
  FieldList required = {};
  std::span<const Way> ways = {};
  std::string_view aim = "";  ///< what the ways give; empty where none of them need be used
  std::span<const VagueName> vague = {};

  bool has(std::string_view name) const noexcept;
};

std::vector<std::string_view> namesOf(FieldList fields);

/// What an object has of its form's ways: the one that it uses, or null where it uses none and need not, or what is
/// wrong.
struct ChosenWay {
  const Way* way = nullptr;
  std::string fault;          ///< a message, or empty
  const Field* at = nullptr;  ///< the field at fault, or null for the object as a whole
};

/// spelled: how messages name a field; what it leaves empty is not named among the alternatives.
using Spelling = std::string_view (*)(const Field&);
inline std::string_view byName(const Field& field) { return field.name; }
inline std::string_view byOption(const Field& field) { return field.option; }

ChosenWay chooseWay(const ObjectForm& form, const std::function<bool(const Field&)>& has, Spelling spelled = byName);

}  // namespace viewproj::cmd
