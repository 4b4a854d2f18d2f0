#include "commands/check/hypothesis.hpp"

#include <algorithm>

#include "camera/values.hpp"
#include "text/error.hpp"
#include "viewproj/geodesy.hpp"
#include "viewproj/screen.hpp"

namespace viewproj::cmd::mistakes {
namespace {

/// Makes {"x": ..., "y": ..., "z": ...} arrays, at any depth.
void spreadVectors(Json& value) {
  if (value.is_object() && value.contains("z")) {
    Json array = Json::array();
    for (const char* const part : {"x", "y", "z", "w"})
      if (value.contains(part)) array.push_back(value[part]);
    value = std::move(array);
  }
  if (value.is_structured())
    for (Json& part : value) spreadVectors(part);
}

CameraFile withArrays(const CameraFile& file) {
  const Document arrays = copied(file.document);
  spreadVectors(*arrays.root);
  return readCamera(arrays, file.reading);
}

}  // namespace

PixelMap operator*(const PixelMap& b, const PixelMap& a) {
  const Vec2 at = b({a.x0, a.y0});
  return {b.xx * a.xx + b.xy * a.yx, b.xx * a.xy + b.xy * a.yy, at.x,
          b.yx * a.xx + b.yy * a.yx, b.yx * a.xy + b.yy * a.yy, at.y};
}

Vec4 Hypothesis::point(const Vec4& p) const {
  const Vec3 at = points * Vec3{p.x, p.y, p.z};
  if (places == PlaceMap::none) return {at.x, at.y, at.z, p.w};
  const Geodetic g = ecefToGeodetic({p.x, p.y, p.z});
  const Vec3 moved = geodeticToEcef(places == PlaceMap::exchange    ? Geodetic{g.lon, g.lat, g.height}
                                    : places == PlaceMap::negateLon ? Geodetic{g.lat, -g.lon, g.height}
                                                                    : Geodetic{-g.lat, g.lon, g.height});
  return {moved.x, moved.y, moved.z, p.w};
}

Vec2 Hypothesis::pixel(const Vec2& given) const {
  Vec2 at = pixels(given);
  for (int i = 0; i > lensPasses; --i) at = withoutLens(camera, at);
  for (int i = 0; i < lensPasses; ++i) at = bentAgain(camera, at);
  return at;
}

Vec2 missOf(const Hypothesis& h, const Pair& pair) {
  return pixelOf(h.camera, h.point(pair.point)) - h.pixel(pair.pixel);
}

std::vector<Vec2> missesOf(const Hypothesis& h, std::span<const Pair> pairs) {
  std::vector<Vec2> misses;
  for (const Pair& pair : pairs) misses.push_back(missOf(h, pair));
  return misses;
}

std::vector<Patch> patchesOf(const std::vector<Set>& sets) {
  std::vector<Patch> patches;
  for (const auto& [path, value] : sets)
    patches.push_back({path, std::make_shared<const Json>(value), "--set " + path, false});
  return patches;
}

CameraFile changed(const CameraFile& file, const std::vector<Patch>& patches, bool stretch) {
  Document document = copied(file.document);
  applyPatches(document, patches);
  ReadOptions reading = file.reading;
  reading.allowStretch |= stretch;
  return readCamera(document, reading);
}

std::optional<PlainCamera> plainWith(const CameraFile& file, const std::vector<Patch>& patches, bool stretch) {
  try {
    return plainOf(makeCamera(changed(file, patches, stretch)));
  } catch (const CameraError&) {
  } catch (const InputError&) {
  } catch (const UsageError&) {
  }
  return std::nullopt;
}

Rows worldAt(const CameraFile& file, const Vec3& point) {
  if (!file.worldIsEcef) return kUnit;
  const auto [east, north, up] = localAxes(ecefToGeodetic(point));
  return {east, north, up};
}

// ---- Trials

Trials::Trials(const CameraFile& file)
    : file_(withArrays(file)), camera_(makeCamera(file_)), plain_(plainOf(camera_)) {}

Vec3 Trials::up() const {
  if (const Json* const own = find("up")) return unit({(*own)[0], (*own)[1], (*own)[2]});
  return knowsUp(file_) ? worldAt(file_, plain_.eye)[2] : file_.preset->up;
}

std::pair<Vec2, Vec2> Trials::corners() const {
  const auto corners = pictureCorners(camera_.viewport());
  return {corners.first, corners.last};
}

double Trials::numberOr(std::string_view path, double fallback) const {
  const Json* const value = find(path);
  return value && value->is_number() ? value->get<double>() : fallback;
}

double Trials::degreesOr(std::string_view path, double fallback) const {
  const Json* const value = find(path);
  return value ? degreesOf(readAngle({file_.document, *value, std::string(path)})) : fallback;
}

void Trials::change(const std::string& mistake, std::vector<Set> sets, Json value, bool stretch) {
  if (const auto camera = plainWith(file_, patchesOf(sets), stretch))
    add({.mistake = mistake,
         .value = std::move(value),
         .camera = *camera,
         .sets = std::move(sets),
         .stretch = stretch});
}

void Trials::pixels(const std::string& mistake, const PixelMap& map, Json value) {
  add({.mistake = mistake, .value = std::move(value), .camera = plain_, .pixels = map});
}

void Trials::points(const std::string& mistake, const Rows& rows, Json value) {
  add({.mistake = mistake, .value = std::move(value), .camera = plain_, .points = rows});
}

void Trials::pose(const std::string& mistake, const Rows& axes, const Vec3& eye, Json value) {
  PlainCamera camera = plain_;
  camera.axes = axes;
  camera.eye = eye;
  add({.mistake = mistake, .value = std::move(value), .camera = std::move(camera)});
}

std::vector<Hypothesis> rowsOf(const CameraFile& file) {
  Trials t(file);
  addWindowRows(t);
  addPoseRows(t);
  addPixelRows(t);
  return t.take();
}

std::vector<std::pair<std::string, Rows>> signedAxes() {
  std::vector<std::pair<std::string, Rows>> all;
  std::array<std::size_t, 3> from{0, 1, 2};
  do {
    for (unsigned signs = 0; signs < 8; ++signs) {
      std::string name;
      Rows rows{};
      for (std::size_t i = 0; i < 3; ++i) {
        const bool isNegative = signs >> (2 - i) & 1;
        rows[i][from[i]] = isNegative ? -1 : 1;
        name += (i == 0 ? "" : ",") + std::string(isNegative ? "-" : "") + "xyz"[from[i]];
      }
      all.emplace_back(std::move(name), rows);
    }
  } while (std::next_permutation(from.begin(), from.end()));
  return all;
}

}  // namespace viewproj::cmd::mistakes
