// What a result is, and where the results of a record go.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "text/names.hpp"
#include "viewproj/vectors.hpp"

namespace viewproj::cmd {

enum class ResultKind : unsigned char {
  number,
  vector,  ///< two to four numbers, null as a whole
  flag,
  names,  ///< a list of words
  word,
  json,   ///< a value of the input: a string or a number
  group,  ///< an object of parts
  list,   ///< of such objects
};

/// Where a result is written without being named.
enum class Default : unsigned char {
  everywhere,
  named,  ///< where results have names: not in text and f64
  never,  ///< where an option or a field of the record requires it
};

struct ResultRow {
  std::string_view name;  ///< as JSON has it
  ResultKind kind = ResultKind::number;
  std::size_t size = 1;  ///< numbers of a vector
  std::span<const ResultRow* const> parts = {};
  Default byDefault = Default::everywhere;
  std::span<const std::string_view> suffixes = kColumnSuffixes;  ///< of a vector's columns

  consteval ResultRow whereNamed() const { return withDefault(Default::named); }
  consteval ResultRow onRequest() const { return withDefault(Default::never); }
  consteval ResultRow withDefault(Default where) const {
    ResultRow row = *this;
    row.byDefault = where;
    return row;
  }
  consteval ResultRow inColumns(std::span<const std::string_view> names) const {
    ResultRow row = *this;
    row.suffixes = names;
    return row;
  }
};

using Results = std::vector<const ResultRow*>;

/// Receives the results of a record, each with its row. A number that is not finite has no value: null, an empty cell,
/// or NaN.
class ResultSink {
 public:
  virtual ~ResultSink() = default;
  virtual void number(const ResultRow& row, double value) = 0;
  /// Null as a whole if one of the numbers is not finite.
  virtual void vector(const ResultRow& row, std::span<const double> values) = 0;
  void vector(const ResultRow& row, const Vec2& v) { vector(row, std::array{v.x, v.y}); }
  void vector(const ResultRow& row, const Vec3& v) { vector(row, std::array{v.x, v.y, v.z}); }
  void vector(const ResultRow& row, const Vec4& v) { vector(row, std::array{v.x, v.y, v.z, v.w}); }
  virtual void flag(const ResultRow& row, bool value) = 0;
  /// A list of words; of one, or of a JSON value as text, it is that, and of none it is null. Forms of numbers alone
  /// leave it out.
  virtual void text(const ResultRow& row, std::span<const std::string_view> words) = 0;
  void text(const ResultRow& row, std::string_view word) { text(row, {&word, word.empty() ? 0u : 1u}); }
  /// A group or a list: an object for each of `count`, whose results `write` writes. A group of none is null; in CSV
  /// and text it is the empty cells that `write` makes of values without a number. A list is for JSON alone.
  virtual void object(const ResultRow& row, std::size_t count,
                      const std::function<void(ResultSink&, std::size_t)>& write) = 0;

  /// Every record gets the same results, with or without a value.
  virtual bool hasFixedColumns() const { return false; }
  /// Numbers only, without names.
  virtual bool isText() const { return false; }
};

}  // namespace viewproj::cmd
