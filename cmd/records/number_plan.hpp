// Where a record has the numbers that a command needs, and how to read them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "records/record.hpp"
#include "viewproj/geodesy.hpp"

namespace viewproj::cmd {

/// What three numbers in an array may mean, and whether an object may replace the array.
enum class PointForm : unsigned char {
  none,
  vector,      ///< x, y, z, not a place
  point,       ///< x, y, z
  ofTheEarth,  ///< x, y, z or a place: three numbers alone are refused, an object is clear
};

/// A field, or a part of one, that holds a number or an array of numbers.
struct NumberField {
  std::size_t field = 0;              ///< index of the field in the record
  std::size_t fewest = 1, most = 1;   ///< how many numbers
  bool isArray = false;               ///< false: the field is the number itself
  bool mayBeAbsent = false;           ///< null, an empty CSV cell, or NaN in text and binary means no value
  std::string inner = {};             ///< JSON: where in the field's value, as in position.x; empty: the value itself
  std::size_t item = 0, items = 0;    ///< JSON: this item of an array with this many items; 0: the value itself
  PointForm point = PointForm::none;  ///< JSON: for an array that may also be an object
};

/// A condition on the form of a JSON value: it begins with this character, or it does not.
struct Condition {
  static constexpr char kPoint = 'p';  ///< instead of a first character: the value is a point by isPointValue
  std::size_t field = 0;
  char first = '{';  ///< { or [
  bool is = true;

  bool holds(std::string_view value) const;
};

struct NumberPlan {
  std::vector<NumberField> fields = {};
  unsigned kind = 0;                       ///< how the command uses them; values of its own
  bool isAboveSea = false;                 ///< of a place: its height is above sea level
  bool hasPixel = false;                   ///< the last two numbers are the pixel beside a point
  std::size_t together = 0;                ///< so many fields from the first have a value all, or none of them
  std::vector<Condition> conditions = {};  ///< records that differ in one have another plan
  std::uint32_t leftOut = 0;               ///< results of the command that records like this do not get, as bits
  std::vector<std::string> notes = {};     ///< notes for the user on how fields are read

  std::size_t slots() const;
  /// Whether records with these values have this plan.
  bool fits(std::span<const std::string_view> values) const;
  void append(const NumberPlan& more);
};

inline constexpr std::size_t kMostNumbers = 9;

/// The numbers, field after field. Each field has as many slots as it can have numbers; slots without a value are NaN.
struct Numbers : std::array<double, kMostNumbers> {
  bool isNull = false;             ///< the fields that have a value together have none
  std::string_view seaLevel = {};  ///< the name of a height that may be above sea level, as written
};

/// Throws RecordError.
void readNumbers(const RecordView& record, const NumberPlan& plan, Numbers& numbers);

/// Of a place whose height has this name: that it is above sea level, or without --geoid a note that it may be.
void noteSeaLevel(std::string_view name, NumberPlan& plan);

/// Whether a JSON value looks like a point: an array of three or four numbers, or an object of x, y, z or lat, lon,
/// height. Does not check the numbers.
bool isPointValue(std::string_view json);

/// "lat: 95 is not from -90 to 90 degrees"; nothing for a place.
std::string faultOf(const Geodetic& place);

/// The message for three numbers that may be a place, with a camera on the Earth. way: how to say which they are.
std::string bareTriple(const std::string& way);
inline constexpr const char* kNotOnEarth =
    "lat, lon, height need a camera on the Earth: its position as lat, lon, height, or \"world\": \"ecef\"";

}  // namespace viewproj::cmd
