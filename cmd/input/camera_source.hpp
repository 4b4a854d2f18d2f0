// Whatever describes a camera: which form of file it is, and which of its cameras is meant.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "input/camera_file.hpp"
#include "input/typed_camera.hpp"

namespace viewproj::cmd {

/// "scene.gltf#Camera": the file and the camera picked in it. A file whose own name has a # is found first.
struct CameraSource {
  std::string file;  ///< as Document takes it
  std::optional<std::string> pick;
};

/// Gives or replaces the size of the viewport.
void setViewportSize(Document& document, double width, double height);

CameraSource splitPick(const std::string& given);

/// Throws InputError with the place of what is wrong.
CameraFile readAnyCamera(const Document& document, const std::optional<std::string>& pick,
                         const CameraReading& reading);

/// The same with the fields that the command line gives over those of the file.
CameraFile readAnyCamera(Document& document, const std::optional<std::string>& pick, const CameraReading& reading,
                         const TypedCamera& typed);

/// All that the file holds, in its order: what picks each, and itself. refuse: takes the message of one that cannot be
/// read. Throws InputError where it holds none.
void readEachCamera(Document& document, const CameraReading& reading, const TypedCamera& typed,
                    const std::function<void(const std::string& pick, const CameraFile& camera)>& take,
                    const std::function<void(const std::string& message)>& refuse);

/// Whether it is another program's file, and none of our own.
bool isForeign(const Document& document);

/// What else than a camera file is read.
struct ForeignFile {
  std::string_view name;  ///< "3dgs"
  std::string_view form;  ///< "a glTF file"
  std::string_view help;  ///< more about it, or empty
};
std::vector<ForeignFile> foreignFiles();

/// A line for each camera that the file holds: how it is picked, what it is, and a few words. Throws InputError where
/// it holds none.
std::string listCameras(Document& document);

}  // namespace viewproj::cmd
