// --columns: which columns of CSV, fields of JSON objects or numbers of a line hold the coordinates. Values of a point
// on the command line use the same syntax.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "records/coordinates.hpp"
#include "records/number_plan.hpp"
#include "records/record.hpp"

namespace viewproj::cmd {

/// What may be chosen: the parts of one of rows, and one of others beside it.
struct ChoosableColumns {
  std::span<const Coordinate*const> rows, others;
  std::string_view example;
};

inline constexpr const Coordinate *kPointRows[] = {&coordinates::xyz, &coordinates::place},
                                  *kRadiusRow[] = {&coordinates::radius}, *kPixelRow[] = {&coordinates::xy},
                                  *kTwoPixelsRow[] = {&coordinates::twoUv},
                                  *kPairRows[] = {&coordinates::xyzUv, &coordinates::placeUv};
/// Without w.
inline constexpr Coordinate kXyzUvRow{"x y z u v",
                                      CoordinateForm::numbers,
                                      5,
                                      5,
                                      "a point and its pixel",
                                      kindPoint,
                                      std::span(coordinates::kXyzUvw).first(5)};
inline constexpr const Coordinate* kPointOrPairRows[] = {&coordinates::xyz, &coordinates::place, &kXyzUvRow,
                                                         &coordinates::placeUv};
inline constexpr ChoosableColumns kPointColumns{kPointRows, {}, "E,N,U or x=E,y=N,z=U"},
    kSphereColumns{kPointRows, kRadiusRow, "E,N,U or x=E,y=N,z=U"},
    kPixelColumns{kPixelRow, coordinates::kDistances, "u,v or x=u,y=v"},
    kPixelAloneColumns{kPixelRow, {}, "u,v or x=u,y=v"},
    kTwoPixelsColumns{kTwoPixelsRow, {}, "xl,yl,xr,yr or u1=xl,v1=yl,u2=xr,v2=yr"},
    kPointOrPairColumns{kPointOrPairRows, {}, "E,N,U or x=E,y=N,z=U,u=u,v=v"},
    kPairColumns{kPairRows, {}, "E,N,U,u,v or x=E,y=N,z=U,u=u,v=v"},
    kPointValues{kPointRows, {}, "3,2,5 or lat=47,lon=8,height=1500"};

/// The list of coordinates on a command line: their values, or the columns that hold them.
struct ColumnChoice {
  struct Pick {
    std::string_view role;     ///< "x"
    std::string altitude;      ///< the name of a height that may be above sea level, as written
    std::string name;          ///< name of the column or field, or the value
    std::size_t number = 0;    ///< number of the column, from 1; 0: use its name
    std::size_t nameless = 0;  ///< number of the column if columns have no names
  };
  std::string text = {};         ///< as typed
  std::vector<Pick> picks = {};  ///< in the order of the table; empty without --columns
  bool hasRoles = false;         ///< roles were typed, so x, y, z are not lat, lon, height

  bool given() const { return !picks.empty(); }
  bool has(std::string_view role) const;
  /// The columns chosen by number. They hold numbers in every line except a header.
  std::vector<std::size_t> numbers() const;
  /// Names for columns without a header, as far as they are chosen; empty for the others.
  std::vector<std::string> columnNames() const;
  /// Throws UsageError if names were typed but records have none. of: "lines of text".
  void requireNoNames(const std::string& of) const;
};

/// Reads "E,N,U", "2,3,4" or "x=E,y=N,z=U"; names that are all roles may be in any order. Throws UsageError.
ColumnChoice chooseColumns(const std::string& text, const ChoosableColumns& choosable);

/// Reads "3,2,5" or "lat=47,lon=8,height=1500". Throws UsageError.
ColumnChoice readValues(const std::string& option, const std::string& text, const ChoosableColumns& choosable);

/// The chosen fields. Throws RecordError if the record lacks one.
NumberPlan chosenFields(const ColumnChoice& choice, const RecordView& record, bool mayBeAbsent);

}  // namespace viewproj::cmd
