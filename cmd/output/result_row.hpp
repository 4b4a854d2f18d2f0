// What a result is: its name, its kind, and what there is to say of it.
#pragma once

#include <limits>
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

/// What its words can be: nothing said, or one of these.
enum class ResultWords : unsigned char { any, sides, outside, verdicts };

struct ResultRow {
  std::string_view name;  ///< as JSON has it
  ResultKind kind = ResultKind::number;
  std::size_t size = 1;  ///< numbers of a vector
  std::string_view unit = {}, help = {};
  std::span<const ResultRow* const> parts = {};
  ResultWords words = ResultWords::any;
  Given given = Given::everywhere;
  bool canBeNull = false;  ///< where it has no value
  double least = -std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::infinity();
  std::span<const std::string_view> suffixes = kColumnSuffixes;  ///< of a vector's columns

  consteval ResultRow orNull() const {
    ResultRow row = *this;
    row.canBeNull = true;
    return row;
  }
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
  consteval ResultRow within(double from, double to) const {
    ResultRow row = *this;
    row.least = from;
    row.most = to;
    return row;
  }
};

using ResultParts = std::span<const ResultRow* const>;

consteval ResultRow numberResult(std::string_view name, std::string_view unit, std::string_view help) {
  return {name, ResultKind::number, 1, unit, help};
}
consteval ResultRow vectorResult(std::string_view name, std::size_t size, std::string_view unit,
                                 std::string_view help) {
  return {name, ResultKind::vector, size, unit, help};
}
consteval ResultRow flagResult(std::string_view name, std::string_view help) {
  return {name, ResultKind::flag, 1, "", help};
}
consteval ResultRow wordResult(std::string_view name, ResultWords words, std::string_view help) {
  return {name, ResultKind::word, 1, "", help, {}, words};
}
consteval ResultRow namesResult(std::string_view name, ResultWords words, std::string_view help) {
  return {name, ResultKind::names, 1, "", help, {}, words};
}
consteval ResultRow jsonResult(std::string_view name, std::string_view help) {
  return {name, ResultKind::json, 1, "", help};
}
consteval ResultRow groupResult(std::string_view name, ResultParts parts, std::string_view help) {
  return {name, ResultKind::group, 1, "", help, parts};
}
consteval ResultRow listResult(std::string_view name, ResultParts parts, std::string_view help) {
  return {name, ResultKind::list, 1, "", help, parts};
}

using Results = std::vector<const ResultRow*>;

}  // namespace viewproj::cmd
