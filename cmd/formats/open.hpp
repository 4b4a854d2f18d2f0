// Opens camera files: known by their content, or read by their parts.
#pragma once

#include <memory>
#include <string>

#include "camera/camera_set.hpp"
#include "formats/import_file.hpp"

namespace viewproj::cmd {

/// The cameras of a file; with --parts those that its line builds. Throws UnknownFile, InputError.
std::unique_ptr<CameraSet> openCameras(const std::string& file, const Opening& opening, CameraPatches patches);
/// The same of a file that is read.
std::unique_ptr<CameraSet> openDocument(Document file, const Opening& opening, CameraPatches patches);
/// The cameras of options alone, at the poses of a file.
std::unique_ptr<CameraSet> openPoses(const Opening& opening, CameraPatches patches);

}  // namespace viewproj::cmd
