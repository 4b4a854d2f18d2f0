#include "commands/check/words.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "text/number.hpp"

namespace viewproj::cmd::mistakes {
namespace {

constexpr std::string_view kUpright[] = {"heading", "pitch", "height"};  // of mistakes: about up, or along it
constexpr double kSmall = 1e-9;                                          // of numbers beside larger ones
constexpr std::size_t kLongKnown = 19;
constexpr Mistake kMistakes[] = {
    {"y-flipped", "y is counted from the other edge of the picture"},
    {"y-flipped-index", "y is counted from the other edge, one pixel off"},
    {"x-mirrored", "mirrored: one side is left-, the other right-handed"},
    {"pixel-centre", "pixel centres are at whole numbers or at .5"},
    {"pixel-ratio", "the pixels are {} times these: device or CSS pixels"},
    {"viewport-offset", "a viewport's or crop's corner is left out or added"},
    {"picture-size", "fx, fy, cx, cy are of a picture of another size: {}"},
    {"fov-axis", "the angle of view is that of another axis"},
    {"aspect", "the aspect is left out, inverted or stale: {}"},
    {"radians", "radians are taken for degrees, or the reverse"},
    {"direction-as-target", "a direction is taken for a target, or the reverse"},
    {"up-axis", "one side has y up and one z up, or is upside down"},
    {"pose-inverted", "the pose is inverted (world-to-camera or the reverse)"},
    {"quaternion-order", "w is first in one quaternion and last in the other"},
    {"camera-axes", "the camera has other axes: {}"},
    {"distortion-ignored", "the pixels are without the distortion of the lens"},
    {"distortion-twice", "the distortion of the lens is taken twice"},
    {"normalized", "the pixels are 0..1 across the picture"},
    {"ndc", "the pixels are normalized device coordinates, -1..1"},
    {"image-coordinates", "the pixels are (x - cx) / fx, (y - cy) / fy"},
    {"picture-turned", "the picture is turned by {} degrees"},
    {"row-column", "row and column are exchanged"},
    {"ndc-twice", "half the picture is added to NDC already scaled"},
    {"half-angle", "half the angle of view for the whole, or the reverse"},
    {"sensor", "the sensor has another size"},
    {"fx-fy-exchanged", "fx and fy are exchanged"},
    {"intrinsics-order", "fx, fy, cx, cy are in another order"},
    {"principal-point", "the principal point is elsewhere, as in a crop: {}"},
    {"intrinsics-normalized", "fx, fy, cx, cy are parts of the picture's size"},
    {"size-exchanged", "width and height are exchanged"},
    {"translation-as-position", "translation is taken for position, or the reverse"},
    {"position-sign", "the position has the other sign"},
    {"translation-left-out", "the translation is left out"},
    {"pose-left-out", "the rotation, or the whole pose, is left out"},
    {"pose-twice", "the pose is applied twice"},
    {"rotation-vector", "a rotation vector is taken for three angles"},
    {"eye-target-exchanged", "eye and target are exchanged"},
    {"unit", "one side has another unit: {0} times {1}"},
    {"point-axes", "the points have other axes: {}"},
    {"euler-order", "the angles are in another order: {}"},
    {"euler-sign", "an angle has the other sign: {}"},
    {"heading-convention", "heading is counted the other way, or from elsewhere"},
    {"pitch-convention", "pitch is counted the other way, or from elsewhere"},
    {"roll-convention", "roll is counted the other way, or from elsewhere"},
    {"place", "lat and lon are exchanged, or one has the other sign"},
    {"lens-order", "the lens's coefficients are in another order"},
    {"lens-sign", "the lens's coefficients have the other sign"},
    {"lens-model", "the lens's numbers are read as another model's"},
    {"fisheye-for-brown", "a fisheye's k are read as Brown's, or the reverse"},
    {"focal-length", "the focal length is {} times this one's"},
    {"focal-lengths", "the focal lengths are {0} times these across, {1} down"},
    {"resized", "the picture is {0} times this one across, {1} down"},
    {"scale-and-offset", "{0} times this picture, then moved by {1p}, {2p}"},
    {"scales-and-offset", "{0} and {1} times this picture, then moved by {2p}, {3p}"},
    {"heading", "the camera is turned by {} degrees about up"},
    {"pitch", "the camera is tilted by {} degrees"},
    {"roll", "the camera is rolled by {} degrees"},
    {"rotation", "the camera is turned by {} degrees"},
    {"pan-tilt-zoom", "the camera is turned by {0} degrees and zooms {1} times"},
    {"height", "the eye is higher by {}"},
    {"eye", "the eye is moved by {}"},
    {"lens", "the pixels have a lens: k and p {}"},
    {"pose", "the camera is turned by {0} degrees, moved by {1}, {2}, {3}"},
    {"pose-and-focal-length", "pose and focal length: {0} degrees, moved by {1}, {2}, {3}"},
    {"another-camera", "another camera: {0} degrees, moved by {1}, {2}, {3}"},
    {"camera-of-file", "the pixels are of another camera of the file: {}"},
    {"pixel-order", "the pixels are in another order"}};

struct Saying {
  std::string_view name, key, meaning;
};
/// In place of the meaning, where the value says more.
constexpr Saying kSayings[] = {
    {"x-mirrored", "pixels", "mirrored: one side is left-handed, or OpenGL's axes are used as OpenCV's"},
    {"radians", "radians", "the camera's angles are in radians, not in degrees"},
    {"radians", "degrees", "the camera's angles are in degrees, not in radians"},
    {"radians", "pixels", "the pixels are made with degrees taken for radians"},
    {"half-angle", "half", "the angle of view is half of the whole"},
    {"half-angle", "twice", "the angle of view is twice the right one"},
    {"direction-as-target", "direction", "the target is a direction"},
    {"direction-as-target", "target", "the direction is a target"},
    {"up-axis", "up y", "the world's up is y"},
    {"up-axis", "up z", "the world's up is z"},
    {"up-axis", "z for y", "the points have z up, the camera y"},
    {"up-axis", "y for z", "the points have y up, the camera z"},
    {"up-axis", "down", "the camera is upside down"},
    {"up-axis", "exchanged", "y and z of the points are exchanged"},
    {"pose-inverted", "cameraFromWorld", "the pose is inverted: its numbers are of world-to-camera"},
    {"pose-inverted", "worldFromCamera", "the pose is inverted: its numbers are of camera-to-world"},
    {"pose-inverted", "rotation", "the rotation alone is transposed (rows for columns)"},
    {"translation-as-position", "position", "the camera's translation is a position"},
    {"translation-as-position", "translation", "the camera's position is a translation"},
    {"unit", "points", "the points' unit is {1} times the camera's"},
    {"unit", "position", "the camera's unit is {1} times the points'"},
    {"fisheye-for-brown", "fisheye", "the lens is a fisheye's, not Brown's"},
    {"fisheye-for-brown", "equidistant", "the pixels are of an equidistant fisheye"},
    {"fisheye-for-brown", "brown", "the lens is Brown's, not a fisheye's"},
    {"principal-point", "moved", "the pixels lie {0}, {1} off: a crop, a title bar, or another principal point"},
    {"scale-and-offset", "bars", "a letterbox: {0} times this picture, then moved by {1p}, {2p}"},
    {"scale-and-offset", "crop", "a crop or region of interest: {0} times this picture, then moved by {1p}, {2p}"},
    {"height", "lower", "the eye is lower by {-}"},
    {"pixel-order", "reversed", "the pixels are in reverse order: the first is the last"}};

/// Which of the sayings is of a value.
std::string keyOf(std::string_view mistake, const Json& value) {
  const Json& first = value.is_array() ? value[0] : value;
  if (first.is_string()) return first;
  if (mistake == "height" && value < 0) return "lower";
  if (mistake == "principal-point") return "moved";
  if (mistake != "scale-and-offset") return "";
  const auto [least, most] = std::minmax({value[1].get<double>(), value[2].get<double>()});
  return least > -1 ? "bars" : most < 1 ? "crop" : "";
}

std::string_view meaningOf(std::string_view mistake, const Json& value) {
  const std::string key = keyOf(mistake, value);
  for (const Saying& saying : kSayings)
    if (saying.name == mistake && saying.key == key) return saying.meaning;
  return kMistakes[placeOf(mistake)].meaning;
}

double largestOf(const Json& value) {
  if (value.is_number()) return std::fabs(value.get<double>());
  double largest = 0;
  if (value.is_array())
    for (const Json& part : value) largest = std::max(largest, largestOf(part));
  return largest;
}

/// Of numbers beside larger ones, rounding is not shown.
std::string shown(const Json& value, double largest) {
  if (value.is_number()) return largestOf(value) < kSmall * largest ? "0" : formatDigits(value, 4);
  if (!value.is_array()) return value.is_string() ? value.get<std::string>() : "another";
  std::string text;
  for (const Json& part : value) text += (text.empty() ? "" : ", ") + shown(part, largest);
  return text;
}

/// least: pixels that say something.
std::string sentence(std::string_view mistake, const Json& value, bool isOnEarth, double least) {
  if (const std::size_t plus = mistake.find(" + "); plus != mistake.npos)
    return sentence(mistake.substr(0, plus), value[0], isOnEarth, least) + "; " +
           sentence(mistake.substr(plus + 3), value[1], isOnEarth, least);
  std::string text(meaningOf(mistake, value));
  for (std::size_t open = text.find('{'); open != text.npos; open = text.find('{')) {
    const std::string which = text.substr(open + 1, text.find('}') - open - 1);
    Json part = which.empty() || which == "-" ? value : value[static_cast<std::size_t>(which[0] - '0')];
    if (which == "-") part = -part.get<double>();
    if (which.ends_with('p') && largestOf(part) < least) part = 0;
    text.replace(open, which.size() + 2, shown(part, largestOf(value)));
  }
  constexpr std::string_view kShifts[] = {"eye", "pose", "pose-and-focal-length", "another-camera"};
  const bool isShift = std::find(std::begin(kShifts), std::end(kShifts), mistake) != std::end(kShifts);
  return text + (!isOnEarth ? "" : isShift ? " m (east, north, up)" : mistake == "height" ? " m" : "");
}

/// ": heading 72.4 for 69.2", where up is known and the camera is turned.
std::string turnsOf(const CameraFile& file, const PlainCamera& to) {
  if (!knowsUp(file)) return "";
  const auto degreesOf = [&](const PlainPose& pose) {
    const auto [heading, pitch, roll] = headingPitchRollOf(pose, file.worldIsEcef);
    return std::array{heading.value < 0 ? heading.value + 360 : heading.value, pitch.value, roll.value};
  };
  const PlainPose own = plainPose(*file.pose);
  // On the Earth the angles of an eye that is moved alone change with its place.
  if (apart(own.forward, to.axes[2]) + apart(own.right, to.axes[0]) < kSmall) return "";
  const auto was = degreesOf(own), is = degreesOf(poseOf(to));
  std::string text;
  for (std::size_t i = 0; i < 3; ++i)
    if (std::fabs(std::remainder(is[i] - was[i], 360)) > kSmall * 360)
      text += (text.empty() ? ": " : ", ") + std::string(std::array{"heading ", "pitch ", "roll "}[i]) +
              shown(is[i], 360) + " for " + shown(was[i], 360);
  return text;
}

/// Of words that mean an up which no field says, where worlds differ: the preset's is that of its cameras.
std::string upOf(const CameraFile& file, std::string_view mistake) {
  const bool isSaid = knowsUp(file) || valueAt(*file.document.root, "up") || file.preset->up.y >= 0;
  const bool needsUp = std::any_of(std::begin(kUpright), std::end(kUpright),
                                   [&](std::string_view name) { return mistake.find(name) != mistake.npos; });
  return isSaid || !needsUp ? "" : ", if up is -y";
}

using Term = std::pair<double, const char*>;

/// "0.5x + 3", "720 - y"
std::string formula(std::initializer_list<Term> terms) {
  std::string text;
  for (const double sign : {1.0, -1.0})
    for (const auto& [factor, name] : terms) {
      const double size = sign * factor;
      if (!(size > 0)) continue;
      text += text.empty() ? (sign < 0 ? "-" : "") : sign < 0 ? " - " : " + ";
      const bool isPart = *name != 0 && size < 1;
      const std::string digits = size == 1 && *name != 0 ? "" : formatDigits(isPart ? 1 / size : size, 12);
      text += isPart ? name + ("/" + digits) : digits + name;
    }
  return text;
}

}  // namespace

std::span<const Mistake> allMistakes() { return kMistakes; }

std::size_t placeOf(std::string_view mistake) {
  if (const std::size_t plus = mistake.find(" + "); plus != mistake.npos)
    return placeOf(mistake.substr(0, plus)) + placeOf(mistake.substr(plus + 3));
  std::size_t place = 0;
  while (kMistakes[place].name != mistake) ++place;
  return place;
}

bool isLongKnown(std::string_view mistake) {
  return std::any_of(kMistakes, kMistakes + kLongKnown, [&](const Mistake& each) { return each.name == mistake; });
}

std::string shownLines(std::span<const std::size_t> lines) {
  std::string text = lines.size() == 1 ? "line " : "lines ";
  for (std::size_t i = 0; i < lines.size(); ++i)
    text += (i == 0 ? "" : i + 1 == lines.size() ? " and " : ", ") + std::to_string(lines[i]);
  return text;
}

std::string sentenceOf(const CameraFile& file, const Explanation& e, double within) {
  constexpr double kLeast = 5e-3;  // pixels
  std::string words = sentence(e.hypothesis.mistake, e.hypothesis.value, file.worldIsEcef, std::max(kLeast, e.rms)) +
                      turnsOf(file, e.hypothesis.camera) + upOf(file, e.hypothesis.mistake);
  if (!e.wrong.empty()) words += ", but for " + shownLines(e.wrong);
  if (e.largest <= within) return words;
  return words + ", which leaves " + formatDigits(std::numbers::sqrt2 * e.rms, 2) + " px";
}

std::string wordsForPairs(const Hypothesis& h, const PixelMap& m) {
  std::string text;
  const auto add = [&](bool isNeeded, const std::string& words) {
    if (isNeeded) text += (text.empty() ? "" : ", and ") + words;
  };
  const bool isX = m.xx != 1 || m.xy != 0 || m.x0 != 0, isY = m.yx != 0 || m.yy != 1 || m.y0 != 0;
  const std::string x = "x by " + formula({{m.xx, "x"}, {m.xy, "y"}, {m.x0, ""}}),
                    y = "y by " + formula({{m.yx, "x"}, {m.yy, "y"}, {m.y0, ""}});
  add(isX || isY, "replace " + (isX && isY ? x + " and " + y : isX ? x : y) + " in the pixels");
  std::string axes;
  for (const Vec3& row : h.points)
    axes += (axes.empty() ? "" : ",") + formula({{row.x, "x"}, {row.y, "y"}, {row.z, "z"}});
  add(h.points != kUnit, "replace x,y,z of the points by " + axes);
  add(h.places == PlaceMap::exchange, "exchange lat and lon of the points");
  add(h.places == PlaceMap::negateLon, "replace lon of the points by -lon");
  add(h.places == PlaceMap::negateLat, "replace lat of the points by -lat");
  add(h.lensPasses < 0, "undistort the pixels once; the lens is in them twice");
  add(!h.words.empty(), h.words);
  add(h.lensPasses > 0,
      "do not undistort the pixels; they are undistorted twice, or the coefficients are of the inverse model");
  return text;
}

}  // namespace viewproj::cmd::mistakes
