// Options and --set as patches to a camera document: each sets its field and removes only what contradicts it.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "camera/document.hpp"
#include "camera/fields.hpp"

namespace viewproj::cmd {

struct Patch {
  std::string path;                   ///< "projection.fovY", "position.0"
  std::shared_ptr<const Json> value;  ///< null removes the field
  std::string label;                  ///< in messages: "--fov-y" or "--set projection.fovY"
  bool isOption = true;               ///< false: from --set
};

/// The patch of a field's option. Throws UsageError if the text is not a valid value.
Patch optionPatch(const Field& field, const std::string& text);
/// The patch of --orthographic.
Patch orthographicPatch();
/// The patch of --set "projection.fovY=75". The value is JSON, or else text. Throws UsageError.
Patch setPatch(const std::string& text);
/// The patches of --viewport.
std::vector<Patch> viewportPatches(double width, double height);

/// Throws UsageError if options contradict each other, or if an option and a --set give the same field.
void requireConsistent(const std::vector<Patch>& patches);

/// Applies the patches to a normalized document, which may be empty. Throws UsageError for --set of an array element
/// that does not exist.
void lay(Document& document, const std::vector<Patch>& patches);

}  // namespace viewproj::cmd
