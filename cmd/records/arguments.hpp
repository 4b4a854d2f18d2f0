// Points and shapes as a command line writes them: numbers separated by commas, without a file.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "viewproj/scene.hpp"

namespace viewproj::cmd {

/// X,Y,Z[,W], or each number with its role in any order, as in lat=47,lon=8,height=1500.
struct PointArgument {
  std::string text;  ///< as typed, after the option
  std::vector<std::pair<std::string_view, double>> numbers;
  bool hasRoles = false;

  bool isPlace() const { return numbers[0].first == "lat"; }
  /// As a record.
  std::string json() const;
  /// Throws UsageError for a place with a camera elsewhere, and for three numbers without roles with one on the Earth.
  void requireFit(bool worldIsEcef) const;
  /// In the world. Throws UsageError where all four numbers are 0, and for a lat beyond 90.
  Vec4 point() const;
};
inline constexpr const char* kPointForm = "X,Y,Z[,W]|lat=..,lon=..,height=..";
PointArgument readPointArgument(const std::string& option, const std::string& text);

/// z=0, also x=..., y=...; or A,B,C,D: the plane Ax + By + Cz + D = 0. The normal is that axis or A,B,C. Throws
/// UsageError.
Plane readPlaneArgument(const std::string& option, const std::string& text);

/// X,Y,Z,R: a sphere as a record. Throws UsageError.
std::string readSphereArgument(const std::string& option, const std::string& text);

/// X,Y,Z,X,Y,Z: the lower and the upper corner of a box, as a record. Throws UsageError.
std::string readBoxArgument(const std::string& option, const std::string& text);

}  // namespace viewproj::cmd
