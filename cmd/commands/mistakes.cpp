#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <numbers>

#include "camera/patch.hpp"
#include "commands/pair_check.hpp"
#include "text/error.hpp"
#include "text/number.hpp"
#include "viewproj/lens.hpp"
#include "viewproj/screen.hpp"

namespace viewproj::cmd {
namespace {

/// As --set reads it: "60", "60deg", "1,2,3", or JSON.
std::string textOf(const Json& value) {
  if (value.is_number()) return formatNumber(value.get<double>());
  const bool isList =
      value.is_array() && std::all_of(value.begin(), value.end(), [](const Json& part) { return part.is_number(); });
  if (!isList) return value.is_string() ? value.get<std::string>() : value.dump();
  std::string text;
  for (const Json& part : value) text += (text.empty() ? "" : ",") + textOf(part);
  return text;
}

/// "0.5x + 3", "x/3", "720 - y".
std::string formulaOf(char name, const Affine& map) {
  const double size = std::fabs(map.scale);
  const std::string times = size == 1  ? std::string(1, name)
                            : size < 1 ? std::string(1, name) + "/" + formatDigits(1 / size, 12)
                                       : formatDigits(size, 12) + name;
  const std::string offset = formatDigits(std::fabs(map.offset), 12);
  if (map.scale < 0) return (map.offset < 0 ? "-" : "") + offset + " - " + times;
  return map.offset == 0 ? times : times + (map.offset < 0 ? " - " : " + ") + offset;
}

std::string inShell(const std::string& word) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.,:/=+";
  return word.find_first_not_of(kPlain) == std::string::npos ? word : "'" + word + "'";
}

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

/// The document and its camera, and the hypotheses found so far.
struct Trials {
  const Document& document;
  const ReadOptions& reading;
  Camera camera;
  std::vector<Hypothesis> found = {};
  std::string_view mistake = {};

  const Json* find(std::string_view path) const { return valueAt(*document.root, path); }
  double numberOr(std::string_view path, double fallback) const {
    const Json* const value = find(path);
    return value && value->is_number() ? value->get<double>() : fallback;
  }
  double pixelCenter() const { return camera.viewport().pixelCenter; }
  Vec2 first() const { return pictureCorners(camera.viewport()).first; }
  Vec2 last() const { return pictureCorners(camera.viewport()).last; }

  Hypothesis next(std::string mend, Json value) const {
    return {mistake, std::make_shared<const Json>(std::move(value)), std::move(mend), camera};
  }

  /// Other values of fields, null to remove one, as --set gives them. What cannot be read then is no hypothesis.
  void change(const std::vector<std::pair<std::string, Json>>& fields, Json value = nullptr, bool stretch = false) {
    try {
      std::string mend;
      std::vector<Patch> patches;
      for (const auto& [path, changed] : fields) {
        const std::string text = path + "=" + textOf(changed);
        mend += (mend.empty() ? "--set " : " --set ") + inShell(text);
        patches.push_back(setPatch(text));
      }
      ReadOptions how = reading;
      if (stretch) how.allowStretch = true;
      Document changed{document.name, std::make_shared<Json>(*document.root), document.isTyped, document.labels};
      applyPatches(changed, patches);
      Hypothesis hypothesis = next(mend + (stretch ? " --allow-stretch" : ""), std::move(value));
      hypothesis.camera = makeCamera(readCamera(changed, how));
      hypothesis.hasCamera = true;
      found.push_back(std::move(hypothesis));
    } catch (const CameraError&) {
    } catch (const InputError&) {
    } catch (const UsageError&) {
    }
  }

  void pixels(const Affine& x, const Affine& y, Json value = nullptr) {
    std::string mend;
    for (const auto& [name, map] : {std::pair('x', x), {'y', y}})
      if (map.scale != 1 || map.offset != 0)
        mend += (mend.empty() ? "replace " : " and ") + std::string(1, name) + " by " + formulaOf(name, map);
    Hypothesis hypothesis = next(mend + " in the pixels", std::move(value));
    hypothesis.x = x;
    hypothesis.y = y;
    found.push_back(std::move(hypothesis));
  }

  void points(const std::array<int, 3>& axes) {
    std::string mend;
    for (const int axis : axes)
      mend += (mend.empty() ? "" : ",") + std::string(axis < 0 ? "-" : "") + "xyz"[std::abs(axis) - 1];
    Hypothesis hypothesis = next("replace x,y,z of the points by " + mend, nullptr);
    hypothesis.axes = axes;
    found.push_back(std::move(hypothesis));
  }
};

void flipY(Trials& t) {
  const bool isTop = t.camera.viewport().origin == Origin::topLeft;
  std::vector<std::pair<std::string, Json>> fields{{"viewport.origin", isTop ? "bottom-left" : "top-left"}};
  // What counts in pixels of the picture is counted from the other edge as well.
  const double height = t.numberOr("viewport.height", t.camera.viewport().height), c = t.pixelCenter();
  if (t.find("projection.cy")) {
    const double of = t.numberOr("projection.pixels.1", height);
    fields.emplace_back("projection.cy",
                        2 * (t.numberOr("viewport.y", 0) * of / height + c) - 1 + of - t.numberOr("projection.cy", 0));
  }
  if (t.find("viewport.crop"))
    fields.emplace_back("viewport.crop.y",
                        height - t.numberOr("viewport.crop.y", 0) - t.numberOr("viewport.crop.height", 0));
  t.change(fields);
  t.pixels({}, {-1, t.first().y + t.last().y});
}

void flipIndex(Trials& t) {
  for (const double one : {-1.0, 1.0}) t.pixels({}, {-1, t.first().y + t.last().y + one});
}

void mirrorX(Trials& t) {
  const bool isRight = t.camera.convention().world == Handedness::right;
  t.change({{"convention.world", isRight ? "left" : "right"}});
  t.pixels({-1, t.first().x + t.last().x}, {});
  if (const double axis = 2 * t.camera.intrinsics().cx; axis != t.first().x + t.last().x) t.pixels({-1, axis}, {});
  for (const auto& axes : {std::array{-1, 2, 3}, {1, -2, 3}, {1, 2, -3}}) t.points(axes);
}

void movePixelCentre(Trials& t) {
  t.change({{"viewport.pixelCenter", t.pixelCenter() == 0 ? 0.5 : 0}});
  for (const double half : {-0.5, 0.5}) t.pixels({1, half}, {1, half});
}

void scalePixels(Trials& t) {
  const auto about = [](double corner, double ratio) { return Affine{1 / ratio, corner - corner / ratio}; };
  for (const double ratio : {1.25, 1.5, 2.0, 3.0, 1 / 1.25, 1 / 1.5, 0.5, 1 / 3.0}) {
    t.pixels(about(0, ratio), about(0, ratio), ratio);
    if (t.pixelCenter() != 0.5) t.pixels(about(t.first().x, ratio), about(t.first().y, ratio), ratio);
  }
}

void moveOffset(Trials& t) {
  if (t.find("viewport.crop")) t.change({{"viewport.crop", nullptr}});
  for (const char* const corner : {"viewport.", "viewport.crop."}) {
    const double x = t.numberOr(corner + std::string("x"), 0), y = t.numberOr(corner + std::string("y"), 0);
    if (x == 0 && y == 0) continue;
    for (const double sign : {1.0, -1.0}) t.pixels({1, sign * x}, {1, sign * y});
  }
}

void resizePicture(Trials& t) {
  const double center = t.pixelCenter() - 0.5;
  const double width = std::round(2 * (t.numberOr("projection.cx", 0) - center));
  const double height = std::round(2 * (t.numberOr("projection.cy", 0) - center));
  const Json size = Json::parse("[" + formatNumber(width) + "," + formatNumber(height) + "]");  // whole numbers stay so
  if (t.find("projection.cx") &&
      (width != t.numberOr("viewport.width", 0) || height != t.numberOr("viewport.height", 0)))
    t.change({{"projection.pixels", size}}, size);
}

constexpr const char* kAngles[] = {"projection.fovY", "projection.fovX", "projection.fovDiagonal"};

void turnFov(Trials& t) {
  for (const char* const path : kAngles)
    if (const Json* const angle = t.find(path))
      for (const char* const other : kAngles)
        if (path != other) t.change({{other, *angle}});
}

void changeAspect(Trials& t) {
  if (t.find("projection.aspect")) t.change({{"projection.aspect", nullptr}});
  const double whole = t.numberOr("viewport.width", 1) / t.numberOr("viewport.height", 1);
  for (const double aspect : {1.0, 1 / t.numberOr("projection.aspect", whole)})
    t.change({{"projection.aspect", aspect}}, nullptr, true);
}

/// "60" and "60deg" in radians, "1.05rad" in degrees.
std::string inOtherUnit(const Json& angle) {
  std::string text = textOf(angle);
  for (const std::string_view unit : {"rad", "deg", "\xC2\xB0"})
    if (text.ends_with(unit)) return text.substr(0, text.size() - unit.size()) + (unit == "rad" ? "deg" : "rad");
  return text + "rad";
}

void takeRadians(Trials& t) {
  for (const char* const path : kAngles) {
    const Json* const angle = t.find(path);
    if (!angle) continue;
    t.change({{path, inOtherUnit(*angle)}});
    // Who made the pixels has used as many radians as there are degrees.
    if (!angle->is_number()) continue;
    const double degrees = angle->get<double>();
    const double ratio = std::tan(degrees / 2) / std::tan(degrees * std::numbers::pi / 360);
    const auto [fx, fy, cx, cy] = t.camera.intrinsics();
    t.pixels({ratio, cx - ratio * cx}, {ratio, cy - ratio * cy});
  }
  std::vector<std::pair<std::string, Json>> turns;
  for (const char* const name : {"heading", "pitch", "roll"})
    if (const Json* const angle = t.find(name)) turns.emplace_back(name, inOtherUnit(*angle));
  if (!turns.empty()) t.change(turns);
  if (const Json* const euler = t.find("euler.degrees")) {
    Json angles = Json::array();
    for (const Json& angle : *euler) angles.push_back(inOtherUnit(angle));
    t.change({{"euler.degrees", angles}});
  }
}

void exchangeTarget(Trials& t) {
  for (const auto& [path, other] : {std::pair("target", "direction"), {"direction", "target"}})
    if (const Json* const value = t.find(path); value && value->is_array()) t.change({{other, *value}});
}

void turnUp(Trials& t) {
  for (const auto& axes : {std::array{1, 3, -2}, {1, -3, 2}, {1, 3, 2}}) t.points(axes);
  if (!t.find("target") && !t.find("direction")) return;
  for (const Json& up : {Json{0, 1, 0}, Json{0, 0, 1}})
    if (const Json* const own = t.find("up"); !own || *own != up) t.change({{"up", up}});
}

/// A quaternion, a rotation vector, or a matrix by rows, of the inverse rotation.
Json inverseOf(const Json& rotation) {
  Json inverse = rotation;
  if (rotation[0].is_number())
    for (std::size_t i = 0; i < 3; ++i) inverse[i] = 0.0 - rotation[i].get<double>();
  else
    for (std::size_t i = 0; i < 9; ++i) inverse[i / 3][i % 3] = rotation[i % 3][i / 3];
  return inverse;
}

void invertPose(Trials& t) {
  for (const auto& [path, other] :
       {std::pair("worldFromCamera", "cameraFromWorld"), {"cameraFromWorld", "worldFromCamera"}}) {
    const Json* const pose = t.find(path);
    if (!pose) continue;
    t.change({{path, nullptr}, {other, *pose}});
    for (const char* const name : {".rotation", ".rotationVector"})
      if (const Json* const turn = t.find(std::string(path) + name); turn && (turn->size() == 4 || turn->size() == 3))
        t.change({{std::string(path) + name, inverseOf(*turn)}});
  }
  const Json *const rotation = t.find("rotation"), *const position = t.find("position");
  if (!rotation || !position || !position->is_array()) return;
  t.change({{"rotation", inverseOf(*rotation)}});
  const Json rigid{{"rotation", *rotation}, {"translation", *position}};
  t.change({{"position", nullptr}, {"rotation", nullptr}, {"cameraFromWorld", rigid}});
}

void reorderQuaternion(Trials& t) {
  for (const char* const path : {"rotation", "worldFromCamera.rotation", "cameraFromWorld.rotation"})
    if (const Json* const q = t.find(path); q && q->size() == 4)
      for (const auto& order : {std::array{1, 2, 3, 0}, {3, 0, 1, 2}}) {
        Json turned = Json::array();
        for (const int i : order) turned.push_back((*q)[static_cast<std::size_t>(i)]);
        t.change({{path, turned}});
      }
}

void turnAxes(Trials& t) {
  const Json* const own = t.find("cameraAxes");
  for (const auto& [name, axes] : kCameraAxesNames)
    if (!own || *own != name) t.change({{"cameraAxes", name}}, name);
}

/// From low to high across the picture, y from its top or from its bottom.
void fromUnits(Trials& t, double low) {
  const Vec2 first = t.first(), last = t.last();
  const auto across = [low](double from, double to) {
    const double scale = (to - from) / (1 - low);
    return Affine{scale, from - scale * low};
  };
  t.pixels(across(first.x, last.x), across(first.y, last.y));
  t.pixels(across(first.x, last.x), across(last.y, first.y));
}

void leaveDistortionOut(Trials& t) {
  if (lensOf(t.camera)) t.change({{"distortion", nullptr}});
}

void distortTwice(Trials& t) {
  if (!lensOf(t.camera)) return;
  for (const auto& [distortions, mend] : {std::pair(-1, "undistort the pixels once; the lens is in them twice"),
                                          {2, "do not undistort the pixels; they are undistorted twice"}}) {
    t.found.push_back(t.next(mend, nullptr));
    t.found.back().distortions = distortions;
  }
}

std::vector<double> numbersAt(const Trials& t, std::string_view path) {
  const Json* const at = t.find(path);
  return at && at->is_array() ? at->get<std::vector<double>>() : std::vector<double>{};
}

/// OpenCV's vector of four: k1 k2 k3 k4 of a fisheye, k1 k2 p1 p2 of Brown.
void takeFisheyeForBrown(Trials& t) {
  const Json* const model = t.find("distortion.model");
  if (!model || (*model != "brown" && *model != "fisheye")) return;
  std::vector<double> k = numbersAt(t, "distortion.k"), p = numbersAt(t, "distortion.p");
  if (*model == "fisheye") {
    if (k.empty()) return t.change({{"distortion", nullptr}});
    k.resize(4);
    return t.change({{"distortion", {{"model", "brown"}, {"k", {k[0], k[1]}}, {"p", {k[2], k[3]}}}}});
  }
  if (k.size() > 3) return;
  if (!p.empty()) {
    k.resize(2);
    k.insert(k.end(), p.begin(), p.end());
  }
  t.change({{"distortion", {{"model", "fisheye"}, {"k", k}}}});
}

/// Models that share a number, or that a reader of fewer models takes for each other.
void takeAnotherModel(Trials& t) {
  const Json* const given = t.find("distortion");
  const Json* const model = t.find("distortion.model");
  if (!model) return;
  const auto change = [&](Json other) { t.change({{"distortion", std::move(other)}}); };
  const Json xi = given->value("xi", Json()), alpha = given->value("alpha", Json());
  if (*model == "unified") {
    change({{"model", "omni"}, {"xi", alpha}});
    if (given->contains("beta")) change({{"model", "unified"}, {"alpha", alpha}});
  } else if (*model == "double-sphere") {
    change({{"model", "double-sphere"}, {"xi", alpha}, {"alpha", xi}});
    change({{"model", "unified"}, {"alpha", alpha}});
  } else if (*model == "omni") {
    if (!given->contains("k") && !given->contains("p")) return change({{"model", "unified"}, {"alpha", xi}});
    Json brown = *given;
    brown.erase("xi");
    brown["model"] = "brown";
    change(brown);
  } else if (*model == "fov") {
    change({{"model", "fisheye"}});
  }
}

struct Mistake {
  std::string_view name, sentence;
  void (*addTo)(Trials&);
};
constexpr Mistake kMistakes[] = {
    {"y-flipped", "y is counted from the other edge of the picture", flipY},
    {"y-flipped-index", "y is counted from the other edge, and is one pixel off", flipIndex},
    {"x-mirrored", "mirrored: one side is left-handed and the other right-handed", mirrorX},
    {"pixel-centre", "one side has pixel centres at whole numbers, the other at .5", movePixelCentre},
    {"pixel-ratio", "one side counts device pixels, the other CSS (logical) pixels", scalePixels},
    {"viewport-offset", "the viewport's or the crop's corner is left out, or added twice", moveOffset},
    {"picture-size", "fx, fy, cx, cy are of a picture of another size", resizePicture},
    {"fov-axis", "the angle of view is that of another axis", turnFov},
    {"aspect", "the aspect is left out, or inverted", changeAspect},
    {"radians", "an angle in radians is taken for degrees, or the reverse", takeRadians},
    {"direction-as-target", "a direction is taken for a target, or the reverse", exchangeTarget},
    {"up-axis", "one side has y up and the other z up", turnUp},
    {"pose-inverted", "the pose is inverted: world-to-camera for camera-to-world", invertPose},
    {"quaternion-order", "the quaternion has w first on one side and last on the other", reorderQuaternion},
    {"camera-axes", "the pose counts on other axes of the camera", turnAxes},
    {"distortion-ignored", "the pixels are without the distortion of the lens", leaveDistortionOut},
    {"distortion-twice", "the distortion of the lens is taken twice", distortTwice},
    {"fisheye-for-brown", "a fisheye's coefficients are read as Brown's, or the reverse", takeFisheyeForBrown},
    {"lens-model", "the numbers of the lens are read as another model's", takeAnotherModel},
    {"normalized", "the pixels are 0..1 across the picture", [](Trials& t) { fromUnits(t, 0); }},
    {"ndc", "the pixels are normalized device coordinates, -1..1", [](Trials& t) { fromUnits(t, -1); }},
};

}  // namespace

Vec4 Hypothesis::point(const Vec4& p) const {
  const double of[] = {p.x, p.y, p.z};
  const auto at = [&](int axis) {
    const double along = of[std::abs(axis) - 1];
    return axis < 0 ? -along : along;
  };
  return {at(axes[0]), at(axes[1]), at(axes[2]), p.w};
}

Vec2 Hypothesis::pixel(const Vec2& given) const {
  Vec2 at{x(given.x), y(given.y)};
  const auto seenBy = [&](const Camera& from, const Camera& to) {
    const Vec3 d = screenToRay(from, at).direction;
    const ScreenPoint p = worldToScreen(to, Vec4{d.x, d.y, d.z, 0});
    at = {p.x, p.y};
  };
  for (int i = 0; i > distortions; --i) seenBy(camera, withoutLens(camera));
  for (int i = 0; i < distortions; ++i) seenBy(withoutLens(camera), camera);
  return at;
}

std::string_view sentenceOf(std::string_view mistake) {
  const auto row = std::find_if(std::begin(kMistakes), std::end(kMistakes),
                                [&](const Mistake& each) { return each.name == mistake; });
  return row->sentence;
}

std::vector<Hypothesis> hypotheses(const Document& document, const ReadOptions& reading) {
  const Document arrays{document.name, std::make_shared<Json>(*document.root), document.isTyped, document.labels};
  spreadVectors(*arrays.root);
  Trials trials{arrays, reading, makeCamera(readCamera(arrays, reading))};
  for (const Mistake& mistake : kMistakes) {
    trials.mistake = mistake.name;
    mistake.addTo(trials);
  }
  return std::move(trials.found);
}

}  // namespace viewproj::cmd
