// Reads a camera document into a pose, a projection, a viewport, a lens and a convention.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "camera/document.hpp"
#include "viewproj/camera.hpp"
#include "viewproj/lens.hpp"

namespace viewproj::cmd {

struct ReadOptions {
  bool allowStretch = false;
  bool ignoreDistortion = false;
  bool needsPicture = true;  ///< false: intrinsics without a picture's size give only near and far
};

/// The parts of a camera that a document has. A part that the command does not need may be missing.
struct CameraFile {
  std::string name;
  std::optional<Pose> pose;
  std::optional<Projection> projection;
  std::optional<Viewport> viewport;
  std::optional<Lens> lens;
  Convention convention;
  CameraAxes cameraAxes = CameraAxes::RUB;  ///< from the convention's preset
  bool worldIsEcef = false;                 ///< Earth-centred metres: points may be lat, lon, height
  bool isTyped = false;                     ///< from options only, without a file
  bool statesConvention = false;
  std::optional<double> targetDistance;  ///< if the camera looks at a target
  std::vector<std::string> notes;        ///< values that were read as written but are probably mistakes
  Document document = {};                ///< normalized; must not be changed
  ReadOptions reading = {};              ///< the options that it was read with
};

/// Normalizes, checks and reads the document. Copies of the document share the change. Throws InputError (UsageError
/// for options) naming a field.
CameraFile readCamera(Document document, const ReadOptions& reading);

/// Whether a camera with this aspect fits the viewport: the shapes differ by no more than 0.1 %.
bool hasShape(const Viewport& viewport, double aspect);

/// Whether there is a near plane and so a window depth. A perspective camera may have none.
inline bool hasDepth(const Projection& projection) { return projection.isOrthographic() || projection.zNear() > 0; }
/// Throws InputError if there is no near plane. what: the feature that needs it.
void requireNear(const CameraFile& file, const std::string& what);

/// Throws InputError if a lens bends straight edges. what: the feature that needs them straight.
void requireStraightEdges(const CameraFile& file, const std::string& what);

/// The camera of all parts. Throws InputError (UsageError for options) naming a missing part.
Camera makeCamera(const CameraFile& file);

/// A camera with these parts, in a convention and in the pose's own world. Missing parts get arbitrary values that the
/// caller must not use.
Camera cameraIn(Convention convention, const std::optional<Pose>& pose,
                const std::optional<Projection>& projection = {}, const std::optional<Viewport>& viewport = {});

}  // namespace viewproj::cmd
