// The canonical camera file: JSON to the few numbers every camera is.
#pragma once

#include <optional>
#include <string>

#include "input/document.hpp"
#include "viewproj/camera.hpp"

namespace viewproj::cmd {

/// What a camera file holds. A file may lack a part that the command does not need.
struct CameraFile {
  std::string name;
  std::optional<Pose> pose;
  std::optional<Projection> projection;
  std::optional<Viewport> viewport;
  Convention convention;
  std::optional<CameraAxes> cameraAxes = {};  ///< where its rotation's axes point, of a file that says so
  bool worldIsEcef = false;                   ///< Earth-centred metres: points may be given by lat, lon, height
  bool isTyped = false;                       ///< of the command line, and no file's
  bool tookAspect = false;                    ///< its shape is the reading's aspect
  bool statesConvention = false;              ///< the file has one, or is of a form that says how its numbers are meant
};

struct CameraReading {
  std::string readAs;  ///< a preset's name, or empty for the file's own convention
  bool allowStretch = false;
  bool ignoreDistortion = false;
  bool needsPicture = true;                   ///< false: of a file without its size the pose, near and far count alone
  bool replacesPose = false;                  ///< the file's need not be one that is read
  std::optional<double> aspect = {};          ///< where a file of another program leaves it open
  std::optional<Vec3> eye = {};               ///< in place of the file's
  std::optional<double> near = {}, far = {};  ///< the same, with the window as it is
};

/// Throws InputError with the place of what is wrong.
CameraFile readCamera(const Document& document, const CameraReading& reading);

/// The pose of a camera's fields, or nothing where they have none. preset: for what they leave out. Throws InputError,
/// or CameraError.
std::optional<Pose> readPose(const ObjectReader& camera, const Convention& convention, const ConventionPreset& preset);

/// Where a field that the library complains about stands.
Path pathInCamera(const Document& document, const std::string& field);

/// All parts together; throws InputError, or of the command line UsageError, naming what is lacking for it.
Camera makeCamera(const CameraFile& file);

}  // namespace viewproj::cmd
