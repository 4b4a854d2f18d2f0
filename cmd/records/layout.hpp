// Which numbers of a record a command works on, and how they are read.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "records/record.hpp"

namespace viewproj::cmd {

/// What an array of three numbers may be, and an object in its place.
enum class PointForm : unsigned char {
  none,
  vector,      ///< x, y, z and no place
  point,       ///< x, y, z
  ofTheEarth,  ///< a place as well, so that it is none: an object says which
};

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
  char first = '{';  ///< of JSON: { or [
  bool is = true;

  bool holds(std::string_view value) const;
};

/// Where records of one shape have their numbers.
struct Layout {
  std::vector<NumberField> parts = {};
  unsigned kind = 0;                    ///< what the command makes of them, in its own words
  std::vector<FormOfField> forms = {};  ///< of JSON values: records that differ in one have another layout
  std::vector<std::string> notes = {};  ///< on how fields are read

  std::size_t slots() const;
  /// Whether records with these values, as written, have it.
  bool fits(const std::vector<std::string_view>& values) const;
  void append(const Layout& more);
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

/// Whether a JSON value has the form of a point, whatever its numbers: three or four in an array, or an object of x, y,
/// z or lat, lon, height.
bool isPointValue(std::string_view json);

/// Of three numbers that may be a place or not, with a camera on the Earth. way: how to say which.
std::string bareTriple(const std::string& way);
inline constexpr const char* kNotOnEarth =
    "lat, lon, height need a camera that stands on the Earth: a position by lat, lon, height, or \"world\": \"ecef\"";

}  // namespace viewproj::cmd
