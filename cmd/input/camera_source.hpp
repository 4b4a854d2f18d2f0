// Whatever describes a camera: which form of file it is, and which of its cameras is meant.
#pragma once

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

/// Whether the file says how its numbers are meant: it has a convention, or is of a form that says so.
bool statesConvention(const Document& document);

/// What else than a camera file is read: "a glTF file".
std::vector<std::string_view> foreignForms();

/// What picks each camera that the file holds. Throws InputError where it holds none.
std::vector<std::string> picksOf(const Document& document);

/// A line for each camera that the file holds: how it is picked, what it is, and a few words. Throws InputError where
/// it holds none.
std::string listCameras(const Document& document);

}  // namespace viewproj::cmd
