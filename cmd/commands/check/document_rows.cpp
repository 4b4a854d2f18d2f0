// Mistakes of the document but for its pose: fields that mend it.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "camera/names.hpp"
#include "commands/check/hypothesis.hpp"

namespace viewproj::cmd::mistakes {
namespace {

constexpr const char* kAngles[] = {"projection.fovY", "projection.fovX", "projection.fovDiagonal"};

/// The size of the picture that fx, fy, cx and cy are of.
Vec2 pictureOf(const Trials& t) {
  const Vec2 whole{t.numberOr("viewport.width", t.camera().viewport().width),
                   t.numberOr("viewport.height", t.camera().viewport().height)};
  const Json* const pixels = t.find("projection.pixels");
  return pixels ? Vec2{(*pixels)[0].get<double>(), (*pixels)[1].get<double>()} : whole;
}

/// "60" and "60deg" in radians, "1.05rad" in degrees.
std::string inOtherUnit(const Json& angle) {
  std::string text = angle.is_string() ? angle.get<std::string>() : angle.dump();
  for (const std::string_view unit : {"rad", "deg", "\xC2\xB0"})
    if (text.ends_with(unit)) return text.substr(0, text.size() - unit.size()) + (unit == "rad" ? "deg" : "rad");
  return text + "rad";
}

void flipY(Trials& t) {
  std::vector<Set> sets{
      {"viewport.origin", t.camera().viewport().origin == Origin::topLeft ? "bottom-left" : "top-left"}};
  // What counts in pixels of the picture is counted from the other edge as well.
  const double height = t.numberOr("viewport.height", t.camera().viewport().height), of = pictureOf(t).y;
  if (t.has("projection.cy"))
    sets.emplace_back("projection.cy", 2 * (t.numberOr("viewport.y", 0) * of / height + t.pixelCenter()) - 1 + of -
                                           t.numberOr("projection.cy", 0));
  if (t.has("viewport.crop"))
    sets.emplace_back("viewport.crop.y",
                      height - t.numberOr("viewport.crop.y", 0) - t.numberOr("viewport.crop.height", 0));
  t.change("y-flipped", sets);
}

void movePicture(Trials& t) {
  const bool isRight = t.camera().convention().world == Handedness::right;
  t.change("x-mirrored", {{"convention.world", isRight ? "left" : "right"}});
  t.change("pixel-centre", {{"viewport.pixelCenter", t.pixelCenter() == 0 ? 0.5 : 0}});
  if (t.has("viewport.crop")) t.change("viewport-offset", {{"viewport.crop", nullptr}});
  for (const char* const corner : {"viewport.", "viewport.crop."}) {
    const double x = t.numberOr(corner + std::string("x"), 0), y = t.numberOr(corner + std::string("y"), 0);
    if (x == 0 && y == 0) continue;
    for (const double sign : {1.0, -1.0}) t.pixels("viewport-offset", {1, 0, sign * x, 0, 1, sign * y});
  }
}

void changeIntrinsics(Trials& t) {
  const Json* const type = t.find("projection.type");
  if (!type || *type != "intrinsics") {
    if (const Json* const w = t.find("viewport.width"), * const h = t.find("viewport.height"); w && h)
      t.change("size-exchanged", {{"viewport.width", *h}, {"viewport.height", *w}});
    return;
  }
  const auto number = [&](const char* name) { return t.numberOr(std::string("projection.") + name, 0); };
  const double fx = number("fx"), fy = number("fy"), cx = number("cx"), cy = number("cy"), c = t.pixelCenter() - 0.5;
  const Vec2 size = pictureOf(t);
  const auto set = [&](const char* mistake, double a, double b, double x, double y, Json value = nullptr) {
    std::vector<Set> sets;
    for (const auto& [name, is, was] : {std::tuple("fx", a, fx), {"fy", b, fy}, {"cx", x, cx}, {"cy", y, cy}})
      if (is != was) sets.emplace_back(std::string("projection.") + name, is);
    if (!sets.empty()) t.change(mistake, sets, std::move(value));
  };
  const double width = std::round(2 * (cx - c)), height = std::round(2 * (cy - c));
  if (width > 0 && height > 0 && (width != size.x || height != size.y || t.has("projection.pixels")))
    t.change("picture-size",
             {{"projection.pixels", {static_cast<std::int64_t>(width), static_cast<std::int64_t>(height)}}},
             {static_cast<std::int64_t>(width), static_cast<std::int64_t>(height)});
  if (fx != fy) {
    set("fx-fy-exchanged", fy, fx, cx, cy);
    set("fx-fy-exchanged", fx, fx, cx, cy);
    set("fx-fy-exchanged", fy, fy, cx, cy);
  }
  set("intrinsics-order", fx, cx, fy, cy);
  set("principal-point", fx, fy, cy, cx, "exchanged");
  const double left = size.x - 1 + 2 * t.pixelCenter() - cx, up = size.y - 1 + 2 * t.pixelCenter() - cy;
  set("principal-point", fx, fy, left, cy, "x from the right");
  set("principal-point", fx, fy, cx, up, "y from the bottom");
  set("principal-point", fx, fy, left, up, "from the other corner");
  set("principal-point", fx, fy, size.x / 2 + c, size.y / 2 + c, "the middle");
  set("principal-point", fx, fy, size.x / 2, size.y / 2, "the middle");
  set("principal-point", fx, fy, (size.x - 1) / 2, (size.y - 1) / 2, "the middle");
  set("principal-point", fx, fy, size.x / 2 + c + cx, size.y / 2 + c + cy, "from the middle");
  set("principal-point", fx, fy, size.x / 2 + c + cx, size.y / 2 + c - cy, "from the middle, y up");
  for (const double half : {0.5, -0.5}) set("pixel-centre", fx, fy, cx + half, cy + half);
  if (std::max({fx, fy, std::fabs(cx), std::fabs(cy)}) < 10)
    for (const double offset : {0.0, c})
      set("intrinsics-normalized", fx * size.x, fy * size.y, cx * size.x + offset, cy * size.y + offset);
  set("size-exchanged", fy, fx, cy, cx);
}

void changeAngle(Trials& t) {
  for (const char* const path : kAngles) {
    const Json* const angle = t.find(path);
    if (!angle) continue;
    for (const char* const other : kAngles)
      if (path != other) t.change("fov-axis", {{other, *angle}});
    t.change("radians", {{path, inOtherUnit(*angle)}});
    if (!angle->is_number()) continue;
    const double degrees = angle->get<double>();
    t.change("half-angle", {{path, degrees * 2}});
    t.change("half-angle", {{path, degrees / 2}});
    // Who made the pixels has used as many radians as there are degrees.
    const double ratio = std::tan(degrees / 2) / std::tan(degrees * std::numbers::pi / 360);
    const auto [cx, cy] = t.plain().centre;
    if (std::fabs(ratio) > 1e-9) t.pixels("radians", {ratio, 0, cx - ratio * cx, 0, ratio, cy - ratio * cy});
  }
  if (t.has("projection.aspect")) t.change("aspect", {{"projection.aspect", nullptr}});
  const Projection p = t.camera().projection();
  for (const double aspect : {1.0, 1 / p.aspect()}) t.change("aspect", {{"projection.aspect", aspect}}, nullptr, true);
  if (!t.has("projection.focalLength")) return;
  const Viewport& v = t.camera().viewport();
  const Json width = t.has("projection.sensorWidth") ? *t.find("projection.sensorWidth") : Json();
  const Json height = t.has("projection.sensorHeight") ? *t.find("projection.sensorHeight") : Json();
  const auto sensor = [&](const Json& across, const Json& down) {
    t.change("sensor", {{"projection.sensorWidth", across}, {"projection.sensorHeight", down}});
  };
  sensor(36, nullptr);
  sensor(nullptr, 24);
  sensor(height, width);
  sensor(std::sqrt(36.0 * 36 + 24 * 24) * v.width / std::hypot(v.width, v.height), nullptr);
}

/// The numbers of a lens of one model, which another model would read in its own way.
void changeLensModel(Trials& t, const Json& given) {
  const std::string model = given["model"];
  const Json xi = given.value("xi", Json()), alpha = given.value("alpha", Json());
  const auto become = [&](Json lens) { t.change("lens-model", {{"distortion", std::move(lens)}}); };
  if (model == "unified") {
    become({{"model", "omni"}, {"xi", alpha}});
    if (given.contains("beta")) become({{"model", "unified"}, {"alpha", alpha}});
  } else if (model == "double-sphere") {
    become({{"model", "double-sphere"}, {"xi", alpha}, {"alpha", xi}});
    become({{"model", "unified"}, {"alpha", alpha}});
  } else if (model == "fov") {
    become({{"model", "fisheye"}});
  } else if (model == "omni" && (given.contains("k") || given.contains("p"))) {
    Json brown = given;
    brown.erase("xi");
    brown["model"] = "brown";
    become(brown);
  } else if (model == "omni") {
    become({{"model", "unified"}, {"alpha", xi}});
  }
}

void changeLens(Trials& t) {
  const Json* const given = t.find("distortion");
  const auto become = [&](const char* mistake, Json lens) { t.change(mistake, {{"distortion", std::move(lens)}}); };
  if (!given) {
    if (!t.plain().isOrthographic) become("fisheye-for-brown", {{"model", "fisheye"}});
    return;
  }
  become("distortion-ignored", nullptr);
  for (const int passes : {-1, 2}) {
    Hypothesis twice = t.next("distortion-twice");
    twice.lensPasses = passes;
    t.add(std::move(twice));
  }
  changeLensModel(t, *given);
  const std::string model = (*given)["model"];
  std::vector<double> k = given->value("k", std::vector<double>{}), p = given->value("p", std::vector<double>{0, 0});
  if (model == "fisheye") {
    k.resize(4);
    return become("fisheye-for-brown", {{"model", "brown"}, {"k", {k[0], k[1]}}, {"p", {k[2], k[3]}}});
  }
  if (model != "brown" && k.empty()) return;
  const auto with = [&](const std::vector<double>& others, double p1, double p2) {
    Json lens = *given;
    lens["k"] = others;
    lens["p"] = {p1, p2};
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
      become("fisheye-for-brown", {{"model", "fisheye"}, {"k", {three[0], three[1], p[0], p[1]}}});
      become("fisheye-for-brown", {{"model", "fisheye"}, {"k", three}});
    }
  }
  for (double& each : k) each = 0 - each;
  become("lens-sign", with(k, 0 - p[0], 0 - p[1]));
}

}  // namespace

void addDocumentRows(Trials& t) {
  flipY(t);
  movePicture(t);
  changeIntrinsics(t);
  changeAngle(t);
  changeLens(t);
}

}  // namespace viewproj::cmd::mistakes
