// To add a form: a function here that writes its fields, and a row in kTypes.
#include "output/camera_text.hpp"

#include <cmath>
#include <optional>

#include "camera/camera.hpp"
#include "camera/names.hpp"
#include "camera/screen_map.hpp"
#include "numbers/degrees.hpp"
#include "output/camera_json.hpp"
#include "text/error.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {

using namespace detail;
std::string jsonOf(const Convention& c) {
  JsonObject out;
  out.add("world", nameOf(kWorldNames, c.world)).add("view", nameOf(kViewNames, c.view));
  out.add("ndcZ", nameOf(kNdcZNames, c.ndcZ)).add("reverseZ", c.reverseZ);
  out.add("ndcY", nameOf(kNdcYNames, c.ndcY)).add("vectors", nameOf(kVectorsNames, c.vectors));
  return out.add("storage", nameOf(kStorageNames, c.storage)).text();
}

std::string conventionAsJson(const Convention& c, const ConventionPreset& preset) {
  const Convention& p = preset.convention;
  if (p == c) return jsonOf(preset.name);
  JsonObject out;
  out.add("preset", preset.name);
  if (p.world != c.world) out.add("world", nameOf(kWorldNames, c.world));
  if (p.view != c.view) out.add("view", nameOf(kViewNames, c.view));
  if (p.ndcZ != c.ndcZ) out.add("ndcZ", nameOf(kNdcZNames, c.ndcZ));
  if (p.reverseZ != c.reverseZ) out.add("reverseZ", c.reverseZ);
  if (p.ndcY != c.ndcY) out.add("ndcY", nameOf(kNdcYNames, c.ndcY));
  if (p.vectors != c.vectors) out.add("vectors", nameOf(kVectorsNames, c.vectors));
  if (p.storage != c.storage) out.add("storage", nameOf(kStorageNames, c.storage));
  return out.text();
}

namespace {

// Convention

/// The preset with the fewest other axes.
const ConventionPreset& nearestPreset(const Convention& c) {
  const auto differing = [&](const Convention& p) {
    return (p.world != c.world) + (p.view != c.view) + (p.ndcZ != c.ndcZ) + (p.reverseZ != c.reverseZ) +
           (p.ndcY != c.ndcY) + (p.vectors != c.vectors) + (p.storage != c.storage);
  };
  const ConventionPreset* nearest = &conventionPresets().front();
  for (const ConventionPreset& preset : conventionPresets())
    if (differing(preset.convention) < differing(nearest->convention)) nearest = &preset;
  return *nearest;
}

// Projection

DoubleDouble aspectOf(const Viewport& viewport) { return DoubleDouble(viewport.width) / DoubleDouble(viewport.height); }

void addRange(JsonObject& out, const ProjectionParts& p) {
  if (p.orthographic || p.near != 0) out.add("near", p.near);
  if (!std::isinf(p.far)) out.add("far", p.far);
}

/// The shift that moves base's window to where p has it, unless they agree.
void addShift(JsonObject& out, const ProjectionParts& base, const ProjectionParts& p) {
  const auto shift = [](DoubleDouble low, DoubleDouble high, DoubleDouble wantedLow, DoubleDouble wantedHigh) {
    const DoubleDouble moved = (low + high - wantedLow - wantedHigh) / (high - low);
    return std::fabs(moved.hi) <= 16 * kCancellation ? 0 : moved.hi;
  };
  const double x = shift(base.left, base.right, p.left, p.right), y = shift(base.bottom, base.top, p.bottom, p.top);
  if (x != 0 || y != 0) out.addText("shift", jsonListOf(std::array{x, y}));
}

ProjectionParts centred(const ProjectionParts& p) {
  const DoubleDouble halfWidth = timesPowerOfTwo(p.right - p.left, 0.5);
  const DoubleDouble halfHeight = timesPowerOfTwo(p.top - p.bottom, 0.5);
  return {false, -halfWidth, halfWidth, -halfHeight, halfHeight, p.near, p.far};
}

void writePerspective(JsonObject& out, const CameraFile& camera) {
  const ProjectionParts& p = parts(*camera.projection);
  const DoubleDouble aspect = windowAspect(p);
  out.addText("fovY", jsonOf(degreesOfHalfTangent(timesPowerOfTwo(p.top - p.bottom, 0.5))));
  const bool isViewports =
      camera.viewport && std::fabs((aspect - aspectOf(*camera.viewport)).hi) <= 16 * kCancellation * aspect.hi;
  if (!isViewports) out.addText("aspect", jsonOf(aspect));
  addRange(out, p);
  addShift(out, centred(p), p);
}

/// An angle next to 180 degrees has too few digits for its tangent.
void writeNearSize(JsonObject& out, const CameraFile& camera) {
  const ProjectionParts& p = parts(*camera.projection);
  out.addText("nearWidth", jsonOf((p.right - p.left) * DoubleDouble(p.near)));
  out.addText("nearHeight", jsonOf((p.top - p.bottom) * DoubleDouble(p.near)));
  addRange(out, p);
  addShift(out, centred(p), p);
}

void writeFrustum(JsonObject& out, const CameraFile& camera) {
  const ProjectionParts& p = parts(*camera.projection);
  const DoubleDouble near = p.near;
  out.addText("left", jsonOf(p.left * near));
  out.addText("right", jsonOf(p.right * near));
  out.addText("bottom", jsonOf(p.bottom * near));
  out.addText("top", jsonOf(p.top * near));
  addRange(out, p);
}

void writeIntrinsics(JsonObject& out, const CameraFile& camera) {
  const ScreenMap map = screenMap(parts(*camera.projection), *camera.viewport);
  out.addText("fx", jsonOf(map.scaleX));
  out.add("fy", std::fabs(map.scaleY.hi));
  out.addText("cx", jsonOf(map.centerX));
  out.addText("cy", jsonOf(map.centerY));
  addRange(out, parts(*camera.projection));
}

void writeOrthographic(JsonObject& out, const CameraFile& camera) {
  const ProjectionParts& p = parts(*camera.projection);
  out.addText("left", jsonOf(p.left));
  out.addText("right", jsonOf(p.right));
  out.addText("bottom", jsonOf(p.bottom));
  out.addText("top", jsonOf(p.top));
  addRange(out, p);
}

/// The frame lies around (cx, cy), so a window off the axis is a shift.
void writePs2(JsonObject& out, const CameraFile& camera) {
  const ProjectionParts& p = parts(*camera.projection);
  const Viewport& v = *camera.viewport;
  const ScreenMap map = screenMap(p, v);
  const double scrz = map.scaleX.hi, ay = (map.scaleY / map.scaleX).hi;
  const double cx = v.x + v.width / 2, cy = v.y + v.height / 2;
  out.add("scrz", scrz);
  out.add("ax", 1.0);
  out.add("ay", std::fabs(ay));
  out.addText("cx", jsonOf(cx));
  out.addText("cy", jsonOf(cy));
  out.add("zMin", v.depthFirst);
  out.add("zMax", v.depthSecond);
  addRange(out, p);
  addShift(out, parts(intrinsics(scrz, std::fabs(ay) * scrz, cx, cy, v, p.near, p.far)), p);
}

struct Type {
  std::string_view name;
  void (*write)(JsonObject&, const CameraFile&);
  bool orthographic, needsViewport, needsReversedDepth, hasOwnPixelShape, needsNear = false;
};

/// Of two rows of one name the first that keeps the pixels.
constexpr Type kTypes[] = {
    {"perspective", writePerspective, false, false, false, false},
    {"perspective", writeNearSize, false, false, false, false, true},
    {"frustum", writeFrustum, false, false, false, false, true},
    {"intrinsics", writeIntrinsics, false, true, false, true},
    {"ps2", writePs2, false, true, true, true, true},
    {"orthographic", writeOrthographic, true, false, false, false},
};

/// What the type cannot hold of the camera, or an empty string.
std::string beyond(const Type& type, const CameraFile& camera, bool allowStretch) {
  if (type.orthographic != camera.projection->isOrthographic())
    return type.orthographic ? "a perspective camera" : "an orthographic camera";
  if (type.needsViewport && !camera.viewport)
    return "a camera without a viewport, in whose pixels it counts; --viewport WIDTHxHEIGHT gives one";
  if (type.needsNear && !hasDepth(*camera.projection)) return "a camera without near";
  if (type.needsReversedDepth && !camera.convention.reverseZ)
    return "depth that is not reversed, since it maps near to zMax; --reverse-z or --convention ps2 writes it so";
  if (!type.hasOwnPixelShape && !allowStretch && camera.viewport &&
      !hasShape(*camera.viewport, camera.projection->aspect()))
    return "a camera shape unlike the viewport's (" + formatNumber(windowAspect(parts(*camera.projection)).hi) +
           " times as wide as high, and " + formatNumber(aspectOf(*camera.viewport).hi) + " times)" +
           (type.orthographic ? "; --allow-stretch writes it for readers that allow it too"
                              : "; --type intrinsics can, and --allow-stretch writes it for readers that allow it too");
  return "";
}

std::vector<const Type*> typesFor(const CameraFile& camera, std::string_view wanted, bool allowStretch) {
  if (!wanted.empty()) {
    if (!camera.projection)
      throw InputError(camera.name + ": the camera has no projection to write as " + std::string(wanted));
    std::vector<const Type*> types;
    for (const Type& type : kTypes)
      if (type.name == wanted) {
        if (const std::string what = beyond(type, camera, allowStretch); !what.empty())
          throw InputError(camera.name + ": " + std::string(wanted) + " cannot hold " + what);
        types.push_back(&type);
      }
    return types;
  }
  if (!camera.projection) return {nullptr};
  // A shape unlike the viewport's goes into a type that says itself how wide a pixel is, if one can.
  std::vector<const Type*> types;
  for (const Type& type : kTypes)
    if (type.name != "ps2" && beyond(type, camera, false).empty()) types.push_back(&type);
  if (types.empty())  // an orthographic camera that was read so itself
    for (const Type& type : kTypes)
      if (beyond(type, camera, true).empty()) types.push_back(&type);
  return types;
}

// The file

std::string viewportAsJson(const Viewport& v, const ConventionPreset& preset, bool isPs2) {
  JsonObject fields;
  fields.add("width", v.width);
  fields.add("height", v.height);
  if (!isPs2) {
    if (v.x != 0) fields.add("x", v.x);
    if (v.y != 0) fields.add("y", v.y);
    if (!(v.depthFirst == 0 && v.depthSecond == 1))
      fields.addText("depthRange", jsonListOf(std::array{v.depthFirst, v.depthSecond}));
  }
  if (v.origin != Origin::topLeft) fields.add("origin", nameOf(kOriginNames, v.origin));
  if (v.pixelCenter != preset.pixelCenter) fields.add("pixelCenter", v.pixelCenter);
  return fields.text();
}

std::string fileOf(const CameraFile& camera, const ConventionPreset& preset, const std::string& pose,
                   const Type* type) {
  JsonObject out;
  constexpr std::string_view kLine = ",\n  ";
  out.addText("convention", conventionAsJson(camera.convention, preset), kLine);
  if (camera.worldIsEcef) out.addText("world", jsonOf(nameOf(kWorlds, true)), kLine);
  out.addMembers(pose, kLine);
  if (type) {
    JsonObject fields;
    fields.add("type", type->name);
    type->write(fields, camera);
    out.addText("projection", fields.text(), kLine);
  }
  if (camera.viewport)
    out.addText("viewport", viewportAsJson(*camera.viewport, preset, type && type->name == "ps2"), kLine);
  return "{\n  " + out.members() + "\n}\n";
}

/// By how much the axes turn from one to the other, in radians at the most.
double turnedBetween(const CameraFile& first, const CameraFile& second) {
  if (!first.pose || !second.pose) return 0;
  const Axes &before = parts(*first.pose).rows, &after = parts(*second.pose).rows;
  double most = 0;
  for (const auto& [a, b] :
       {std::pair(before.right, after.right), {before.up, after.up}, {before.forward, after.forward}})
    for (std::size_t i = 0; i < 3; ++i) most = std::max(most, std::fabs((a[i] - b[i]).hi));
  return 2 * most;
}

}  // namespace

std::vector<std::string_view> cameraTypes() {
  std::vector<std::string_view> names;
  for (const Type& type : kTypes)
    if (names.empty() || names.back() != type.name) names.push_back(type.name);
  return names;
}

WrittenCamera writeCamera(const CameraFile& camera, std::string_view wanted, bool allowStretch) {
  const ConventionPreset& preset = nearestPreset(camera.convention);
  std::optional<WrittenCamera> best;
  std::string fault;
  for (const Type* type : typesFor(camera, wanted, allowStretch))
    for (const std::string& pose : poseForms(camera, preset)) {
      try {
        const std::string text = fileOf(camera, preset, pose, type);
        const CameraFile again = readCamera(load(text, "the file written"), {.allowStretch = true});
        const Moved moved = movedBetween(camera, again);
        if (!best || moved.size() < best->moved.size()) best = {text, moved, turnedBetween(camera, again)};
      } catch (const std::exception& e) {  // a number that leaves the range of doubles in this form
        fault = e.what();
      }
      if (best && best->moved.size() <= 1) return *best;
    }
  if (!best) throw InputError(camera.name + ": its numbers leave the range of doubles: " + fault);
  return *best;
}

}  // namespace viewproj::cmd
