#include "commands/check/hypothesis.hpp"

#include <algorithm>
#include <numeric>

#include "camera/plain_camera.hpp"
#include "camera/read_pose.hpp"
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

CameraFile readSpread(const Document& document, const ReadOptions& reading) {
  const Document arrays = copied(document);
  spreadVectors(*arrays.root);
  return readCamera(arrays, reading);
}

/// Right, down and forward of a camera in the axes of its rotation.
Rows ownAxesOf(const CameraFile& file) {
  const std::string_view letters = nameOf(kCameraAxesNames, cameraAxesOf(readValues(file.document), *file.preset));
  Rows axes{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t side = std::string_view("RLDUFB").find(letters[i]);
    axes[side / 2][i] = side % 2 == 0 ? 1 : -1;
  }
  return axes;
}

Vec3 upOf(const CameraFile& file) {
  Vec3 up = readConvention(file.document).preset->up;
  if (file.worldIsEnu) up = {0, 0, 1};
  if (file.worldIsEcef) up = ellipsoidNormal(ecefToGeodetic(file.pose->eye()));
  if (const Json* const own = valueAt(*file.document.root, "up"))
    up = {(*own)[0].get<double>(), (*own)[1].get<double>(), (*own)[2].get<double>()};
  return scaled(up, 1 / length(up));
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

Trials::Trials(const Document& document, const ReadOptions& reading)
    : file_(readSpread(document, reading)),
      reading_(reading),
      camera_(makeCamera(file_)),
      plain_(plainOf(camera_)),
      up_(upOf(file_)),
      ownAxes_(ownAxesOf(file_)) {}

Vec2 Trials::first() const { return pictureCorners(camera_.viewport()).first; }
Vec2 Trials::last() const { return pictureCorners(camera_.viewport()).last; }

const Json* Trials::find(std::string_view path) const { return valueAt(*file_.document.root, path); }

double Trials::numberOr(std::string_view path, double fallback) const {
  const Json* const value = find(path);
  return value && value->is_number() ? value->get<double>() : fallback;
}

double Trials::degreesOr(std::string_view path, double fallback) const {
  const Json* const value = find(path);
  return value ? degreesOf(readAngle({file_.document, *value, std::string(path)})) : fallback;
}

Hypothesis Trials::next(const std::string& mistake, Json value) const {
  return {.mistake = mistake, .value = std::move(value), .camera = plain_};
}

void Trials::change(const std::string& mistake, std::vector<Set> sets, Json value, bool stretch) {
  const auto camera = plainWith(file_, patchesOf(sets), stretch);
  if (!camera) return;
  Hypothesis hypothesis = next(mistake, std::move(value));
  hypothesis.camera = *camera;
  hypothesis.sets = std::move(sets);
  hypothesis.stretch = stretch;
  add(std::move(hypothesis));
}

void Trials::pixels(const std::string& mistake, const PixelMap& map, Json value) {
  Hypothesis hypothesis = next(mistake, std::move(value));
  hypothesis.pixels = map;
  add(std::move(hypothesis));
}

void Trials::points(const std::string& mistake, const Rows& rows, Json value) {
  Hypothesis hypothesis = next(mistake, std::move(value));
  hypothesis.points = rows;
  add(std::move(hypothesis));
}

void Trials::pose(const std::string& mistake, const Rows& axes, const Vec3& eye, Json value) {
  Hypothesis hypothesis = next(mistake, std::move(value));
  hypothesis.camera.axes = axes;
  hypothesis.camera.eye = eye;
  hypothesis.isSolved = true;
  add(std::move(hypothesis));
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
