// Mistakes of the viewport, the projection and the lens: fields that mend them.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "commands/check/hypothesis.hpp"

namespace viewproj::cmd::mistakes {
namespace {

constexpr const char* kAngles[] = {"projection.fovY", "projection.fovX", "projection.fovDiagonal"};

Vec2 pictureOf(const Trials& t) {
  return {t.numberOr("viewport.width", t.viewport().width), t.numberOr("viewport.height", t.viewport().height)};
}

/// The size of the picture that fx, fy, cx and cy are of.
Vec2 calibratedPictureOf(const Trials& t) {
  const Json* const pixels = t.find("projection.pixels");
  return pixels ? Vec2{(*pixels)[0], (*pixels)[1]} : pictureOf(t);
}

void changePicture(Trials& t) {
  const double centre = t.viewport().pixelCenter, height = pictureOf(t).y, of = calibratedPictureOf(t).y;
  std::vector<Set> flip{{"viewport.origin", t.viewport().origin == Origin::topLeft ? "bottom-left" : "top-left"}};
  // What counts in pixels of the picture is counted from the other edge as well.
  if (t.has("projection.cy"))
    flip.emplace_back("projection.cy", 2 * (t.numberOr("viewport.y", 0) * of / height + centre) - 1 + of -
                                           t.numberOr("projection.cy", 0));
  if (t.has("viewport.crop"))
    flip.emplace_back("viewport.crop.y",
                      height - t.numberOr("viewport.crop.y", 0) - t.numberOr("viewport.crop.height", 0));
  t.change("y-flipped", flip);
  t.change("pixel-centre", {{"viewport.pixelCenter", centre == 0 ? 0.5 : 0}});
  if (t.has("viewport.crop")) t.change("viewport-offset", {{"viewport.crop", nullptr}});
  for (const char* const corner : {"viewport.", "viewport.crop."}) {
    const double x = t.numberOr(corner + std::string("x"), 0), y = t.numberOr(corner + std::string("y"), 0);
    if (x == 0 && y == 0) continue;
    for (const double sign : {1.0, -1.0}) t.pixels("viewport-offset", {1, 0, sign * x, 0, 1, sign * y});
  }
}

/// fx, fy, cx and cy are of a picture of this size; cx and cy grow with it from its corner, or from 0.
void ofSize(Trials& t, double width, double height) {
  const Vec2 own = pictureOf(t);
  if (!(width > 0 && height > 0) || (width == own.x && height == own.y && !t.has("projection.pixels"))) return;
  const Json size{static_cast<std::int64_t>(width), static_cast<std::int64_t>(height)};
  const double half = t.viewport().pixelCenter - 0.5;
  t.change("picture-size", {{"projection.pixels", size}}, size);
  if (half != 0)
    t.change("picture-size",
             {{"projection.pixels", size},
              {"projection.cx", t.numberOr("projection.cx", 0) + half * (1 - width / own.x)},
              {"projection.cy", t.numberOr("projection.cy", 0) + half * (1 - height / own.y)}},
             size);
}

void changeIntrinsics(Trials& t) {
  const auto number = [&](const char* name) { return t.numberOr(std::string("projection.") + name, 0); };
  const double fx = number("fx"), fy = number("fy"), cx = number("cx"), cy = number("cy");
  const double half = t.viewport().pixelCenter - 0.5;
  const auto set = [&](const char* mistake, double a, double b, double x, double y, Json value = nullptr) {
    std::vector<Set> sets;
    for (const auto& [name, is, was] : {std::tuple("fx", a, fx), {"fy", b, fy}, {"cx", x, cx}, {"cy", y, cy}})
      if (is != was) sets.emplace_back(std::string("projection.") + name, is);
    if (!sets.empty()) t.change(mistake, sets, std::move(value));
  };
  const auto [w, h] = calibratedPictureOf(t);
  for (const double off : {half, 0.0}) ofSize(t, std::round(2 * (cx - off)), std::round(2 * (cy - off)));
  set("fx-fy-exchanged", fy, fx, cx, cy);
  for (const double one : {fx, fy}) set("fx-fy-exchanged", one, one, cx, cy);
  set("intrinsics-order", fx, cx, fy, cy);
  const double left = w + 2 * half - cx, up = h + 2 * half - cy, middleX = w / 2 + half, middleY = h / 2 + half;
  set("principal-point", fx, fy, cy, cx, "exchanged");
  set("principal-point", fx, fy, left, cy, "x from the right");
  set("principal-point", fx, fy, cx, up, "y from the bottom");
  set("principal-point", fx, fy, left, up, "from the other corner");
  for (const double off : {half, 0.0, -0.5}) set("principal-point", fx, fy, w / 2 + off, h / 2 + off, "the middle");
  set("principal-point", fx, fy, middleX + cx, middleY + cy, "from the middle");
  set("principal-point", fx, fy, middleX + cx, middleY - cy, "from the middle, y up");
  for (const double off : {0.5, -0.5}) set("pixel-centre", fx, fy, cx + off, cy + off);
  if (std::max({fx, fy, std::fabs(cx), std::fabs(cy)}) < 10)
    for (const double off : {0.0, half}) set("intrinsics-normalized", fx * w, fy * h, cx * w + off, cy * h + off);
  set("size-exchanged", fy, fx, cy, cx);
}

using Fraction = std::pair<int, int>;

/// Of small numbers, within 0.3 %; 0 if there is none.
Fraction fractionOf(double ratio) {
  for (int by = 1; by <= 10; ++by)
    if (const double of = std::round(ratio * by); std::fabs(of / (ratio * by) - 1) < 3e-3)
      return {static_cast<int>(of), by};
  return {};
}

/// "4/3", or a whole number.
Json shownFraction(const Fraction& f) {
  return f.second == 1 ? Json(f.first) : Json(std::to_string(f.first) + "/" + std::to_string(f.second));
}

/// "4/3", or the number.
Json shownRatio(double ratio) {
  const Fraction f = fractionOf(ratio);
  return f.first > 0 && std::fabs(f.first / (ratio * f.second) - 1) < 1e-9 ? shownFraction(f) : Json(ratio);
}

/// "60" and "60deg" in radians, "1.05rad" in degrees.
std::string inOtherUnit(const Json& angle) {
  std::string text = angle.is_string() ? angle.get<std::string>() : angle.dump();
  for (const std::string_view unit : {"rad", "deg", "\xC2\xB0"})
    if (text.ends_with(unit)) return text.substr(0, text.size() - unit.size()) + (unit == "rad" ? "deg" : "rad");
  return text + "rad";
}

void changeAngle(Trials& t) {
  for (const char* const path : kAngles) {
    const Json* const angle = t.find(path);
    if (!angle) continue;
    for (const char* const other : kAngles)
      if (path != other) t.change("fov-axis", {{other, *angle}});
    const std::string other = inOtherUnit(*angle);
    t.change("radians", {{path, other}}, other.ends_with("rad") ? "radians" : "degrees");
    const double degrees = t.degreesOr(path, 0);
    for (const double times : {2.0, 0.5})
      t.change("half-angle", {{path, degrees * times}}, times > 1 ? "half" : "twice");
    // Who made the pixels has used as many radians as there are degrees.
    const double ratio = std::tan(degrees / 2) / std::tan(degrees * std::numbers::pi / 360);
    const auto [cx, cy] = t.plain().centre;
    if (std::fabs(ratio) > 1e-9) t.pixels("radians", {ratio, 0, cx - ratio * cx, 0, ratio, cy - ratio * cy}, "pixels");
  }
  if (t.has("projection.aspect"))
    t.change("aspect", {{"projection.aspect", nullptr}}, shownRatio(t.viewport().width / t.viewport().height));
  for (const Json& aspect : {Json(1), shownRatio(1 / t.projection().aspect())})
    t.change("aspect", {{"projection.aspect", aspect}}, aspect, true);
}

void changeSensor(Trials& t) {
  if (!t.has("projection.focalLength")) return;
  const auto side = [&](const char* path) { return t.has(path) ? *t.find(path) : Json(); };
  const double w = t.viewport().width, h = t.viewport().height;
  const double diagonal = std::hypot(36, 24) * w / std::hypot(w, h);
  for (const auto& [across, down] : {std::pair<Json, Json>(36, nullptr),
                                     {nullptr, 24},
                                     {diagonal, nullptr},
                                     {side("projection.sensorHeight"), side("projection.sensorWidth")}})
    t.change("sensor", {{"projection.sensorWidth", across}, {"projection.sensorHeight", down}});
}

void changeLens(Trials& t) {
  const Json* const given = t.find("distortion");
  const auto become = [&](const char* mistake, Json lens, Json value = nullptr) {
    t.change(mistake, {{"distortion", std::move(lens)}}, std::move(value));
  };
  if (!given) {
    if (!t.plain().isOrthographic) become("fisheye-for-brown", {{"model", "fisheye"}}, "equidistant");
    return;
  }
  become("distortion-ignored", nullptr);
  for (const int passes : {-1, 2}) t.add({.mistake = "distortion-twice", .camera = t.plain(), .lensPasses = passes});
  const std::string model = (*given)["model"];
  const auto number = [&](const char* name) { return given->value(name, Json()); };
  // Each model's numbers as another one reads them. What it then lacks is null, and no lens.
  const std::pair<const char*, Json> readings[] = {
      {"unified", {{"model", "omni"}, {"xi", number("alpha")}}},
      {"unified", {{"model", "unified"}, {"alpha", number("alpha")}}},
      {"double-sphere", {{"model", "double-sphere"}, {"xi", number("alpha")}, {"alpha", number("xi")}}},
      {"double-sphere", {{"model", "unified"}, {"alpha", number("alpha")}}},
      {"fov", {{"model", "fisheye"}}},
      {"omni", {{"model", "brown"}, {"k", number("k")}, {"p", number("p")}}},
      {"omni", {{"model", "unified"}, {"alpha", number("xi")}}}};
  for (const auto& [of, lens] : readings)
    if (model == of) become("lens-model", lens);
  std::vector<double> k = given->value("k", std::vector<double>{});
  const auto p = given->value("p", std::array<double, 2>{});
  if (model == "fisheye") {
    k.resize(4);
    return become("fisheye-for-brown", {{"model", "brown"}, {"k", {k[0], k[1]}}, {"p", {k[2], k[3]}}}, "brown");
  }
  if (model != "brown" && k.empty()) return;
  const auto with = [&](const std::vector<double>& others, double p1, double p2) {
    Json lens = *given;
    lens.update({{"k", others}, {"p", {p1, p2}}});
    return lens;
  };
  if (p[0] != 0 || p[1] != 0) {
    become("lens-order", with(k, p[1], p[0]));
    become("lens-order", with(k, 0, 0));
  }
  if (k.size() <= 3) {
    std::vector<double> three = k;
    three.resize(3);
    become("lens-order", with({three[0], three[1], p[1]}, three[2], p[0]));
    become("lens-order", with({three[0], three[1], p[0]}, p[1], three[2]));
    if (model == "brown") {
      become("fisheye-for-brown", {{"model", "fisheye"}, {"k", {three[0], three[1], p[0], p[1]}}}, "fisheye");
      become("fisheye-for-brown", {{"model", "fisheye"}, {"k", three}}, "fisheye");
    }
  }
  for (double& each : k) each = 0 - each;
  become("lens-sign", with(k, 0 - p[0], 0 - p[1]));
}

}  // namespace

void addRatioRows(Trials& t, const Hypothesis& fitted) {
  if (fitted.parameters != 1) return;
  const Vec2 focal = fitted.camera.focal;
  if (fitted.mistake == "focal-lengths" && !t.has("projection.fx")) {
    const Fraction aspect = fractionOf(t.viewport().width / t.viewport().height * std::fabs(focal.y / focal.x));
    if (aspect.first > 0)
      t.change("aspect", {{"projection.aspect", shownFraction(aspect)}}, shownFraction(aspect), true);
  } else if (fitted.mistake == "pixel-ratio" && t.has("projection.fx")) {
    const auto [of, by] = fractionOf(t.plain().focal.x / focal.x);
    const Vec2 own = calibratedPictureOf(t), size{own.x * of / by, own.y * of / by};
    const auto isNearer = [](double centre, double to, double from) {  // to the middle
      return std::fabs(centre / to - 0.5) < std::fabs(centre / from - 0.5);
    };
    if (of > 0 && size.x == std::round(size.x) && size.y == std::round(size.y) &&
        isNearer(t.numberOr("projection.cx", 0), size.x, own.x) &&
        isNearer(t.numberOr("projection.cy", 0), size.y, own.y))
      ofSize(t, size.x, size.y);
  }
}

void addWindowRows(Trials& t) {
  changePicture(t);
  if (t.has("projection.fx"))
    changeIntrinsics(t);
  else if (t.has("viewport"))
    t.change("size-exchanged",
             {{"viewport.width", *t.find("viewport.height")}, {"viewport.height", *t.find("viewport.width")}});
  changeAngle(t);
  changeSensor(t);
  changeLens(t);
}

}  // namespace viewproj::cmd::mistakes
