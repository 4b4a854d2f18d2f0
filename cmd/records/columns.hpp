// --columns: which columns of CSV, fields of JSON objects or numbers of a line hold the coordinates. Values of a point
// on the command line are named in the same way.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "records/coordinates.hpp"
#include "records/layout.hpp"
#include "records/record.hpp"

namespace viewproj::cmd {

/// What may be named: the parts of one of the rows, and one of the others beside it.
struct ChoosableColumns {
  std::span<const Coordinate*const> rows, others;
  std::string_view example;
};

inline constexpr const Coordinate *kPointRows[] = {&coordinates::xyz, &coordinates::place},
                                  *kRadiusRow[] = {&coordinates::radius}, *kPixelRow[] = {&coordinates::xy},
                                  *kPairRows[] = {&coordinates::xyzUv, &coordinates::placeUv};
inline constexpr ChoosableColumns kPointColumns{kPointRows, {}, "E,N,U or x=E,y=N,z=U"},
    kSphereColumns{kPointRows, kRadiusRow, "E,N,U or x=E,y=N,z=U"},
    kPixelColumns{kPixelRow, coordinates::kDistances, "u,v or x=u,y=v"},
    kPairColumns{kPairRows, {}, "E,N,U,u,v or x=E,y=N,z=U,u=u,v=v"},
    kPointValues{kPointRows, {}, "3,2,5 or lat=47,lon=8,height=1500"};

/// What a command line lists for the coordinates: values of them, or the columns that hold them.
struct ColumnChoice {
  struct Pick {
    std::string_view role;     ///< "x"
    std::string name;          ///< of the column or field; the value
    std::size_t number = 0;    ///< of the column, from 1; 0: it goes by its name
    std::size_t nameless = 0;  ///< the same where columns have no names
  };
  std::string text = {};         ///< as typed
  std::vector<Pick> picks = {};  ///< in the order of the table; none: not given
  bool hasRoles = false;         ///< the roles were typed: x, y, z are no lat, lon, height

  bool given() const { return !picks.empty(); }
  bool has(std::string_view role) const;
  /// Columns by number, which are numbers in every line but a header.
  std::vector<std::size_t> numbers() const;
  /// The names of columns that have none, as far as they are named here; empty: none.
  std::vector<std::string> columnNames() const;
  /// Throws UsageError where records have no names and names were typed. of: "lines of text".
  void requireNoNames(const std::string& of) const;
};

/// "E,N,U", "2,3,4", "x=E,y=N,z=U"; or names that are all roles, in any order. Throws UsageError.
ColumnChoice chooseColumns(const std::string& text, const ChoosableColumns& choosable);

/// "3,2,5", "lat=47,lon=8,height=1500". Throws UsageError.
ColumnChoice readValues(const std::string& option, const std::string& text, const ChoosableColumns& choosable);

/// The fields that are chosen; no others count. Throws RecordError where the record lacks one.
Layout chosenFields(const ColumnChoice& choice, const RecordParts& record, bool mayBeAbsent);

}  // namespace viewproj::cmd
