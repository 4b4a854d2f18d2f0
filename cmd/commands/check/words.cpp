#include "commands/check/words.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "text/number.hpp"

namespace viewproj::cmd::mistakes {
namespace {

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
    {"aspect", "the aspect is left out, or inverted"},
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
    {"eye-target-exchanged", "eye and target are exchanged"},
    {"unit", "one side has another unit: {0} times {1}"},
    {"point-axes", "the points have other axes: {}"},
    {"euler-order", "the angles go with another order of turns: {}"},
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
    {"scale-and-offset", "a letterbox: {0} times this picture, moved by {1}, {2}"},
    {"scales-and-offset", "{0} and {1} times this picture, moved by {2}, {3}"},
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
    {"pixel-order", "the pixels are in another order"}};

/// One of them, or of a list the numbers; of rounding beside larger ones nothing is left.
std::string shown(const Json& value, double largest = 0) {
  if (value.is_number()) return std::fabs(value.get<double>()) < 1e-9 * largest ? "0" : formatDigits(value, 4);
  if (!value.is_array()) return value.is_string() ? value.get<std::string>() : "another";
  for (const Json& part : value)
    if (part.is_number()) largest = std::max(largest, std::fabs(part.get<double>()));
  std::string text;
  for (const Json& part : value) text += (text.empty() ? "" : ", ") + shown(part, largest);
  return text;
}

std::string sentence(std::string_view mistake, const Json& value) {
  if (const std::size_t plus = mistake.find(" + "); plus != mistake.npos)
    return sentence(mistake.substr(0, plus), value[0]) + "; " + sentence(mistake.substr(plus + 3), value[1]);
  std::string text;
  for (std::string_view rest = kMistakes[placeOf(mistake)].meaning; !rest.empty();) {
    const std::size_t open = std::min(rest.find('{'), rest.size()), close = std::min(rest.find('}'), rest.size());
    text += rest.substr(0, open);
    if (open < rest.size())
      text += shown(close == open + 1 ? value : value[static_cast<std::size_t>(rest[open + 1] - '0')]);
    rest.remove_prefix(std::min(close + 1, rest.size()));
  }
  return text;
}

/// ": heading 72.4 for 69.2", where up is known and the camera is turned.
std::string turnsOf(const CameraFile& file, const PlainCamera& to) {
  if (!knowsUp(file)) return "";
  const auto degreesOf = [&](const PlainPose& pose) {
    const auto [heading, pitch, roll] = headingPitchRollOf(pose, file.worldIsEcef);
    return std::array{heading.value < 0 ? heading.value + 360 : heading.value, pitch.value, roll.value};
  };
  const auto was = degreesOf(plainPose(*file.pose)), is = degreesOf(poseOf(to));
  std::string text;
  for (std::size_t i = 0; i < 3; ++i)
    if (const std::string now = formatDigits(is[i], 4), before = formatDigits(was[i], 4); now != before)
      text += (text.empty() ? ": " : ", ") + std::string(std::array{"heading ", "pitch ", "roll "}[i]) + now + " for " +
              before;
  return text;
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
  const bool isLast = x >= 0 && y >= 0;
  if (!isLast && offset != 0) add(offset, formatDigits(std::fabs(offset), 12));
  if (x != 0) add(x, term(x, "x"));
  if (y != 0) add(y, term(y, "y"));
  if (isLast && offset != 0) add(offset, formatDigits(std::fabs(offset), 12));
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
  std::string words = sentence(e.hypothesis.mistake, e.hypothesis.value) + turnsOf(file, e.hypothesis.camera);
  if (!e.wrong.empty()) words += ", but for " + shownLines(e.wrong);
  if (e.largest <= within) return words;
  return words + ", which leaves " + formatDigits(std::numbers::sqrt2 * e.rms, 2) + " px";
}

std::string wordsForPairs(const Hypothesis& h, const PixelMap& m) {
  static constexpr std::array kNames{"x", "y", "z"};
  std::vector<std::string> words;
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
          axes += (axes.empty() ? "" : ",") + std::string(row[i] < 0 ? "-" : "") + term(row[i], kNames[i]);
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

}  // namespace viewproj::cmd::mistakes
