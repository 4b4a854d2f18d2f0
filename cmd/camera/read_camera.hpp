// Reads a camera document into a pose, a projection, a viewport, a lens and a convention.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "camera/document.hpp"
#include "camera/read_convention.hpp"
#include "camera/read_projection.hpp"
#include "viewproj/camera.hpp"
#include "viewproj/lens.hpp"

namespace viewproj::cmd {

/// The parts of a camera that a document has. A part that the command does not need may be missing.
struct CameraFile {
  std::string name;
  std::optional<Pose> pose;
  std::optional<Projection> projection;
  std::optional<Viewport> viewport;
  std::optional<Lens> lens;
  Convention convention;
  const ConventionPreset* preset = &conventions::opengl;  ///< the convention's
  CameraAxes cameraAxes = CameraAxes::RUB;                ///< for a pose in this world, from the convention's preset
  bool worldIsEcef = false;                               ///< Earth-centred metres: points may be lat, lon, height
  bool worldIsEnu = false;                                ///< east, north, up
  bool lacksSize = false;                                 ///< the viewport's is none of its own
  bool isTyped = false;                                   ///< from options only, without a file
  bool statesConvention = false;
  std::optional<double> targetDistance;  ///< if the camera looks at a target
  std::vector<std::string> notes;        ///< values that were read as written but are probably mistakes
  Document document = {};                ///< normalized; must not be changed
  ReadOptions reading = {};              ///< the options that it was read with

  /// Throws InputError, or UsageError for a camera from options only.
  [[noreturn]] void fail(const std::string& message) const;
};

/// Normalizes, checks and reads the document. Copies of the document share the change. Throws InputError (UsageError
/// for what options and --set gave) naming a field.
CameraFile readCamera(Document document, const ReadOptions& reading);

/// Whether there is a near plane and so a window depth. A perspective camera may have none.
inline bool hasDepth(const Projection& projection) { return projection.isOrthographic() || projection.zNear() > 0; }
/// Fails if there is no near plane. what: the feature that needs it.
void requireNear(const CameraFile& file, const std::string& what);

/// Fails if the picture has no size. what: the feature that needs it.
void requireSize(const CameraFile& file, const std::string& what);

/// Whether the world says where north and up are.
inline bool knowsUp(const CameraFile& file) { return file.worldIsEcef || file.worldIsEnu; }
/// Fails if it does not. what: the feature that needs it.
void requireUp(const CameraFile& file, const std::string& what);

/// Fails if a lens bends straight edges. what: the feature that needs them straight.
void requireStraightEdges(const CameraFile& file, const std::string& what);

/// The camera of all parts. Fails if one is missing.
Camera makeCamera(const CameraFile& file);

/// A camera with these parts, in a convention and in the pose's own world. Missing parts get arbitrary values that the
/// caller must not use.
Camera cameraIn(Convention convention, const std::optional<Pose>& pose,
                const std::optional<Projection>& projection = {}, const std::optional<Viewport>& viewport = {});

}  // namespace viewproj::cmd
