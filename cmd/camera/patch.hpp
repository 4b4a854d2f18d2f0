// Options and --set as patches to a camera document: each replaces its own field, and removes only what contradicts it.
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
  std::string label;                  ///< "--fov-y", "--set projection.fovY": in messages
  bool isOption = true;               ///< otherwise of --set
};

/// The patch of a field's option. Throws UsageError where the text is no value of it.
Patch optionPatch(const Field& field, const std::string& text);
/// --orthographic.
Patch orthographicPatch();
/// "projection.fovY=75": the value is JSON, or else text. Throws UsageError.
Patch setPatch(const std::string& text);
/// --viewport.
std::vector<Patch> viewportPatches(double width, double height);

/// Throws UsageError for options that contradict each other, and for an option and a --set of one field.
void requireConsistent(const std::vector<Patch>& patches);

/// Lays them over a normalized document, which may be empty. Throws UsageError for --set of an element that is not
/// there.
void lay(Document& document, const std::vector<Patch>& patches);

}  // namespace viewproj::cmd
