// Which numbers of a record a command works on.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "input/record.hpp"

namespace viewproj::cmd {

/// A field, or a part of one, that is a number or an array of numbers.
struct NumberField {
  std::size_t field = 0;             ///< its index among the record's
  std::size_t fewest = 1, most = 1;  ///< numbers
  bool isArray = false;              ///< false: the field is the number itself
  bool mayBeAbsent = false;          ///< null, an empty CSV cell, NaN in text and f64: stands for no value
  std::string inner = {};            ///< JSON: what this key of the field's object holds; empty: the value itself
  std::size_t item = 0, items = 0;   ///< JSON: this item of the field's array of so many; 0: the value itself
};

/// Where records of one shape have their numbers.
struct Layout {
  std::vector<NumberField> parts;
  unsigned kind = 0;  ///< what the command makes of them, in its own words

  std::size_t slots() const;
};

inline constexpr std::size_t kMostNumbers = 9;

/// Part after part, each with as many slots as it has numbers at most; NaN in those that have no value.
using Numbers = std::array<double, kMostNumbers>;

/// Throws RecordError.
void readNumbers(const RecordParts& record, const Layout& layout, Numbers& numbers);

}  // namespace viewproj::cmd
