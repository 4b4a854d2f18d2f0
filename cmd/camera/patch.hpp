// Options and --set as patches of a camera document: each sets its field and removes what contradicts it.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "camera/document.hpp"
#include "camera/fields.hpp"

namespace viewproj::cmd {

struct Patch {
  std::string path;                   ///< "projection.fovY", "position.0"
  std::shared_ptr<const Json> value;  ///< null removes the field
  std::string label;                  ///< in messages: "--fov-y", "--set projection.fovY", or empty: a file's field
  bool isOption = true;               ///< false: from --set
};

/// The patch of a field's option. Throws UsageError if the text is not a valid value.
Patch optionPatch(const Field& field, const std::string& text);
/// The patch of --orthographic.
Patch orthographicPatch();
/// The patch of --set "projection.fovY=75". The value is JSON, the short form of the field's option, or else text.
/// Throws UsageError.
Patch setPatch(const std::string& text);
/// A pose as a program writes it: a URDF's <origin xyz="…" rpy="…"/>, Godot's Transform3D(…) of the rows of a turn and
/// a place, or p[x, y, z, rx, ry, rz] of Universal Robots. Nothing for a text that begins otherwise.
std::optional<Json> writtenPose(std::string_view text);
/// Whether such a pose is Godot's, whose cameras have axes RUB.
inline bool isGodotPose(std::string_view text) { return text.starts_with("Transform3D("); }
/// Such a pose, or one as options say it: a place and, behind a blank, ORDER:A,B,C, quaternion:x,y,z,w (quat:) or
/// vector:x,y,z (rvec:, radians). Nothing for a text that begins otherwise. The values are not checked.
std::optional<Json> poseOfText(const std::string& text);
/// The origin of a URDF, {"@xyz": "1 2 3", "@rpy": "0 0 1.57"} in metres and radians; nothing where it has not three
/// numbers each. What it lacks is 0.
std::optional<Json> poseOfOrigin(const Json& origin);
/// The patches of --viewport.
std::vector<Patch> viewportPatches(double width, double height);
/// Makes the picture of a normalized document so many times as wide and high, with the lens and a crop. Throws
/// InputError where it has none, or no whole number of pixels is left.
void resizePicture(Document& document, double factor);

/// Throws UsageError if two options contradict each other.
void requireConsistent(const std::vector<Patch>& patches);

/// Applies the options, together, then each --set, in its order, to a normalized document, which may be empty. The type
/// of the projection changes if a field belongs to others. Throws UsageError for a --set of a field that does not exist
/// or of an array's element that the document does not have.
void applyPatches(Document& document, const std::vector<Patch>& patches);

/// Lays the fields of one document over another as one patch, as --set would. Both must be normalized.
void layOver(Document& document, const Json& fields);

}  // namespace viewproj::cmd
