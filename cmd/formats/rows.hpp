// Formats of named members: a row each.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "camera/camera_set.hpp"

namespace viewproj::cmd {

struct Row {
  std::string_view name;  ///< in help formats; rows of one name are one format there
  std::string_view form;  ///< "a calibration of OpenCV"
  std::string_view when;  ///< what must be there, see claims.hpp
  /// The cameras, in the grammar of --parts (parts.hpp). Several lines are separated by "\n"; each may begin with the
  /// pattern of its cameras' names and ": ". A line whose required parts are not there has no cameras. Of one that
  /// begins with "!" this holds for its first part; of the others what is not there is missing. "~"
  /// marks those of CameraEntry::isOfAnother.
  std::string_view lines;
  std::string_view known = "";       ///< members that say nothing about the picture
  std::string_view containers = "";  ///< where its members may stand, separated by blanks; "." is the file itself
  double pixelCenter = 0;
  std::string_view cameraAxes = "RDF";
  bool hasOtherFile = false;   ///< see addOtherFile()
  std::string_view note = "";  ///< to be told of its cameras
};

std::span<const Row> rows();

/// The first container of the row for which the conditions hold and the parts of a line are there.
std::optional<std::string> containerOf(const Row& row, const Node& root);
/// The cameras of a row. Throws InputError.
Import importRow(const Row& row, const Node& root, std::string_view container);

}  // namespace viewproj::cmd
