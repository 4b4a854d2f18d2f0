#include "camera/read_camera.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>

#include "camera/plain_vectors.hpp"
#include "camera/read_lens.hpp"
#include "camera/read_pose.hpp"
#include "text/error.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {
namespace {

/// The world of the document. East, north, up and Earth-centred worlds are right-handed, and have no places in the
/// first.
void readWorld(const FieldValues& values, CameraFile& file) {
  const World world = worldOf(values);
  file.worldIsEcef = world == World::ecef;
  file.worldIsEnu = world == World::enu;
  if (world != World::any && file.convention.world == Handedness::left)
    values.failAt("", std::string("the convention's world is left-handed, but ") +
                          (file.worldIsEcef ? "Earth-centred coordinates are" : "east, north and up are") +
                          " right-handed; --convention says how to write");
  for (const FieldId field : {FieldId("position"), FieldId("target")})
    if (const auto* const position = values.find<Position>(field); file.worldIsEnu && position && position->place)
      values.fail(field, "is a place on the Earth; in the world \"enu\" expected [x, y, z]: east, north, up");
}

/// Whether a test holds of some turns: of {"order", "degrees"}, alone or in poses.
bool anyTurns(const Json& value, const std::function<bool(const Json& turns)>& holds) {
  if (value.is_object() && value.contains("order")) return holds(value);
  return value.is_structured() &&
         std::any_of(value.begin(), value.end(), [&](const Json& part) { return anyTurns(part, holds); });
}

/// Whether turns of roll, pitch and yaw may be meant in radians: all within half a turn, and one is no whole number.
bool mayBeRadians(const Json& value) {
  const Json turns = value.value("degrees", Json::array());
  const auto isSmall = [](const Json& turn) { return turn.is_number() && std::fabs(turn.get<double>()) < 3.15; };
  const auto isBroken = [](const Json& turn) { return std::fmod(turn.get<double>(), 1) != 0; };
  return value["order"] == "rpy" && std::all_of(turns.begin(), turns.end(), isSmall) &&
         std::any_of(turns.begin(), turns.end(), isBroken);
}

constexpr FieldId kPoseFields[] = {FieldId("euler"), FieldId("worldFromCamera"), FieldId("cameraFromWorld")};

/// Angles in degrees that look like radians: a note for each.
std::vector<std::string> radiansNotes(const FieldValues& values) {
  std::vector<std::string> notes;
  for (const FieldId field :
       {FieldId("projection.fovY"), FieldId("projection.fovX"), FieldId("projection.fovDiagonal")}) {
    if (!values.has(field) || !values.node(field).json().is_number()) continue;
    // Half a turn is 3.14 radians, and few lenses see less than 3 degrees.
    const double degrees = values.find<Angle>(field)->value;
    if (!(degrees >= 0.05 && degrees < 3.2)) continue;
    notes.push_back(values.node(field).place().first + ": is " + formatNumber(degrees) + " degrees; \"" +
                    formatNumber(degrees) + "rad\" would be " + formatDigits(degrees * 180 / std::numbers::pi, 6) +
                    " degrees");
  }
  for (const FieldId field : kPoseFields)
    if (values.has(field) && anyTurns(values.node(field).json(), mayBeRadians))
      notes.push_back(values.node(field).place().first +
                      ": rpy is in degrees here; a URDF's and tf's radians are written 1.5708rad");
  return notes;
}

/// A matrix that is no exact rotation, as numbers of few digits leave it: a note. Empty for numbers of six digits.
std::string roundingNote(const FieldValues& values, const Pose& pose) {
  constexpr double kLeast = 2e-5;
  const double off = rotationError(pose);
  if (off < kLeast) return "";
  const char* const field = values.has("cameraFromWorld") ? "cameraFromWorld" : "worldFromCamera";
  return std::string(field) + ": is no exact rotation: its axes are off by " + formatDigits(off, 2) +
         ", as of numbers with few digits; pixels may be off by as much of a focal length";
}

bool turnsBy(std::string_view order, const FieldValues& values) {
  return std::any_of(std::begin(kPoseFields), std::end(kPoseFields), [&](const FieldId field) {
    return values.has(field) &&
           anyTurns(values.node(field).json(), [&](const Json& turns) { return turns["order"] == order; });
  });
}

/// Not a lens of zeros, which is the pinhole.
bool distorts(const Lens& lens) { return lensOf(withLens(cameraIn({}, {}, perspective(60, 1, 1)), lens)).has_value(); }

/// fx and fy of the pinhole that agrees on the axis with a lens that has these.
Vec2 pinholeFocalLengths(double fx, double fy, const Lens& lens) {
  const Viewport one{1, 1};
  const Projection pinhole = calibrated(intrinsics(fx, fy, 0.5, 0.5, one, 0, kInfiniteFar), lens);
  const Intrinsics k = cameraIn({}, std::nullopt, pinhole, one).intrinsics();
  return {k.fx, k.fy};
}

CameraFile readParts(const FieldValues& values, const ReadOptions& reading) {
  CameraFile file;
  file.document = values.document();
  file.name = file.document.name;
  file.isTyped = file.document.isTyped;
  file.reading = reading;
  const DocumentConvention stated = readConvention(values);
  file.preset = stated.preset;
  file.convention = stated.convention;
  file.statesConvention = stated.isStated;
  const bool isPresetsWorld = stated.preset->convention.world == stated.convention.world;
  file.cameraAxes = isPresetsWorld                               ? stated.preset->cameraAxes
                    : file.convention.world == Handedness::right ? CameraAxes::RUB
                                                                 : CameraAxes::RUF;
  readWorld(values, file);
  file.pose = readPose(values, stated);
  if (const auto* const target = values.find<Position>("target"); target && file.pose) {
    file.targetDistance = apart(target->point, file.pose->eye());
  }
  const auto picture = readPicture(values, stated, reading);
  file.projection = readProjection(values, stated, picture, reading);
  file.notes = radiansNotes(values);
  file.notes.insert(file.notes.end(), file.document.notes.begin(), file.document.notes.end());
  if (const std::string rounding = file.pose ? roundingNote(values, *file.pose) : ""; !rounding.empty())
    file.notes.push_back(rounding);
  for (const auto& [order, told] : kOrderNotes)
    if (file.convention.world == Handedness::right && turnsBy(order, values)) file.notes.emplace_back(told);
  if (picture && picture->crop && file.projection)
    file.projection = cropped(*file.projection, picture->frame, *picture->crop);
  if (picture) file.viewport = picture->tile();
  file.lacksSize = picture && picture->isSizeAssumed;
  if (const auto* const lens = values.find<LensNumbers>("distortion")) {
    if (typeOf(values) == kOrthographic)
      values.fail("distortion", "goes with a perspective, not with an orthographic projection");
    const Lens made = makeLens(*lens);
    if (distorts(made)) file.lens = made;
    // fx and fy are the calibration's, of the lens's own formula.
    if (typeOf(values) == kIntrinsics && file.projection) file.projection = calibrated(*file.projection, made);
  }
  (void)cameraIn(file.convention, file.pose, file.projection,
                 file.viewport);  // throws if the parts do not fit together
  return file;
}

/// The value that an error of the library is about.
Node nodeOf(const FieldValues& values, const std::string& field) {
  const Json& root = *values.document().root;
  for (const std::string& path : {field, "projection." + field, "viewport." + field})
    if (valueAt(root, path)) return values.nodeAt(path);
  if (field == "rotation" || field == "columns")
    for (const char* path : {"euler", "worldFromCamera", "cameraFromWorld"})
      if (valueAt(root, path)) return values.nodeAt(path);
  return values.nodeAt("");
}

CameraFile readNormalized(const Document& document, const ReadOptions& reading) {
  const FieldValues values = readValues(document);
  try {
    return readParts(values, reading);
  } catch (const CameraError& e) {
    const Node at = nodeOf(values, e.field());
    at.fail((at.path().empty() ? e.field() + ": " : "") + e.message());
  }
}

/// What is lost without the lens, in words: how far it shifts pixels.
std::string lossWithout(const CameraFile& file) {
  if (!file.pose || !file.projection || !file.viewport || file.lacksSize) return "";
  const LensShift shift = lensShift(makeCamera(file));
  return ", up to " + formatDigits(shift.largest, 3) + " pixels" +
         (shift.behind > 0 ? "; " + std::to_string(shift.behind) + " of 289 positions look past 90 degrees and are lost"
                           : "");
}

}  // namespace

void CameraFile::fail(const std::string& message) const {
  if (isTyped) throw UsageError(message);
  throw InputError(message);
}

CameraFile readCamera(Document document, const ReadOptions& reading) {
  normalize(document);
  if (!reading.ignoreDistortion || !valueAt(*document.root, "distortion")) return readNormalized(document, reading);
  std::optional<CameraFile> bent;
  try {
    bent = readNormalized(document, reading);
  } catch (const std::runtime_error&) {  // a lens that is not known, or another fault: that is for the reader below
  }
  document.root = std::make_shared<Json>(*document.root);
  document.root->erase("distortion");
  if (bent && bent->lens && valueAt(*document.root, "projection.fx") && valueAt(*document.root, "projection.fy")) {
    Json& projection = (*document.root)["projection"];
    const Vec2 f = pinholeFocalLengths(projection["fx"], projection["fy"], *bent->lens);
    projection["fx"] = f.x;
    projection["fy"] = f.y;
  }
  CameraFile file = readNormalized(document, reading);
  if (!bent || bent->lens)
    file.notes.push_back(file.name + ": the lens distortion is ignored" + (bent ? lossWithout(*bent) : ""));
  return file;
}

void requireNear(const CameraFile& file, const std::string& what) {
  if (file.projection && !hasDepth(*file.projection))
    file.fail(what + " needs near, which " + file.name + " does not have; --near gives it");
}

void requireSize(const CameraFile& file, const std::string& what) {
  if (file.lacksSize) file.fail(what + " needs the size of the picture; --viewport WIDTHxHEIGHT gives it");
}

void requireUp(const CameraFile& file, const std::string& what) {
  if (!knowsUp(file))
    file.fail(what + " needs a world that knows north and up: a camera on the Earth, or \"world\": \"enu\", which " +
              file.name + " does not have; --set world=enu gives it");
}

void requireStraightEdges(const CameraFile& file, const std::string& what) {
  if (file.lens)
    file.fail(what + " needs straight edges, which the lens of " + file.name +
              " bends; --ignore-distortion ignores its distortion");
}

Camera makeCamera(const CameraFile& file) {
  const auto require = [&](bool good, const char* part) {
    if (!good) file.fail(file.name + ": the camera has no " + part);
  };
  require(file.pose.has_value(), "pose; give a position with a target, a direction or a rotation");
  require(file.projection.has_value(), "projection; give an angle of view, as in --fov-y 60, or fx, fy, cx and cy");
  require(file.viewport.has_value(), "viewport; --viewport WIDTHxHEIGHT gives one");
  const Camera camera = makeCamera(*file.pose, *file.projection, *file.viewport, file.convention);
  return file.lens ? withLens(camera, *file.lens) : camera;
}

Camera cameraIn(Convention convention, const std::optional<Pose>& pose, const std::optional<Projection>& projection,
                const std::optional<Viewport>& viewport) {
  if (pose) convention.world = pose->world();
  return makeCamera(pose ? *pose : lookAlong({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, convention.world),
                    projection ? *projection : orthographic(-1, 1, -1, 1, 0, 1), viewport.value_or(Viewport{1, 1}),
                    convention);
}

}  // namespace viewproj::cmd
