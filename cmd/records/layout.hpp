// Which numbers of a record a command works on.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "records/point_value.hpp"
#include "records/record.hpp"

namespace viewproj::cmd {

/// A field, or a part of one, that is a number or an array of numbers.
struct NumberField {
  std::size_t field = 0;              ///< its index among the record's
  std::size_t fewest = 1, most = 1;   ///< numbers
  bool isArray = false;               ///< false: the field is the number itself
  bool mayBeAbsent = false;           ///< null, an empty CSV cell, NaN in text and f64: stands for no value
  std::string inner = {};             ///< JSON: what this key of the field's object holds; empty: the value itself
  std::size_t item = 0, items = 0;    ///< JSON: this item of the field's array of so many; 0: the value itself
  PointForm point = PointForm::none;  ///< JSON: of an array that may be an object too
};

/// A field counts by the form of its value: such records have one that begins so, or that does not.
struct FormOfField {
  static constexpr char kPoint = 'p';  ///< instead of a first character: it is a point by isPointValue
  std::size_t field = 0;
  char first = '{';  ///< of JSON: { [ or "
  bool is = true;

  bool holds(std::string_view value) const {
    return (first == kPoint ? isPointValue(value) : value.starts_with(first)) == is;
  }
};

/// Where records of one shape have their numbers.
struct Layout {
  std::vector<NumberField> parts;
  unsigned kind = 0;                    ///< what the command makes of them, in its own words
  std::vector<FormOfField> forms = {};  ///< of JSON values: records that differ in one have another layout
  std::vector<std::string> notes = {};  ///< on what the fields are taken for

  std::size_t slots() const;
  /// Whether records with these values, as written, have it.
  bool fits(const std::vector<std::string_view>& values) const;
};

inline constexpr std::size_t kMostNumbers = 9;

/// Part after part, each with as many slots as it has numbers at most; NaN in those that have no value.
struct Numbers : std::array<double, kMostNumbers> {
  std::string seaLevel = {};  ///< the name of a height that may be counted from the sea
};

/// For each slot the part of a record that its number was read from, as it stands there; empty where there is none.
using NumberTexts = std::array<std::string_view, kMostNumbers>;

/// Throws RecordError.
void readNumbers(const RecordParts& record, const Layout& layout, Numbers& numbers, NumberTexts* texts = nullptr);

}  // namespace viewproj::cmd
