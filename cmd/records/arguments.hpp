// Points and shapes on a command line: numbers separated by commas, without a file.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "records/scene.hpp"

namespace viewproj::cmd {

/// X,Y,Z[,W]; or each number with its role, in any order, as in lat=47,lon=8,height=1500.
struct PointArgument {
  std::string text;  ///< as typed, after the option
  std::vector<std::pair<std::string, double>> numbers;
  bool hasRoles = false, isAltitude = false;  ///< isAltitude: the height is above sea level

  bool isPlace() const { return numbers[0].first == "lat"; }
  /// The point as the text of a JSON record.
  std::string json() const;
  /// Throws UsageError for a place if the camera is not on the Earth, and for three numbers without roles if it is.
  void requireFit(bool worldIsEcef) const;
  /// The point in world coordinates. Throws UsageError if all four numbers are 0, or for a lat beyond 90.
  Vec4 point() const;
};
inline constexpr const char* kPointForm = "X,Y,Z[,W]|lat=..,lon=..,height=..";
PointArgument readPointArgument(const std::string& option, const std::string& text);

/// A plane: z=0, also x=..., y=...; or A,B,C,D for Ax + By + Cz + D = 0. The normal is that axis or A,B,C. Throws
/// UsageError.
PlaneEquation readPlaneArgument(const std::string& option, const std::string& text);

/// A sphere X,Y,Z,R as a record. Throws UsageError.
std::string readSphereArgument(const std::string& option, const std::string& text);

/// A box X,Y,Z,X,Y,Z, its lower and upper corner, as a record. Throws UsageError.
std::string readBoxArgument(const std::string& option, const std::string& text);

}  // namespace viewproj::cmd
