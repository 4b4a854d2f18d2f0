// transforms.json of NeRF and its kin (Blender's, COLMAP's by instant-ngp, nerfstudio's): frames with a pose each, and
// intrinsics for all of them or one's own. Camera axes are OpenGL's: x right, y up, looking along -z.
// Source: nerfstudio, "Data conventions"; instant-ngp, "NeRF dataset tips".
#include <nlohmann/json.hpp>

#include "input/importers/importer.hpp"
#include "numbers/radians.hpp"
#include "text/names.hpp"

namespace viewproj::cmd {
namespace {

bool recognises(const nlohmann::json& root) {
  const auto frames = root.find("frames");
  return frames != root.end() && frames->is_array();
}

/// A frame's own value of a key, or else that of the file.
struct Frame {
  ObjectReader file, own;

  const ObjectReader& with(std::string_view key) const { return own.has(key) ? own : file; }
  std::optional<double> number(std::string_view key) const { return with(key).number(key); }
};

ObjectList framesOf(const ObjectReader& root) {
  ObjectList frames = root.objects("frames");
  if (frames.empty()) root.fail("frames", "is empty: there is no camera");
  return frames;
}

std::vector<HeldCamera> list(const Document& document) {
  const ObjectReader root(document, document.root(), {});
  std::vector<HeldCamera> result;
  for (const ObjectReader& frame : framesOf(root)) {
    HeldCamera held;
    held.name = frame.text("file_path").value_or("");
    held.number = std::to_string(result.size());
    held.alias = held.name.starts_with("./") ? held.name.substr(2) : "";
    held.kind = "intrinsics";
    held.note = "frame " + held.number;
    for (const char* key : {"w", "h", "fl_x", "camera_angle_x"})
      held.note += shortNumbers(Frame{root, frame}.with(key), {key});
    result.push_back(held);
  }
  return result;
}

/// Throws unless the lens is a pinhole, or its distortion is to be ignored, which is noted.
void requirePinhole(const Frame& frame, const CameraReading& reading) {
  bool isNoted = false;
  const auto refuse = [&](const char* key, const char* why) {
    const ObjectReader& at = frame.with(key);
    if (!reading.ignoreDistortion) at.fail(key, why);
    Path path = at.path();
    path.emplace_back(key);
    if (!isNoted) at.document().note(path, kDistortionLeftOut);
    isNoted = true;
  };
  if (const auto model = frame.with("camera_model").string("camera_model")) {
    static constexpr std::string_view kPinholes[] = {"PINHOLE",       "SIMPLE_PINHOLE", "OPENCV",     "FULL_OPENCV",
                                                     "SIMPLE_RADIAL", "RADIAL",         "PERSPECTIVE"};
    static constexpr std::string_view kFisheyes[] = {"OPENCV_FISHEYE", "RADIAL_FISHEYE", "SIMPLE_RADIAL_FISHEYE",
                                                     "FISHEYE"};
    const auto among = [&](auto& names) {
      return std::find(std::begin(names), std::end(names), *model) != std::end(names);
    };
    if (among(kFisheyes))
      refuse("camera_model", "is no pinhole camera; --ignore-distortion takes it as one, for pixels near its middle");
    else if (!among(kPinholes))
      frame.with("camera_model").fail("camera_model", "is no pinhole camera; known are " + joined(kPinholes));
  }
  if (frame.with("is_fisheye").flag("is_fisheye").value_or(false))
    refuse("is_fisheye", "is no pinhole camera; --ignore-distortion takes it as one");
  for (const char* key : {"k1", "k2", "k3", "k4", "k5", "k6", "p1", "p2"})
    if (frame.number(key).value_or(0) != 0)
      refuse(key,
             "distorts the picture, which is not modelled; undistort it first, or give --ignore-distortion for pixels "
             "of an ideal lens");
}

/// Focal length in pixels: as such, or by the whole angle of view.
std::optional<DoubleDouble> focalLength(const Frame& frame, const char* key, const char* angleKey, double pixels) {
  const auto focal = frame.number(key), angle = frame.number(angleKey);
  if (focal && !(*focal > 0)) frame.with(key).fail(key, "must be above 0");
  if (!angle) return focal ? std::optional<DoubleDouble>(*focal) : std::nullopt;
  const DoubleDouble tangent = tanHalfRadians(*angle);
  if (!focal && !(tangent.hi > 0)) frame.with(angleKey).fail(angleKey, "must be an angle between 0 and pi radians");
  const DoubleDouble ofAngle = timesPowerOfTwo(DoubleDouble(pixels), 0.5) / tangent;
  if (!focal) return ofAngle;
  // A frame's own focal length goes before the file's angle, and contradicts nothing.
  constexpr double kSame = 1e-3;
  const bool besides = frame.own.has(key) == frame.own.has(angleKey);
  if (besides && !(std::fabs(ofAngle.hi - *focal) <= kSame * *focal)) {
    Path path = frame.with(angleKey).path();
    path.emplace_back(angleKey);
    const bool isAngle = tangent.hi > 0;
    frame.file.document().note(path, (isAngle ? "makes a focal length of " + shortNumber(ofAngle.hi) + " pixels"
                                              : "is no angle between 0 and pi radians") +
                                         std::string("; ") + key + " counts, which is " + shortNumber(*focal));
  }
  return *focal;
}

Pose readPose(const ObjectReader& frame) {
  constexpr const char* kKey = "transform_matrix";
  const nlohmann::json* value = frame.find(kKey);
  if (!value) frame.fail(std::string("needs ") + kKey);
  const bool threeRows = value->is_array() && value->size() == 3;
  for (std::size_t i = 0; i < value->size(); ++i)
    if (!(value->is_array() && (threeRows || value->size() == 4) && (*value)[i].is_array() && (*value)[i].size() == 4))
      frame.fail(kKey, "expected 4 rows of 4 numbers, or the upper 3");
  const auto numbers = *flatNumbers(frame, kKey, threeRows ? 12 : 16);
  Mat4 m;
  for (std::size_t i = 0; i < numbers.size(); ++i) m[i / 4][i % 4] = numbers[i];
  if (threeRows) m[3] = {0, 0, 0, 1};
  return located(frame, {{"worldFromCamera", kKey}}, [&] {
    try {
      return poseFromWorldFromCamera(m, CameraAxes::RUB, Handedness::right);
    } catch (const CameraError& e) {
      // Its advice is for files that can say which axes they use.
      if (e.message().starts_with("is a mirroring"))
        throw CameraError(e.field(), "mirrors (its determinant is negative): one of its axes has the wrong sign");
      throw;
    }
  });
}

CameraFile read(const Document& document, std::size_t which, const CameraReading& reading) {
  const ObjectReader root(document, document.root(), {});
  const Frame frame{root, framesOf(root)[which]};
  requirePinhole(frame, reading);
  const auto w = frame.number("w"), h = frame.number("h");
  const auto viewport = importedViewport(document, {.width = w, .height = h});
  // The pixels that focal lengths count are the file's own; a viewport of another size shows the same picture.
  Viewport pixels{.width = w.value_or(0), .height = h.value_or(0)};
  if (!w || !h) {
    if (!viewport) root.fail("has no w and h, the size of its pictures; --viewport WIDTHxHEIGHT gives one");
    pixels = {.width = viewport->frame.width, .height = viewport->frame.height};
  }
  const auto fx = focalLength(frame, "fl_x", "camera_angle_x", pixels.width);
  const auto fy = focalLength(frame, "fl_y", "camera_angle_y", pixels.height);
  if (!fx && !fy) frame.own.fail("has no focal length: fl_x or camera_angle_x is expected, in the frame or the file");
  const double cx = frame.number("cx").value_or(pixels.width / 2), cy = frame.number("cy").value_or(pixels.height / 2);
  const Projection projection =
      located(root, {{"near", frame.file.has("near") ? "near" : ""}, {"far", frame.file.has("far") ? "far" : ""}}, [&] {
        return intrinsics(fx ? *fx : *fy, fy ? *fy : *fx, cx, cy, pixels, root.numberOr("near", kDefaultNear),
                          root.numberOr("far", kInfiniteFar));
      });
  if (!reading.allowStretch)
    requireShape(DoubleDouble(pixels.width) / DoubleDouble(pixels.height), viewport->frame, frame.own);
  return imported(document, *conventionPreset("opengl"), readPose(frame.own), projection, viewport);
}

}  // namespace

const Importer kNerfTransforms{"a transforms.json", recognises, list, read};

}  // namespace viewproj::cmd
