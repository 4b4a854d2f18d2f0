// Columns of a table, or fields of a record, that say a camera: our fields, or short names of them.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "camera/document.hpp"

namespace viewproj::cmd {

/// What the columns of a table or record are, once for all rows.
class CameraColumns {
 public:
  /// columns: an object with their names. isRecord: they stand beside what is no camera's, as the box of a detection,
  /// so that a width and a height are not the picture's. hasNorth: the world has, so that a yaw is a heading.
  explicit CameraColumns(const Json& columns, bool isRecord = false, bool hasNorth = false);

  /// Where a column stands in our document, or empty: a field's path, or one of our own for what is computed.
  const std::string& pathOf(const std::string& column) const { return paths_.find(column)->second; }
  /// A column's name without what says that it is the camera's.
  const std::string& nameOf(std::string_view column) const { return names_.find(column)->second; }
  /// The cell of a row's column with this name, in any letter case.
  std::optional<Node> cellAt(const Node& row, std::string_view name) const;
  bool reads(const std::string& column) const;
  /// Whether a column is this field, or a part of it.
  bool has(std::string_view field) const;
  bool hasTurn() const;
  bool hasRotation() const;
  /// They turn the camera, and nothing says its axes.
  bool lacksAxes() const;
  bool hasFocalPixels() const { return isPath("projection.fx") || isPath("projection.f"); }
  /// The camera's position is called tx, ty, tz.
  bool hasTranslation() const { return hasTranslation_; }
  /// They have rvec and tvec.
  bool isOpenCv() const { return isOpenCv_; }
  /// What is to be said of how they are read.
  const std::vector<std::string>& notes() const { return notes_; }

  /// The camera's document of a row: an object of the columns' values. Empty ones are left out.
  Json documentOf(const Node& row) const;

 private:
  bool isPath(std::string_view path) const;

  std::map<std::string, std::string, std::less<>> paths_, names_;
  std::vector<std::string> notes_;
  bool onEarth_ = false, onMap_ = false, hasNorth_ = false, isOpk_ = false,
       isRobots_ = false;  ///< isRobots: yaw is no heading
  bool hasTranslation_ = false, isOfMetashape_ = false, isOpenCv_ = false;
  bool isPerspective_ = false;    ///< only an orthographic camera has a window of a size
  bool isHeightUnclear_ = false;  ///< no other column is the place's
};

/// The turns of rows in omega, phi, kappa, and in roll, pitch, yaw.
inline constexpr std::string_view kOpk[] = {"omega", "phi", "kappa"}, kRpy[] = {"roll", "pitch", "yaw"};

}  // namespace viewproj::cmd
