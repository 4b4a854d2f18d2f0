// What a file must hold to be of a format: conditions separated by blanks, all of which hold.
//
//   condition = [ "!" ] choice { "|" choice }      "!": none of the choices holds
//   choice    = path [ "=" text ] [ ":" shape { "/" shape } ]
//   shape     = 9 (numbers) | 3x3 | Nx17 (rows of) | L26 (one row of) | list | object | alone (an object of one member)
//             | two (an object of two members) | few (of three at most) | xyzw (four numbers by name) | text
//             | K (numbers of one), K3, K4 (of 3 or 4 rows) | F8 (one row that begins with two focal lengths)
//             | P (a matrix K [R | t]) | M (a pose of 3 or 4 rows) | Q (a time, a place and a unit quaternion)
//             | PN, MN, QN (several)
//
// A star is any member. Paths are those of a part (value.hpp).
#pragma once

#include <string_view>

#include "camera/document.hpp"

namespace viewproj::cmd {

/// container: what stands in front of every path, except those that begin with "/".
bool holds(const Node& root, std::string_view conditions, std::string_view container = "");

}  // namespace viewproj::cmd
