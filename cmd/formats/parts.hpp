// Our camera document of named parts. What formats of named members share, and what --parts says for any file.
//
//   K            9, 12 or 16 by rows; fx fy cx cy; f cx cy; with size: fx fy or f, and the middle of the picture
//   P            12 or 16: K [R | t]
//   fovX, fovY   degrees
//   size         width, height
//   distortion   k1 [k2 [p1 p2 [k3 [k4 k5 k6]]]]; fisheye k1 … k4; omni xi [k1 k2 [p1 p2 [k3]]]; doubleSphere xi alpha;
//                unified alpha [beta]; fov omega
//   cameraFromWorld, worldFromCamera 12 or 16, or their .rotation 9 or its first 6, .rotationVector 3,
//                .quaternion x y z w, .quaternionWFirst, with .translation 3
//   position, direction, target, up 3; latLonHeight; euler 3 degrees; heading [pitch [roll]], pitch, roll degrees; name
//   a text
//
// Of rows of formats alone:
//
//   lens         coefficients of the lens that the text `model`, the flag isFisheye or the number xi names
//   cameraFromWorld  several matrices, whose product it is; beside a P of the form [K | t] what comes before t
//   rectified    [R by rows and] P = K [1 | t] of a rectified picture, in whose world the camera then stands
//   near, far 1; id a text
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "camera/camera_set.hpp"
#include "formats/value.hpp"

namespace viewproj::cmd {

/// A focal length below it, in widths of the picture, is no pixels where the file says the size of one: 169 degrees
/// across.
inline constexpr double kLeastFocal = 0.05;

/// Throws UsageError beginning with label for a name that is no part. isRow: also for those of rows alone.
void requireNames(const std::vector<Part>& parts, const std::string& label, bool isRow);

/// How the cameras of a line are read.
struct PartsForm {
  double pixelCenter = 0;
  std::string_view cameraAxes = "RDF";
};

/// The cameras of a line, one for each text of its stars. names: the pattern of their names; "*" is the star's text;
/// empty: the segment that holds the star.
std::vector<CameraEntry> camerasOfParts(const Node& root, std::vector<Part> parts, PartsForm form,
                                        std::string_view names);

/// Whether the file has all that the line needs, for one camera at least.
bool hasParts(const Node& root, const std::vector<Part>& parts);

}  // namespace viewproj::cmd
