// What a result is: its name and its kind.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "text/names.hpp"

namespace viewproj::cmd {

enum class ResultKind : unsigned char {
  number,
  vector,  ///< two to four numbers, null as a whole
  flag,
  names,  ///< a list of words, left out where it may be and is empty
  word,
  json,   ///< a value of the input: a string or a number
  group,  ///< an object of parts
  list,   ///< of such objects
};

/// When a result is given.
enum class Given : unsigned char {
  everywhere,  ///< by default
  named,       ///< by default where results have names: not in text and f64
  asked,       ///< where an option or a field of the record asks for it
};

struct ResultRow {
  std::string_view name;  ///< as JSON has it
  ResultKind kind = ResultKind::number;
  std::size_t size = 1;  ///< numbers of a vector
  std::span<const ResultRow* const> parts = {};
  Given given = Given::everywhere;
  std::span<const std::string_view> suffixes = kColumnSuffixes;  ///< of a vector's columns

  consteval ResultRow whereNamed() const { return givenAs(Given::named); }
  consteval ResultRow asked() const { return givenAs(Given::asked); }
  consteval ResultRow givenAs(Given when) const {
    ResultRow row = *this;
    row.given = when;
    return row;
  }
  consteval ResultRow inColumns(std::span<const std::string_view> names) const {
    ResultRow row = *this;
    row.suffixes = names;
    return row;
  }
};

using ResultParts = std::span<const ResultRow* const>;

consteval ResultRow numberResult(std::string_view name) { return {name}; }
consteval ResultRow vectorResult(std::string_view name, std::size_t size) { return {name, ResultKind::vector, size}; }
consteval ResultRow groupResult(std::string_view name, ResultParts parts) {
  return {name, ResultKind::group, 1, parts};
}

using Results = std::vector<const ResultRow*>;

}  // namespace viewproj::cmd
