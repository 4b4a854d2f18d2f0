// --set and options over a file of another program, whose fields have other names: which of them say the same thing is
// seen from what they change.
#pragma once

#include <functional>
#include <vector>

#include "input/camera_file.hpp"
#include "input/document.hpp"
#include "input/typed_camera.hpp"

namespace viewproj::cmd {

/// Throws UsageError, with the names of both, where a number that --set gives changes the file's cameras, and under the
/// options no longer does. read: those that are asked for, as the document stands; it may throw InputError.
void requireSetsCount(Document& document, const TypedCamera& typed, const CameraReading& reading,
                      const std::function<std::vector<CameraFile>()>& read);

}  // namespace viewproj::cmd
