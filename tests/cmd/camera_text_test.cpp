// Every camera written as a canonical file, in every form that can hold it, and read again: the same pixels.
#include "output/camera_text.hpp"

#include <map>
#include <nlohmann/json.hpp>

#include "camera/camera.hpp"
#include "camera/names.hpp"
#include "catch.hpp"
#include "random.hpp"
#include "text/error.hpp"
#include "viewproj/viewproj.hpp"

using namespace viewproj;
using namespace viewproj::detail;
using namespace viewproj::cmd;
using nlohmann::json;

namespace {

/// Either sign, or a whole number now and then.
double number(Random& random, double low, double high) {
  const double size = random.logUniform(low, high);
  const double x = random.oneIn(4) ? std::round(size) : size;
  return random.oneIn(2) ? x : -x;
}

json vector(Random& random, double low, double high) {
  return {number(random, low, high), number(random, low, high), number(random, low, high)};
}

/// Angles and offsets for which doubles suffice, or any.
struct Extent {
  double narrowest, widest, farthestOffset;
};
constexpr Extent kOrdinary{0.01, 179, 20}, kExtreme{1e-9, 179.999999, 1e10};

json randomProjection(Random& random, const std::string& type, double width, double height, const Extent& extent,
                      std::map<std::string, int>& tally) {
  json p{{"type", type}};
  const double near = random.logUniform(1e-3, 1e2);
  p["near"] = near;
  if (type == "orthographic") p["near"] = random.oneIn(2) ? -near : near;
  if (type == "orthographic" || !random.oneIn(3))
    p["far"] = near * random.logUniform(1.5, 1e9);
  else
    ++tally["infinite far"];
  const double fov =
      random.oneIn(2) ? random.logUniform(extent.narrowest, 90) : 180 - random.logUniform(180 - extent.widest, 90);
  const double half = std::tan(fov * 0.008726646259971648);
  // Where the window's middle lies, in windows.
  const double middle = random.oneIn(2) ? 0 : number(random, 1e-3, extent.farthestOffset);
  if (type == "perspective") {
    const auto way = random.below(5);
    const char* const names[] = {"fovY", "fovX", "fovDiagonal", "nearWidth", "focalLength"};
    ++tally[names[way]];
    if (way < 3) p[names[way]] = fov;
    if (way == 3) {
      p["nearWidth"] = half * near * width;
      p["nearHeight"] = half * near * height;
    }
    if (way == 4) {
      p["focalLength"] = 35;
      p["sensorWidth"] = 70 * half;
    }
  } else if (type == "frustum" || type == "orthographic") {
    const double k = (type == "frustum" ? near : random.logUniform(1, 1e3)) * half;
    p["left"] = k * (2 * middle - 1);
    p["right"] = k * (2 * middle + 1);
    p["bottom"] = -k * height / width;
    p["top"] = k * height / width;
  } else {
    const double fx = width / 2 / half;
    p["cx"] = number(random, 1, 4096);
    p["cy"] = number(random, 1, 4096);
    if (type == "intrinsics") {
      p["fx"] = fx;
      p["fy"] = fx * random.uniform(0.5, 2);
      p["cx"] = width * (middle + 0.5);
      p["cy"] = height / 2;
    } else {
      p["scrz"] = fx;
      p["ax"] = random.uniform(0.5, 2);
      p["ay"] = random.uniform(0.5, 2);
      p["zMin"] = 1;
      p["zMax"] = 16777215;
    }
  }
  if (random.oneIn(3)) {
    p["shift"] = {number(random, 1e-6, 2), random.oneIn(3) ? 0 : number(random, 1e-6, 2)};
    ++tally["shift"];
  }
  return p;
}

void addPose(Random& random, json& camera, Handedness world, std::map<std::string, int>& tally) {
  const json eye = vector(random, 1e-3, 1e7);
  const char* const ways[] = {"target", "direction", "rotation", "worldFromCamera", "cameraFromWorld"};
  const std::string way = ways[random.below(5)];
  ++tally[way];
  if (way == "target" || way == "direction") {
    camera["position"] = eye;
    json where = vector(random, 1e-3, 1e3);
    if (way == "target")
      for (std::size_t i = 0; i < 3; ++i) where[i] = where[i].get<double>() + eye[i].get<double>();
    camera[way] = where;
    if (random.oneIn(2)) camera["up"] = vector(random, 1e-3, 1e3);
    return;
  }
  const bool rightHanded = world == Handedness::right;
  camera["cameraAxes"] = rightHanded ? random.oneIn(2) ? "RUB" : "RDF" : random.oneIn(2) ? "RUF" : "FRU";
  const double q[] = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
  if (way == "rotation") {
    camera["position"] = eye;
    camera["rotation"] = q;
    return;
  }
  // A rotation's entries, rounded to few digits now and then, as matrices in files are.
  const double n = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], s = 2 / n;
  const double x = q[0], y = q[1], z = q[2], w = q[3];
  json rows = {{1 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w), eye[0]},
               {s * (x * y + z * w), 1 - s * (x * x + z * z), s * (y * z - x * w), eye[1]},
               {s * (x * z - y * w), s * (y * z + x * w), 1 - s * (x * x + y * y), eye[2]},
               {0, 0, 0, 1}};
  if (random.oneIn(2)) {
    ++tally["a matrix of few digits"];
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) rows[i][j] = std::round(rows[i][j].get<double>() * 1e5) / 1e5;
  }
  camera[way] = rows;
}

json randomCamera(Random& random, const Extent& extent, std::map<std::string, int>& tally) {
  const auto presets = conventionPresets();
  const char* const types[] = {"perspective", "frustum", "intrinsics", "ps2", "orthographic"};
  const std::string type = types[random.below(5)];
  const ConventionPreset& preset = presets[random.below(presets.size())];
  ++tally[type];
  ++tally["from " + std::string(preset.name)];
  Convention c = preset.convention;
  json camera{{"convention", {{"preset", preset.name}}}};
  if (type == "ps2") camera["convention"]["reverseZ"] = c.reverseZ = true;
  if (random.oneIn(3)) {
    c.world = random.oneIn(2) ? Handedness::left : Handedness::right;
    camera["convention"]["world"] = nameOf(kWorldNames, c.world);
    camera["convention"]["ndcZ"] = random.oneIn(2) ? "-1..1" : "0..1";
    ++tally["other axes than the preset's"];
  }
  const double width = std::round(random.logUniform(16, 8192)), height = std::round(random.logUniform(16, 8192));
  camera["projection"] = randomProjection(random, type, width, height, extent, tally);
  json& v = camera["viewport"] = {{"width", width}, {"height", height}};
  if (type != "ps2" && random.oneIn(3)) {
    v["x"] = number(random, 1, 1000);
    v["y"] = number(random, 1, 1000);
    v["depthRange"] = {number(random, 1e-3, 1e3), number(random, 1e-3, 1e3)};
    ++tally["x, y and depthRange"];
  }
  if (random.oneIn(3)) {
    v["origin"] = "bottom-left";
    ++tally["origin"];
  }
  if (random.oneIn(3)) {
    v["pixelCenter"] = random.oneIn(2) ? 0 : random.uniform(0, 1);
    ++tally["pixelCenter"];
  }
  if (random.oneIn(4)) {
    v["crop"] = {{"x", random.uniform(0, width / 2)},
                 {"y", random.uniform(0, height / 2)},
                 {"width", random.uniform(1, width / 2)},
                 {"height", random.uniform(1, height / 2)}};
    ++tally["crop"];
  }
  addPose(random, camera, c.world, tally);
  return camera;
}

CameraFile read(const std::string& text, bool allowStretch = true) {
  return readCamera(load(text, "camera"), {.allowStretch = allowStretch});
}

/// The most by which pixels of the picture differ, and depths but for their rounding, of points between near and far.
Moved apartOf(Random& random, const CameraFile& a, const CameraFile& b) {
  const Camera first = makeCamera(a), second = makeCamera(b);
  const Viewport& v = first.viewport();
  Moved most;
  for (int i = 0; i < 8; ++i) {
    const double x = first.viewport().x + v.pixelCenter - 0.5 + v.width * (i < 4 ? i % 2 : random.uniform(0, 1));
    const double y = first.viewport().y + v.pixelCenter - 0.5 + v.height * (i < 4 ? i / 2 : random.uniform(0, 1));
    const double near = parts(first).projection.near, far = parts(first).projection.far;
    const double share = random.uniform(0, 1);
    const double distance = i % 3 == 0                             ? near
                            : parts(first).projection.orthographic ? near + (far - near) * share
                                                                   : 1 / (share / near + (1 - share) / far);
    const Ray ray = screenToRay(first, {x, y});
    const double ahead = ray.direction.x * parts(first).pose.rows.forward.x.hi +
                         ray.direction.y * parts(first).pose.rows.forward.y.hi +
                         ray.direction.z * parts(first).pose.rows.forward.z.hi;
    const double length = distance / ahead;
    const Vec3 point{ray.origin.x + ray.direction.x * length, ray.origin.y + ray.direction.y * length,
                     ray.origin.z + ray.direction.z * length};
    const ScreenPoint p = worldToScreen(first, point), q = worldToScreen(second, point);
    // The point was rounded: far from the origin it may lie beside the picture, or before near.
    const bool isInside = std::fabs(p.x - x) < 1e-3 * v.width && std::fabs(p.y - y) < 1e-3 * v.height;
    if (!(isInside && p.viewDistance >= near)) continue;
    for (double d : {std::fabs(p.x - q.x), std::fabs(p.y - q.y)})
      if (!(d <= most.pixels)) most.pixels = std::isnan(d) ? INFINITY : d;
    const double range = std::fabs(v.depthSecond - v.depthFirst);
    const double largest = std::max(std::fabs(v.depthFirst), std::fabs(v.depthSecond));
    const double depth = std::max(0.0, std::fabs(p.depth - q.depth) - 0x1p-52 * largest) / range;
    if (!(depth <= most.depth)) most.depth = std::isnan(depth) ? INFINITY : depth;
  }
  return most;
}

}  // namespace

TEST_CASE("A camera written in any type and read again keeps its pixels to 1e-9, and all the rest to the last bit") {
  std::map<std::string, int> tally;
  for (std::uint64_t trial = 0; trial < 6000; ++trial) {
    Random random(trial);
    const json text = randomCamera(random, kOrdinary, tally);
    INFO(trial << ": " << text.dump());
    CameraFile camera;
    try {
      camera = read(text.dump());
    } catch (const InputError&) {  // up along the view, more digits rounded than a rotation bears
      continue;
    }
    for (std::string_view type : {"", "perspective", "frustum", "intrinsics", "ps2", "orthographic"}) {
      const bool allowStretch = random.oneIn(2);
      INFO(type);
      WrittenCamera written;
      try {
        written = writeCamera(camera, type, allowStretch);
      } catch (const InputError& e) {
        const std::string message = e.what();
        INFO(message);
        const bool isOrthographic = parts(*camera.projection).orthographic;
        const bool otherKind = (type == "orthographic") != isOrthographic && type != "";
        const bool forward = type == "ps2" && !camera.convention.reverseZ;
        const bool shape = !allowStretch && type != "ps2" && type != "intrinsics" && (isOrthographic || type != "");
        CHECK((otherKind || forward || shape));
        ++tally[otherKind ? "cannot hold the other kind"
                : forward ? "cannot hold forward depth"
                          : "cannot hold stretch"];
        continue;
      }
      INFO(written.text);
      ++tally["as " + std::string(type.empty() ? "it comes" : type)];
      const CameraFile again = read(written.text);
      const Moved apart = apartOf(random, camera, again);
      CHECK(apart.pixels <= kKeptPixels);
      CHECK(apart.depth <= kKeptDepth);
      CHECK(written.moved.size() <= 1);
      CHECK(again.convention == camera.convention);
      CHECK(parts(*again.projection).orthographic == parts(*camera.projection).orthographic);
      CHECK(parts(*again.projection).near == parts(*camera.projection).near);
      CHECK(parts(*again.projection).far == parts(*camera.projection).far);
      const Viewport &a = *camera.viewport, &b = *again.viewport;
      CHECK((a.width == b.width && a.height == b.height && a.origin == b.origin && a.pixelCenter == b.pixelCenter));
      CHECK((a.depthFirst == b.depthFirst && a.depthSecond == b.depthSecond));
      if (type != "ps2") CHECK((a.x == b.x && a.y == b.y));
      // Whoever reads it need not allow a stretch unless the writer was told so.
      if (!allowStretch) CHECK_NOTHROW(read(written.text, false));
    }
  }
  for (const auto& [what, count] : tally) {
    INFO(what);
    CHECK(count >= 50);
  }
  CHECK(tally.size() == 43);
}

TEST_CASE("Where doubles do not hold a camera the writer says by how much its pixels move") {
  std::map<std::string, int> tally;
  double sharpest = 0;
  int kept = 0, moved = 0;
  for (std::uint64_t trial = 0; trial < 6000; ++trial) {
    Random random(trial);
    const json text = randomCamera(random, kExtreme, tally);
    INFO(trial << ": " << text.dump());
    CameraFile camera;
    try {
      camera = read(text.dump());
    } catch (const InputError&) {
      continue;
    }
    const WrittenCamera written = writeCamera(camera, "", true);
    INFO(written.text);
    const Moved apart = apartOf(random, camera, read(written.text));
    CHECK(apart.pixels <= written.moved.pixels * 1.01 + 1e-12);
    CHECK(apart.depth <= written.moved.depth * 1.01);
    written.moved.size() <= 1 ? ++kept : ++moved;
    sharpest = std::max(sharpest, apart.pixels / written.moved.pixels);
  }
  CHECK(kept > 1000);
  CHECK(moved > 250);
  CHECK(sharpest > 0.9);
}
