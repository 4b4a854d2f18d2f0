// A camera document as the few numbers that every camera is.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "camera/document.hpp"
#include "viewproj/camera.hpp"

namespace viewproj::cmd {

struct ReadOptions {
  bool allowStretch = false;
  bool ignoreDistortion = false;
  bool needsPicture = true;  ///< false: intrinsics without a picture's size give near and far alone
};

/// What a document says of a camera. It may lack a part that the command does not need.
struct CameraFile {
  std::string name;
  std::optional<Pose> pose;
  std::optional<Projection> projection;
  std::optional<Viewport> viewport;
  Convention convention;
  CameraAxes cameraAxes = CameraAxes::RUB;  ///< of the convention's preset
  bool worldIsEcef = false;                 ///< Earth-centred metres: points may be given by lat, lon, height
  bool isTyped = false;                     ///< of options alone, and no file's
  bool statesConvention = false;
  std::optional<double> targetDistance;  ///< of a camera that looks at a target
  std::vector<std::string> notes;        ///< what is read as it stands, but probably not meant
  Document document = {};                ///< normalized; not to be changed
  ReadOptions reading = {};              ///< that it was read with
};

/// Normalizes the document, which its copies share, checks it, and reads it. Throws InputError (of options UsageError)
/// naming a field.
CameraFile readCamera(Document document, const ReadOptions& reading);

/// Whether a camera of this aspect fits the viewport: shapes that differ by no more than 0.1 % are one.
bool hasShape(const Viewport& viewport, double aspect);

/// Whether there is a near plane to measure depth from; a perspective camera may do without.
inline bool hasDepth(const Projection& projection) { return projection.isOrthographic() || projection.zNear() > 0; }
/// Throws InputError, naming what needs it, where there is none.
void requireNear(const CameraFile& file, const std::string& what);

/// All parts together; throws InputError (of options UsageError) naming what is lacking for it.
Camera makeCamera(const CameraFile& file);

/// A camera of these parts in a convention, in the pose's own world; what is not given is of no account to whoever
/// calls.
Camera cameraIn(Convention convention, const std::optional<Pose>& pose,
                const std::optional<Projection>& projection = {}, const std::optional<Viewport>& viewport = {});

}  // namespace viewproj::cmd
