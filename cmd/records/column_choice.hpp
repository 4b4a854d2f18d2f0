// --columns: which columns of CSV, fields of JSON objects or numbers of a line hold the coordinates.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "records/coordinates.hpp"
#include "records/record.hpp"

namespace viewproj::cmd {

/// What --columns may name: one of the rows, and one of the others beside it.
struct ChoosableColumns {
  std::span<const Coordinate*const> rows, others;
  std::string_view example;
};

inline constexpr const Coordinate *kPointRows[] = {&coordinates::xyz, &coordinates::place},
                                  *kRadiusRow[] = {&coordinates::radius}, *kPixelRow[] = {&coordinates::xy};
inline constexpr ChoosableColumns kPointColumns{kPointRows, {}, "x=E,y=N,z=U"},
    kSphereColumns{kPointRows, kRadiusRow, "x=E,y=N,z=U"},
    kPixelColumns{kPixelRow, coordinates::kDistances, "x=u,y=v,depth=d"};

struct ColumnChoice {
  struct Pick {
    std::string role;        ///< "x"
    std::string name;        ///< of the column or field
    std::size_t number = 0;  ///< in its place; 0: by name
  };
  std::string text;         ///< as typed
  std::vector<Pick> picks;  ///< none: not given
  bool saysWhat = false;    ///< the roles were typed: x, y, z are no lat, lon, height
  bool inOrder = false;     ///< names that are roles: where columns have no names, the first ones have them

  bool given() const { return !picks.empty(); }
  const Pick* find(std::string_view role) const;
  /// Columns by number, which are numbers in every line but a header.
  std::vector<std::size_t> numbers() const;
  /// The names of columns that have none, as far as it tells; empty: none.
  std::vector<std::string> columnNames() const;
  /// Throws UsageError where records have no names and names were typed. of: "lines of text".
  void requireNoNames(const std::string& of) const;
};

/// The role that a name or an alias in any case says; empty: none.
std::string_view roleOf(std::string_view name, const ChoosableColumns& choosable);

/// "E,N,U", "2,3,4", "x=E,y=N,z=U". Throws UsageError.
ColumnChoice chooseColumns(const std::string& text, const ChoosableColumns& choosable);

/// The field of a pick. Throws RecordError where the record has none.
std::size_t fieldOf(const ColumnChoice::Pick& pick, const ColumnChoice& choice, const RecordParts& record);

}  // namespace viewproj::cmd
