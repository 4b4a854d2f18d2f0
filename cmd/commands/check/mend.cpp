#include "commands/check/mend.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "camera/change_camera.hpp"
#include "camera/read_pose.hpp"
#include "camera/values.hpp"
#include "text/error.hpp"
#include "text/json_text.hpp"
#include "text/number.hpp"
#include "viewproj/geodesy.hpp"

namespace viewproj::cmd::mistakes {

using detail::dot;
namespace {

struct Meaning {
  std::string_view mistake, words;
};
constexpr Meaning kMeanings[] = {
    {"y-flipped", "y is counted from the other edge of the picture"},
    {"y-flipped-index", "y is counted from the other edge, and is one pixel off"},
    {"x-mirrored", "mirrored: one side is left-handed and the other right-handed"},
    {"pixel-centre", "one side has pixel centres at whole numbers, the other at .5"},
    {"pixel-ratio", "the pixels are VALUE times these, as device pixels are of CSS pixels"},
    {"viewport-offset", "the viewport's or the crop's corner is left out, or added twice"},
    {"picture-size", "fx, fy, cx, cy are of a picture of another size"},
    {"fov-axis", "the angle of view is that of another axis"},
    {"aspect", "the aspect is left out, or inverted"},
    {"radians", "an angle in radians is taken for degrees, or the reverse"},
    {"direction-as-target", "a direction is taken for a target, or the reverse"},
    {"up-axis", "one side has y up and the other z up, or is upside down"},
    {"pose-inverted", "the pose is inverted: world-to-camera for camera-to-world"},
    {"quaternion-order", "the quaternion has w first on one side and last on the other"},
    {"camera-axes", "the pose counts on other axes of the camera"},
    {"distortion-ignored", "the pixels are without the distortion of the lens"},
    {"distortion-twice", "the distortion of the lens is taken twice"},
    {"normalized", "the pixels are 0..1 across the picture"},
    {"ndc", "the pixels are normalized device coordinates, -1..1"},
    {"picture-turned", "the picture is turned by VALUE degrees"},
    {"row-column", "row and column are exchanged"},
    {"ndc-twice", "half the picture is added to NDC that were scaled already"},
    {"half-angle", "half the angle of view is given for the whole, or the reverse"},
    {"sensor", "the sensor is of another size"},
    {"fx-fy-exchanged", "fx and fy are exchanged"},
    {"intrinsics-order", "the four numbers fx, fy, cx, cy are in another order"},
    {"principal-point", "the principal point is elsewhere, as in a crop: VALUE"},
    {"intrinsics-normalized", "fx, fy, cx, cy are parts of the picture's size"},
    {"size-exchanged", "width and height are exchanged"},
    {"translation-as-position", "the translation is taken for the position, or the reverse"},
    {"position-sign", "the position has the other sign"},
    {"translation-left-out", "the translation is left out"},
    {"pose-left-out", "the rotation, or the whole pose, is left out"},
    {"pose-twice", "the pose is applied twice"},
    {"eye-target-exchanged", "eye and target are exchanged"},
    {"unit", "positions and points are in other units: VALUE"},
    {"point-axes", "the points are in other axes: VALUE"},
    {"euler-order", "the angles go with another order of turns: VALUE"},
    {"euler-sign", "an angle has the other sign: VALUE"},
    {"heading-convention", "the heading is counted the other way, or from elsewhere"},
    {"pitch-convention", "the pitch is counted the other way, or from elsewhere"},
    {"roll-convention", "the roll is counted the other way, or from elsewhere"},
    {"place", "latitude and longitude are exchanged, or one has the other sign"},
    {"lens-order", "the coefficients of the lens are in another order"},
    {"lens-sign", "the coefficients of the lens have the other sign: they undistort"},
    {"fisheye-for-brown", "a fisheye's coefficients are read as Brown's, or the reverse"},
    {"focal-length", "the focal length is VALUE times this one's"},
    {"focal-lengths", "the focal lengths across and down are VALUE times these"},
    {"resized", "the picture is resized: VALUE times this one across and down"},
    {"scale-and-offset", "the picture is scaled and moved, as in a letterbox: VALUE"},
    {"scales-and-offset", "the picture is scaled across and down, and moved: VALUE"},
    {"heading", "the camera is turned by VALUE degrees about up"},
    {"pitch", "the camera is tilted by VALUE degrees"},
    {"roll", "the camera is rolled by VALUE degrees"},
    {"rotation", "the camera is turned by VALUE degrees"},
    {"pan-tilt-zoom", "the camera is turned, and has another focal length: VALUE degrees, times"},
    {"height", "the eye is VALUE higher"},
    {"eye", "the eye is elsewhere: by VALUE"},
    {"lens", "the pixels have a lens: VALUE"},
    {"pose", "the camera is turned and elsewhere: VALUE degrees, x, y, z"},
    {"pose-and-focal-length", "pose and focal length are others: VALUE degrees, x, y, z"},
    {"another-camera", "another camera made the pixels: VALUE degrees, x, y, z"},
    {"pixel-order", "the pixels are in another order"}};

std::string shown(const Json& value) {
  if (value.is_number()) return formatDigits(value.get<double>(), 4);
  if (!value.is_array()) return value.is_string() ? value.get<std::string>() : value.dump();
  std::string text;
  for (const Json& part : value) text += (text.empty() ? "" : ", ") + shown(part);
  return text;
}

std::string sentence(std::string_view mistake, const Json& value) {
  if (const std::size_t plus = mistake.find(" + "); plus != mistake.npos)
    return sentence(mistake.substr(0, plus), value[0]) + "; " + sentence(mistake.substr(plus + 3), value[1]);
  std::string words(meaningOf(mistake));
  if (const std::size_t at = words.find("VALUE"); at != words.npos)
    words.replace(at, 5, value.is_null() ? "another" : shown(value));
  return words;
}

std::string inShell(const std::string& word) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.,:/=+";
  return word.find_first_not_of(kPlain) == std::string::npos ? word : "'" + word + "'";
}

/// A number of fewer significant digits; whole numbers stay.
double rounded(double value, int digits) {
  return digits >= 17 ? value : parseNumber(formatDigits(value, digits)).value_or(value);
}

Json rounded(const Json& value, int digits) {
  if (value.is_number_float()) return rounded(value.get<double>(), digits);
  Json copy = value;
  if (copy.is_structured())
    for (Json& part : copy) part = rounded(part, digits);
  return copy;
}

std::string optionsOf(const std::vector<Set>& sets, bool stretch) {
  std::string text;
  for (const auto& [path, value] : sets)
    text += (text.empty() ? "--set " : " --set ") +
            inShell(path + "=" + (value.is_string() ? value.get<std::string>() : value.dump()));
  return text + (stretch ? " --allow-stretch" : "");
}

std::string term(double factor, const char* name) {
  const double size = std::fabs(factor);
  return size == 1 ? name : size < 1 ? name + ("/" + formatDigits(1 / size, 12)) : formatDigits(size, 12) + name;
}

/// "0.5x + 3", "720 - y"
std::string formula(double x, double y, double offset) {
  std::string text;
  const auto add = [&](double sign, const std::string& part) {
    text += text.empty() ? (sign < 0 ? "-" : "") + part : (sign < 0 ? " - " : " + ") + part;
  };
  const bool isLast = (x == 0 || x > 0) && (y == 0 || y > 0);
  if (!isLast && offset != 0) add(offset, formatDigits(std::fabs(offset), 12));
  if (x != 0) add(x, term(x, "x"));
  if (y != 0) add(y, term(y, "y"));
  if (isLast && offset != 0) add(offset, formatDigits(std::fabs(offset), 12));
  return text.empty() ? "0" : text;
}

std::string pairsOf(const Hypothesis& h) {
  std::vector<std::string> words;
  const PixelMap& m = h.pixels;
  std::string pixels;
  if (m.xx != 1 || m.xy != 0 || m.x0 != 0) pixels = "x by " + formula(m.xx, m.xy, m.x0);
  if (m.yx != 0 || m.yy != 1 || m.y0 != 0)
    pixels += (pixels.empty() ? "" : " and ") + ("y by " + formula(m.yx, m.yy, m.y0));
  if (!pixels.empty()) words.push_back("replace " + pixels + " in the pixels");
  if (h.points != kUnit) {
    std::string axes;
    for (const Vec3& row : h.points)
      for (std::size_t i = 0; i < 3; ++i)
        if (row[i] != 0)
          axes += (axes.empty() ? "" : ",") + std::string(row[i] < 0 ? "-" : "") +
                  term(row[i], i == 0   ? "x"
                               : i == 1 ? "y"
                                        : "z");
    words.push_back("replace x,y,z of the points by " + axes);
  }
  if (h.places == PlaceMap::exchange) words.emplace_back("exchange lat and lon of the points");
  if (h.places == PlaceMap::negateLon) words.emplace_back("replace lon of the points by -lon");
  if (h.places == PlaceMap::negateLat) words.emplace_back("replace lat of the points by -lat");
  if (h.lensPasses < 0) words.emplace_back("undistort the pixels once; the lens is in them twice");
  if (h.lensPasses > 0) words.emplace_back("do not undistort the pixels; they are undistorted twice");
  std::string text;
  for (const std::string& each : words) text += (text.empty() ? "" : ", and ") + each;
  return text;
}

// ---- Plain numbers in the document's own forms. To be one function of cmd/camera.

Json listOf(const Vec3& v) { return {v.x + 0.0, v.y + 0.0, v.z + 0.0}; }

/// x, y, z, w of a rotation by rows (Shepperd).
Json quaternionOf(const Rows& m) {
  const double trace = m[0].x + m[1].y + m[2].z;
  const std::array<double, 4> size{2 * m[0].x - trace, 2 * m[1].y - trace, 2 * m[2].z - trace, trace};
  const auto most = static_cast<std::size_t>(std::max_element(size.begin(), size.end()) - size.begin());
  const double s = 2 * std::sqrt(1 + size[most]);
  const Vec3 skew{(m[2].y - m[1].z) / s, (m[0].z - m[2].x) / s, (m[1].x - m[0].y) / s};
  if (most == 3) return {skew.x, skew.y, skew.z, s / 4};
  const std::size_t j = (most + 1) % 3, k = (most + 2) % 3;
  std::array<double, 4> q{};
  q[most] = s / 4;
  q[j] = (m[j][most] + m[most][j]) / s;
  q[k] = (m[k][most] + m[most][k]) / s;
  q[3] = skew[most];
  return q;
}

void setLens(const CameraFile& file, const PlainCamera& from, const PlainCamera& to, std::vector<Set>& sets) {
  const Json& root = *file.document.root;
  const auto find = [&](const char* path) { return valueAt(root, path); };
  const auto number = [&](const char* path) { return find(path)->get<double>(); };
  const Viewport& v = *file.viewport;
  const double fx = to.focal.x / from.focal.x, fy = to.focal.y / from.focal.y;
  const Vec2 moved{to.centre.x - from.centre.x, to.centre.y - from.centre.y};
  const bool isScaled = std::fabs(fx - 1) > 1e-12 || std::fabs(fy - 1) > 1e-12;
  const bool isMoved = std::max(std::fabs(moved.x), std::fabs(moved.y)) > 1e-9;
  if (!isScaled && !isMoved) return;
  if (find("projection.fx") && !find("projection.shift")) {
    const Json* const pixels = find("projection.pixels");
    const Vec2 ratio = pixels ? Vec2{(*pixels)[0].get<double>() / number("viewport.width"),
                                     (*pixels)[1].get<double>() / number("viewport.height")}
                              : Vec2{1, 1};
    if (isScaled) {
      sets.emplace_back("projection.fx", number("projection.fx") * fx);
      sets.emplace_back("projection.fy", number("projection.fy") * fy);
    }
    if (moved.x != 0) sets.emplace_back("projection.cx", number("projection.cx") + moved.x * ratio.x);
    if (moved.y != 0) sets.emplace_back("projection.cy", number("projection.cy") + moved.y * ratio.y);
    return;
  }
  const bool hasAngle = find("projection.fovY") || find("projection.fovX") || find("projection.fovDiagonal");
  const bool canKeep =
      std::fabs(fx / fy - 1) < 1e-9 && (hasAngle || find("projection.focalLength")) && !find("viewport.crop");
  if (canKeep) {
    for (const char* const angle : {"projection.fovY", "projection.fovX", "projection.fovDiagonal"})
      if (const Json* const value = find(angle); value && isScaled) {
        const double half = degreesOf(readAngle({file.document, *value, angle})) * std::numbers::pi / 360;
        sets.emplace_back(angle, 360 / std::numbers::pi * std::atan(std::tan(half) / fx));
      }
    if (find("projection.focalLength") && isScaled)
      sets.emplace_back("projection.focalLength", number("projection.focalLength") * fx);
    if (isMoved) {
      const Json* const old = find("projection.shift");
      const double x = old ? (*old)[0].get<double>() : 0, y = old ? (*old)[1].get<double>() : 0;
      const double down = v.origin == Origin::topLeft ? 1 : -1;
      sets.emplace_back("projection.shift", Json{x + 2 * moved.x / v.width, y - 2 * down * moved.y / v.height});
    }
    return;
  }
  if (from.isOrthographic || find("projection.matrix")) return;  // not said yet
  const Json* const crop = find("viewport.crop");
  const double x = crop ? number("viewport.crop.x") : 0, y = crop ? number("viewport.crop.y") : 0;
  Json made{{"type", "intrinsics"},
            {"fx", to.focal.x},
            {"fy", std::fabs(to.focal.y)},
            {"cx", to.centre.x + x},
            {"cy", to.centre.y + y}};
  for (const char* const name : {"near", "far"})
    if (const Json* const value = find((std::string("projection.") + name).c_str())) made[name] = *value;
  sets.emplace_back("projection", made);
}

void setPose(const CameraFile& file, const Rows& ownAxes, const PlainCamera& from, const PlainCamera& to,
             std::vector<Set>& sets) {
  const Json& root = *file.document.root;
  const auto has = [&](const char* path) { return valueAt(root, path) != nullptr; };
  const bool isTurned = angleOf(to.axes * transposed(from.axes)) > 1e-12;
  const bool isMoved = length(sum(to.eye, -1, from.eye)) > 1e-13 * length(from.eye);
  if (!isTurned && !isMoved) return;
  const Rows own = transposed(ownAxes) * to.axes;  // from the world to the axes of the document's rotations
  for (const char* const path : {"worldFromCamera", "cameraFromWorld"}) {
    if (!has(path)) continue;
    const bool isView = *path == 'c';
    const Rows rows = isView ? own : transposed(own);
    const Vec3 last = isView ? scaled(own * to.eye, -1) : to.eye;
    Json matrix = Json::array();
    for (std::size_t i = 0; i < 3; ++i)
      matrix.push_back({rows[i].x + 0.0, rows[i].y + 0.0, rows[i].z + 0.0, last[i] + 0.0});
    if (has("position")) sets.emplace_back("position", nullptr);
    sets.emplace_back(path, std::move(matrix));
    return;
  }
  const Json* const position = valueAt(root, "position");
  if (isMoved && position->is_object()) {
    const Geodetic was = ecefToGeodetic(from.eye), place = ecefToGeodetic(to.eye);
    const Vec3 way = sum(to.eye, -1, from.eye), up = ellipsoidNormal(was);
    const bool isUpright = length(sum(way, -dot(way, up), up)) < 1e-6 * length(way);
    if (!isUpright) {
      sets.emplace_back("position.lat", place.lat);
      sets.emplace_back("position.lon", place.lon);
    }
    sets.emplace_back("position.height", place.height);
  } else if (isMoved) {
    sets.emplace_back("position", listOf(to.eye));
  }
  if (has("heading") || has("pitch") || has("roll")) {
    const Geodetic place = ecefToGeodetic(to.eye);
    const Vec3 up = ellipsoidNormal(place), east = scaled({-up.y, up.x, 0}, 1 / std::hypot(up.x, up.y));
    const Vec3 north = detail::crossOf(up, east), f = to.axes[2];
    const double h = std::atan2(dot(f, east), dot(f, north)),
                 p = std::atan2(dot(f, up), std::hypot(dot(f, east), dot(f, north)));
    const Vec3 right = sum(scaled(east, std::cos(h)), -std::sin(h), north), down = detail::crossOf(f, right);
    const double r = std::atan2(dot(to.axes[0], down), dot(to.axes[0], right));
    for (const auto& [name, radians] : {std::pair("heading", h), {"pitch", p}, {"roll", r}}) {
      const Json* const old = valueAt(root, name);
      const double degrees = radians * 180 / std::numbers::pi,
                   was = old ? degreesOf(readAngle({file.document, *old, name})) : 0;
      const double turned = was + std::remainder(degrees - was, 360);
      if (std::fabs(turned - was) > 1e-10) sets.emplace_back(name, turned);
    }
  } else if (has("target") || has("direction")) {
    sets.emplace_back("direction", listOf(to.axes[2]));
    if (isTurned) sets.emplace_back("up", listOf(scaled(to.axes[1], -1)));
  } else if (isTurned) {
    sets.emplace_back("rotation", quaternionOf(transposed(own)));
  }
}

std::vector<Set> setsOf(const CameraFile& file, const Rows& ownAxes, const PlainCamera& from, const PlainCamera& to) {
  std::vector<Set> sets;
  setLens(file, from, to, sets);
  if (to.lens && (!from.lens || from.lens->k != to.lens->k || from.lens->p != to.lens->p)) {
    std::vector<double> k(to.lens->k.begin(), to.lens->k.end());
    while (k.size() > 1 && k.back() == 0) k.pop_back();
    if (k.size() > 3) k.resize(6);
    Json made{{"model", "brown"}, {"k", k}};
    if (to.lens->p != std::array<double, 2>{}) made["p"] = to.lens->p;
    sets.emplace_back("distortion", made);
  }
  setPose(file, ownAxes, from, to, sets);
  return sets;
}

double rmsOf(const PlainCamera& camera, const Hypothesis& h, std::span<const Pair> pairs,
             const std::vector<std::size_t>& wrong) {
  double squares = 0, count = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (std::find(wrong.begin(), wrong.end(), i) != wrong.end()) continue;
    const Vec2 at = pixelOf(camera, h.point(pairs[i].point)), given = h.pixels(pairs[i].pixel);
    squares += (at.x - given.x) * (at.x - given.x) + (at.y - given.y) * (at.y - given.y);
    count += 2;
  }
  return std::isfinite(squares) ? std::sqrt(squares / std::max(count, 1.0)) : HUGE_VAL;
}

}  // namespace

std::string_view meaningOf(std::string_view mistake) {
  for (const Meaning& each : kMeanings)
    if (each.mistake == mistake) return each.words;
  return {};
}

std::vector<std::string_view> allMistakes() {
  std::vector<std::string_view> all;
  for (const Meaning& each : kMeanings) all.push_back(each.mistake);
  return all;
}

std::string sentenceOf(const Explanation& e, double within) {
  const std::string words = sentence(e.hypothesis.mistake, e.hypothesis.value);
  if (e.largest <= within) return words;
  return words + ", which leaves " + formatDigits(std::numbers::sqrt2 * e.rms, 2) + " px";
}

Mend mendOf(const CameraFile& file, const Explanation& e, std::span<const Pair> pairs) {
  const Hypothesis& h = e.hypothesis;
  Mend mend{{}, "", pairsOf(h)};
  if (!h.isSolved) {
    mend.sets = h.sets;
    mend.options = optionsOf(h.sets, h.stretch);
    return mend;
  }
  const CameraFile base = h.sets.empty() ? file : changed(file, h.sets, h.stretch);
  const Trials t(base.document, base.reading);
  const std::vector<Set> exact = setsOf(base, t.ownAxes(), t.plain(), h.camera);
  const auto rmsAt = [&](const std::vector<Set>& sets) {
    try {
      return rmsOf(plainOf(makeCamera(changed(file, sets, h.stretch))), h, pairs, e.wrong);
    } catch (const CameraError&) {
    } catch (const InputError&) {  // of so few digits there is no such camera
    } catch (const UsageError&) {
    }
    return HUGE_VAL;
  };
  for (int digits = 3; digits <= 17; ++digits) {
    std::vector<Set> sets = h.sets;
    for (const auto& [path, value] : exact) sets.emplace_back(path, rounded(value, digits));
    const double rms = rmsAt(sets);
    if (!(rms <= (digits < 17 ? std::max(1.01 * e.rms, e.rms + 1e-4) : 1.01 * e.rms + 1e-3))) continue;
    mend.options = optionsOf(sets, h.stretch);
    mend.sets = std::move(sets);
    break;
  }
  return mend;
}

}  // namespace viewproj::cmd::mistakes
