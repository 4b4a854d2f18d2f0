// Mistakes made on purpose: each is named, alone, by what explains the pixels; pixels that no mistake made are not
// explained.
#include <cstdlib>
#include <functional>
#include <nlohmann/json.hpp>

#include "camera/values.hpp"
#include "catch.hpp"
#include "commands/check/mend.hpp"
#include "commands/check/report.hpp"
#include "commands/check/words.hpp"
#include "random.hpp"
#include "viewproj/viewproj.hpp"

using namespace viewproj;
using namespace viewproj::cmd;
using namespace viewproj::cmd::mistakes;

namespace {

enum Form { look, rotation, euler, vision, bent, wide, earth };
constexpr unsigned kForms = earth + 1;

/// A right camera, with numbers as people type them.
Json documentOf(Random& random, Form form) {
  const double width = 640 + 8 * std::floor(random.uniform(0, 100)),
               height = 480 + 8 * std::floor(random.uniform(0, 60));
  const auto round = [&](double low, double high) { return std::round(random.uniform(low, high) * 100) / 100; };
  Json eye{round(3, 9), round(2, 5), round(-8, -3)};
  Json document{{"projection", {{"type", "perspective"}, {"fovY", round(30, 80)}, {"near", 0.1}}},
                {"viewport", {{"width", width}, {"height", height}}}};
  if (form == earth) {
    document["position"] = {{"lat", round(-60, 60)}, {"lon", round(10, 70)}, {"height", round(200, 900)}};
    document["heading"] = round(20, 340), document["pitch"] = round(-60, -15), document["roll"] = round(2, 9);
    return document;
  }
  document["position"] = eye;
  if (form == look) document["target"] = {round(-1, 1), round(-1, 1), round(-1, 1)};
  if (form == euler)
    document["euler"] = {{"order", "YXZ"}, {"degrees", {round(20, 60), round(-50, -10), round(5, 30)}}};
  const Vec3 axis = random.vector(1);
  const Rows turned = turn(scaled(axis, random.uniform(0.5, 2) / length(axis)));
  if (form == rotation) {
    const double angle = random.uniform(0.3, 1), s = std::sin(angle) / length(axis);
    document["rotation"] = {s * axis.x, s * axis.y, s * axis.z, std::cos(angle)};
  }
  if (form < vision) return document;
  document["convention"] = "opencv";
  document.erase("position");
  Json rows = Json::array();
  for (const Vec3& row : turned) rows.push_back({row.x, row.y, row.z});
  document["cameraFromWorld"] = {{"rotation", rows}, {"translation", {round(-1, 1), round(-1, 1), round(4, 9)}}};
  const double f = std::round(width * random.uniform(0.8, 1.4));
  document["projection"] = {{"type", "intrinsics"},
                            {"fx", f},
                            {"fy", f + round(9, 30)},
                            {"cx", round(0.44, 0.48) * width},
                            {"cy", round(0.52, 0.56) * height},
                            {"near", 0.1}};
  if (form == wide) document["distortion"] = {{"model", "double-sphere"}, {"xi", -0.1}, {"alpha", 0.55}};
  if (form == bent) document["distortion"] = {{"model", "brown"}, {"k", {-0.21, 0.06}}, {"p", {0.003, -0.002}}};
  return document;
}

Document documentOf(const Json& json) {
  Document document{"the camera", std::make_shared<Json>(json)};
  normalize(document);
  return document;
}
CameraFile fileOf(const Json& json) { return readCamera(documentOf(json), {}); }
Camera cameraOf(const Json& json) { return makeCamera(readCamera(documentOf(json), {.allowStretch = true})); }

/// Points in the picture.
std::vector<Vec3> pointsOf(Random& random, const Camera& camera, int count, double nearest = 3) {
  const auto [first, last] = pictureCorners(camera.viewport());
  std::vector<Vec3> points;
  while (static_cast<int>(points.size()) < count) {
    const Vec2 pixel{random.uniform(first.x, last.x), random.uniform(first.y, last.y)};
    const WorldPoint point = screenToWorldAtDistance(camera, pixel, random.logUniform(nearest, 10 * nearest));
    if (point.status == DepthStatus::point) points.push_back(point.position);
  }
  return points;
}

/// What somebody makes of the right document, points and pixels.
struct Wrong {
  const char* mistake;
  std::vector<Form> forms;
  std::function<void(Json&)> document = [](Json&) {};
  std::function<Vec2(Vec2 size, Vec2 pixel)> pixel = [](Vec2, Vec2 q) { return q; };
  std::function<Vec3(Vec3)> point = [](Vec3 p) { return p; };
  std::function<void(Json&)> truth = [](Json&) {};  ///< of the program that made the pixels
};

const auto kSame = [](Json&) {};
const auto kSamePixel = [](Vec2, Vec2 q) { return q; };
const auto kSamePoint = [](Vec3 p) { return p; };

/// The numbers of a picture that is so much larger, in which cx and cy count from `zero`.
void enlarge(Json& d, double times, double zero) {
  for (const char* const f : {"fx", "fy"}) d["projection"][f] = times * d["projection"][f].get<double>();
  for (const char* const c : {"cx", "cy"})
    d["projection"][c] = times * (d["projection"][c].get<double>() - zero) + zero;
}

const Wrong kWrong[] = {
    {"y-flipped",
     {look, rotation},
     kSame,
     [](Vec2 s, Vec2 q) {
       return Vec2{q.x, s.y - q.y};
     }},
    {"y-flipped-index",
     {look, rotation},
     kSame,
     [](Vec2 s, Vec2 q) {
       return Vec2{q.x, s.y - 1 - q.y};
     }},
    {"x-mirrored",
     {look, euler},
     kSame,
     [](Vec2 s, Vec2 q) {
       return Vec2{s.x - q.x, q.y};
     }},
    {"pixel-centre",
     {look},
     kSame,
     [](Vec2, Vec2 q) {
       return Vec2{q.x - 0.5, q.y - 0.5};
     }},
    {"pixel-ratio",
     {look, rotation},
     kSame,
     [](Vec2, Vec2 q) {
       return Vec2{2 * q.x, 2 * q.y};
     }},
    {"normalized",
     {look, euler},
     kSame,
     [](Vec2 s, Vec2 q) {
       return Vec2{q.x / s.x, q.y / s.y};
     }},
    {"ndc",
     {look, euler},
     kSame,
     [](Vec2 s, Vec2 q) {
       return Vec2{2 * q.x / s.x - 1, 1 - 2 * q.y / s.y};
     }},
    {"picture-turned",
     {look, euler},
     kSame,
     [](Vec2 s, Vec2 q) {
       return Vec2{s.y - q.y, q.x};
     }},
    {"row-column",
     {look, rotation},
     kSame,
     [](Vec2, Vec2 q) {
       return Vec2{q.y, q.x};
     }},
    {"resized",
     {look, vision},
     kSame,
     [](Vec2, Vec2 q) {
       return Vec2{0.61 * q.x, 0.72 * q.y};
     }},
    {"principal-point",
     {look, rotation},
     kSame,
     [](Vec2, Vec2 q) {
       return Vec2{q.x - 100, q.y - 60};
     }},
    {"scale-and-offset",
     {look, euler},
     kSame,
     [](Vec2, Vec2 q) {
       return Vec2{0.4 * q.x, 0.4 * q.y + 77};
     }},
    {"y-flipped + principal-point",
     {look},
     kSame,
     [](Vec2 s, Vec2 q) {
       return Vec2{q.x + 300, s.y - q.y + 56};
     }},
    {"up-axis",
     {look, vision},
     kSame,
     [](Vec2, Vec2 q) { return q; },
     [](Vec3 p) {
       return Vec3{p.x, -p.z, p.y};
     }},
    {"point-axes",
     {rotation, vision},
     kSame,
     [](Vec2, Vec2 q) { return q; },
     [](Vec3 p) {
       return Vec3{-p.z, -p.x, p.y};
     }},
    {"up-axis + unit",
     {look, vision},
     kSame,
     [](Vec2, Vec2 q) { return q; },
     [](Vec3 p) {
       return Vec3{100 * p.x, 100 * p.z, 100 * p.y};
     }},
    {"unit", {vision, euler}, kSame, [](Vec2, Vec2 q) { return q; }, [](Vec3 p) { return scaled(p, 1000); }},
    {"radians", {look}, [](Json& d) { d["projection"]["fovY"] = d["projection"]["fovY"].get<double>() * M_PI / 180; }},
    {"half-angle", {look}, [](Json& d) { d["projection"]["fovY"] = d["projection"]["fovY"].get<double>() / 2; }},
    {"pose-inverted",
     {vision},
     [](Json& d) { d["worldFromCamera"] = d["cameraFromWorld"], d.erase("cameraFromWorld"); }},
    {"quaternion-order",
     {rotation},
     [](Json& d) {
       d["rotation"] = {d["rotation"][3], d["rotation"][0], d["rotation"][1], d["rotation"][2]};
     }},
    {"euler-order", {euler}, [](Json& d) { d["euler"]["order"] = "XYZ"; }},
    {"euler-order",
     {euler},
     [](Json& d) {
       const Json angles = d["euler"]["degrees"];
       d["euler"]["degrees"] = {angles[1], angles[2], angles[0]};
     }},
    {"euler-sign", {euler}, [](Json& d) { d["euler"]["degrees"][1] = -d["euler"]["degrees"][1].get<double>(); }},
    {"fx-fy-exchanged", {vision}, [](Json& d) { std::swap(d["projection"]["fx"], d["projection"]["fy"]); }},
    {"picture-size", {vision, bent}, [](Json& d) { enlarge(d, 1.5, 0); }},
    {"picture-size", {vision}, [](Json& d) { enlarge(d, 1.5, -0.5); }},
    {"aspect", {look}, kSame, kSamePixel, kSamePoint, [](Json& d) { d["projection"]["aspect"] = "16/9"; }},
    {"aspect", {look}, kSame, kSamePixel, kSamePoint, [](Json& d) { d["projection"]["aspect"] = "5/4"; }},
    {"lens-order", {bent}, [](Json& d) { std::swap(d["distortion"]["p"][0], d["distortion"]["p"][1]); }},
    {"lens-sign",
     {bent},
     [](Json& d) {
       d["distortion"] = {{"model", "brown"}, {"k", {0.21, -0.06}}, {"p", {-0.003, 0.002}}};
     }},
    {"heading-convention", {earth}, [](Json& d) { d["heading"] = -d["heading"].get<double>(); }},
    {"pitch-convention", {earth}, [](Json& d) { d["pitch"] = d["pitch"].get<double>() + 90; }},
    {"heading", {earth}, [](Json& d) { d["heading"] = d["heading"].get<double>() + 3.2; }},
    {"pitch", {earth}, [](Json& d) { d["pitch"] = d["pitch"].get<double>() + 2.3; }},
    {"height", {earth}, [](Json& d) { d["position"]["height"] = d["position"]["height"].get<double>() - 49.3; }},
    {"eye",
     {look, rotation, euler},
     kSame,
     [](Vec2, Vec2 q) { return q; },
     [](Vec3 p) {
       return sum(p, 1, {0.31, 0.2, -0.4});
     }},
    {"focal-length",
     {look, vision, wide},
     [](Json& d) {
       for (const char* name : {"fx", "fy"})
         if (d["projection"].contains(name)) d["projection"][name] = 1.3 * d["projection"][name].get<double>();
       if (d["projection"].contains("fovY")) d["projection"]["fovY"] = 1.3 * d["projection"]["fovY"].get<double>();
     }},
};

/// A camera document with a mistake, and pairs of points and pixels that the right one made.
struct Case {
  Json given;
  std::vector<Pair> pairs;
};
Case caseOf(const Wrong& wrong, unsigned trial, int count, double noise = 0) {
  Random random(trial);
  const Form form = wrong.forms[trial % wrong.forms.size()];
  const Json right = documentOf(random, form);
  Case made{right, {}};
  wrong.document(made.given);
  Json truth = right;
  wrong.truth(truth);
  const Camera camera = cameraOf(truth);
  const Vec2 size{camera.viewport().width, camera.viewport().height};
  const double half = camera.viewport().pixelCenter - 0.5;
  for (const Vec3& point : pointsOf(random, camera, count, form == earth ? 90 : 3)) {
    const ScreenPoint at = worldToScreen(camera, point);
    // Noise of the picture's pixels, whatever the mistake makes of them. Of this sum of three the deviation is `noise`.
    const auto rounding = [&] {
      return noise * (random.uniform(-1, 1) + random.uniform(-1, 1) + random.uniform(-1, 1));
    };
    const Vec2 q = wrong.pixel(size, {at.x - half + rounding(), at.y - half + rounding()});
    const Vec3 p = wrong.point(point);
    made.pairs.push_back({{p.x, p.y, p.z, 1}, {q.x + half, q.y + half}});
  }
  return made;
}

/// So many times what the variable says, where it is set: more than a run of all tests has time for.
unsigned trialsOf(unsigned usual) {
  const char* const asked = std::getenv("VIEWPROJ_MISTAKES");
  return asked ? usual * static_cast<unsigned>(std::atoi(asked)) : usual;
}

}  // namespace

TEST_CASE("A mistake is named, and no other beside it") {
  int tried = 0;
  for (const Wrong& wrong : kWrong)
    for (unsigned trial = 0; trial < 4; ++trial) {
      const auto [given, pairs] = caseOf(wrong, trial, 7);
      CAPTURE(wrong.mistake, trial, given.dump());
      const std::vector<Explanation> found = explain(fileOf(given), pairs, 0.1);
      REQUIRE(!found.empty());
      CHECK(found[0].hypothesis.mistake == wrong.mistake);
      CHECK(found[0].largest < 0.01);
      CHECK(found.size() == 1);
      ++tried;
      // What is judged is the mend itself, through the library.
      const Hypothesis& h = found[0].hypothesis;
      const Mend mend = mendOf(fileOf(given), found[0], pairs);
      const std::string words = wordsForPairs(h, mend.pixels);
      CAPTURE(mend.options(), words);
      CHECK(words.empty() == !(mend.pixels != PixelMap{} || h.lensPasses != 0 || h.points != kUnit));
      std::vector<Patch> patches;
      for (const std::string& set : mend.sets) patches.push_back(setPatch(set));
      const Camera mended = makeCamera(changed(fileOf(given), patches, mend.stretch));
      for (const Pair& pair : pairs) {
        const ScreenPoint at = worldToScreen(mended, h.point(pair.point));
        const Vec2 q = mend.pixels(pair.pixel);
        CHECK(std::hypot(at.x - q.x, at.y - q.y) < 0.02);
      }
    }
  CHECK(tried > 100);
}

TEST_CASE("A mistake is found as often in few pairs and in noise", "[rates]") {
  struct Share {
    int pairs;
    double noise, first, alone, other;  ///< of all cases, to two digits: at least, at least, at most
  };
  constexpr Share kShares[] = {{2, 0, 0.91, 0.91, 0.003}, {2, 0.3, 0.61, 0.60, 0},     {2, 1, 0.48, 0.46, 0},
                               {3, 0, 0.98, 0.98, 0},     {3, 0.3, 0.80, 0.76, 0.013}, {3, 1, 0.70, 0.67, 0.006},
                               {4, 0, 1, 1, 0},           {4, 0.3, 0.88, 0.84, 0.016}, {4, 1, 0.79, 0.74, 0.019},
                               {6, 0, 1, 1, 0},           {6, 0.3, 0.92, 0.90, 0.010}, {6, 1, 0.85, 0.79, 0.013},
                               {20, 0, 1, 1, 0},          {20, 0.3, 0.95, 0.95, 0},    {20, 1, 0.92, 0.88, 0.013}};
  for (const Share& share : kShares) {
    const auto isFlip = [](std::string_view mistake) {
      return mistake.starts_with("y-flipped") && mistake.find('+') == mistake.npos;
    };
    double first = 0, alone = 0, other = 0, all = 0;
    for (const Wrong& wrong : kWrong)
      for (unsigned trial = 0; trial < trialsOf(1); ++trial, ++all) {
        const auto [given, pairs] = caseOf(wrong, trial, share.pairs, share.noise);
        const std::vector<Explanation> found = explain(fileOf(given), pairs, 0.1);
        // One pixel is not told from noise.
        const bool isFirst =
            !found.empty() && (found[0].hypothesis.mistake == wrong.mistake ||
                               (share.noise > 0 && isFlip(found[0].hypothesis.mistake) && isFlip(wrong.mistake)));
        first += isFirst;
        alone += isFirst && found.size() == 1;
        other += !found.empty() && !isFirst;
      }
    CAPTURE(share.pairs, share.noise, all);
    const auto least = [&](double part) { return part - 0.005 - 2 * std::sqrt(part * (1 - part) / all); };
    CHECK(first / all >= least(share.first));
    CHECK(alone / all >= least(share.alone));
    CHECK(1 - other / all >= least(1 - share.other));
  }
}

TEST_CASE("Pixels that no mistake made are not explained") {
  unsigned explained = 0;
  for (unsigned trial = 0; trial < trialsOf(60); ++trial) {
    Random random(trial);
    const Json document = documentOf(random, static_cast<Form>(trial % kForms));
    const Camera camera = cameraOf(document);
    std::vector<Pair> pairs;
    for (const Vec3& p : pointsOf(random, camera, 2 + static_cast<int>(trial % 5)))
      pairs.push_back({{p.x, p.y, p.z, 1}, {random.uniform(0, 640), random.uniform(0, 480)}});
    explained += !explain(fileOf(document), pairs, 0.1).empty();
  }
  CHECK(1000 * explained <= trialsOf(60));
}

TEST_CASE("Of a set, the mistake of most cameras is told, and no mend that spoils another camera") {
  Random random(5);
  Json document = documentOf(random, earth);
  const auto reportOf = [&](const std::function<double(double)>& written) {
    PairReport report(0.1);
    std::size_t line = 0;
    for (const double heading : {0.0, 70.0, 140.0}) {
      document["heading"] = heading;
      const Camera camera = cameraOf(document);
      document["heading"] = written(heading);
      const auto read = [&] { return std::pair(std::to_string(int(heading)), fileOf(document)); };
      for (const Vec3& p : pointsOf(random, camera, 5, 90)) {
        const ScreenPoint at = worldToScreen(camera, Vec4{p.x, p.y, p.z, 1});
        report.add({p.x, p.y, p.z, 1}, Vec2{at.x, at.y}, ++line, static_cast<std::size_t>(heading), read);
      }
    }
    return report.report()["explanations"];
  };
  // Of the camera to the north alone a turn by 90 degrees, or other axes, would do.
  OrderedJson list = reportOf([](double heading) { return 90 - heading; });
  REQUIRE(list.size() == 1);
  CHECK(list[0]["mistake"] == "heading-convention");
  CHECK(list[0]["camerasMended"] == 3);
  list = reportOf([](double heading) { return heading == 70 ? 75 : heading; });
  REQUIRE(list.size() == 1);
  CHECK(list[0]["mistake"] == "heading");
  CHECK(list[0]["camerasMended"] == 1);
  CHECK(list[0]["mend"].is_null());
  CHECK(list[0]["sentence"].get<std::string>().ends_with("heading 70 for 75 (70 alone)"));
  // What is left is of all cameras.
  list = reportOf([](double heading) { return heading == 70 ? 75 : heading == 140 ? 140.5 : heading; });
  REQUIRE(list.size() == 1);
  CHECK(list[0]["camerasMended"] == 1);
  CHECK(list[0]["mend"].is_null());
  CHECK(list[0]["largestMiss"].get<double>() > 1);
}

TEST_CASE("A mistake of the noise's size is found in many pairs, and none where there is none") {
  int found = 0;
  for (unsigned trial = 0; trial < 10; ++trial) {
    Random random(trial);
    const Json document = documentOf(random, static_cast<Form>(trial % kForms));
    const Camera camera = cameraOf(document);
    const double size = trial % 4 + 1;
    std::vector<Pair> pairs, shifted;
    for (const Vec3& p : pointsOf(random, camera, 60)) {
      const ScreenPoint at = worldToScreen(camera, p);
      const auto noise = [&] { return random.uniform(-0.5, 0.5) + random.uniform(-0.25, 0.25); };
      pairs.push_back({{p.x, p.y, p.z, 1}, {at.x + size * noise(), at.y + size * noise()}});
      shifted.push_back({{p.x, p.y, p.z, 1}, {at.x + 0.5 + noise(), at.y + 0.5 + noise()}});
    }
    CAPTURE(trial, document.dump());
    CHECK(explain(fileOf(document), pairs, 0.1).empty());
    const std::vector<Explanation> list = explain(fileOf(document), shifted, 0.1);
    found += list.size() == 1 && list[0].hypothesis.mistake == "pixel-centre";
  }
  CHECK(found >= 9);
}

TEST_CASE("On the Earth a way is told in metres, and no angle that only its place changes") {
  Random random(2);
  Json document = documentOf(random, earth);
  const Camera camera = cameraOf(document);
  std::vector<Pair> pairs;
  for (const Vec3& p : pointsOf(random, camera, 6, 90)) {
    const ScreenPoint at = worldToScreen(camera, p);
    pairs.push_back({{p.x, p.y, p.z, 1}, {at.x, at.y}});
  }
  document["position"]["lat"] = document["position"]["lat"].get<double>() + 0.0001;
  const std::vector<Explanation> found = explain(fileOf(document), pairs, 0.1);
  REQUIRE(found.size() == 1);
  const std::string sentence = sentenceOf(fileOf(document), found[0], 0.1);
  CHECK(sentence.starts_with("the eye is moved by "));
  CHECK(sentence.ends_with(" m (east, north, up)"));
}

TEST_CASE("One mistake that brings all within the tolerance is told before two that leave less") {
  Random random(4);
  Json document = documentOf(random, look);
  const Camera camera = cameraOf(document);
  std::vector<Pair> pairs;
  for (const Vec3& p : pointsOf(random, camera, 6)) {
    const ScreenPoint at = worldToScreen(camera, p);
    pairs.push_back({{p.x, p.y, p.z, 1}, {at.x, at.y}});
  }
  const double degrees = document["projection"]["fovY"];
  document["projection"]["fovY"] = std::round(degrees * M_PI / 180 * 1e4) / 1e4;
  const std::vector<Explanation> found = explain(fileOf(document), pairs, 0.1);
  REQUIRE(!found.empty());
  CHECK(found[0].hypothesis.mistake == "radians");
}

TEST_CASE("Pixels without a lens that have another focal length are of two mistakes") {
  for (unsigned trial = 0; trial < 5; ++trial) {
    Random random(trial);
    const Json right = documentOf(random, vision);
    const Camera camera = cameraOf(right);
    Json given = right;
    given["distortion"] = {{"model", "brown"}, {"k", {-0.21, 0.06}}};
    for (const char* const f : {"fx", "fy"}) given["projection"][f] = 1.1 * given["projection"][f].get<double>();
    std::vector<Pair> pairs;
    for (const Vec3& p : pointsOf(random, camera, 8)) {
      const ScreenPoint at = worldToScreen(camera, p);
      pairs.push_back({{p.x, p.y, p.z, 1}, {at.x, at.y}});
    }
    const std::vector<Explanation> found = explain(fileOf(given), pairs, 0.1);
    REQUIRE(!found.empty());
    CHECK(found[0].hypothesis.mistake == "distortion-ignored + focal-length");
  }
}

TEST_CASE("A wrong pair is named beside a mistake") {
  int named = 0;
  for (unsigned trial = 0; trial < 30; ++trial) {
    Random random(trial);
    const Json right = documentOf(random, trial % 2 ? look : vision);
    const Camera camera = cameraOf(right);
    const bool isLetterbox = trial % 3 != 0;  // else 0..1 across the picture
    const double half = camera.viewport().pixelCenter - 0.5, w = camera.viewport().width, h = camera.viewport().height;
    std::vector<Pair> pairs;
    for (const Vec3& p : pointsOf(random, camera, 9)) {
      const ScreenPoint at = worldToScreen(camera, p);
      const double x = at.x + (pairs.size() == 4 ? 60 : 0);
      const Vec2 pixel = isLetterbox ? Vec2{100 + 0.7 * x, 0.7 * at.y} : Vec2{(x - half) / w, (at.y - half) / h};
      pairs.push_back({{p.x, p.y, p.z, 1}, pixel, pairs.size() + 1});
    }
    const std::vector<Explanation> found = explain(fileOf(right), pairs, 0.1);
    if (found.size() == 1 && found[0].hypothesis.mistake == (isLetterbox ? "scale-and-offset" : "normalized") &&
        found[0].wrong == std::vector<std::size_t>{5})
      ++named;
  }
  CHECK(named >= 26);
}

TEST_CASE("Pixels in another order are given back to their points") {
  Random random(1);
  const Json document = documentOf(random, look);
  PairReport report(fileOf(document), 0.1);
  const std::vector<Vec3> points = pointsOf(random, cameraOf(document), 5);
  for (std::size_t i = 0; i < 5; ++i) {
    const Vec3 &p = points[i], &other = points[i == 1 ? 3 : i == 3 ? 1 : i];
    const ScreenPoint at = worldToScreen(cameraOf(document), other);
    report.add({p.x, p.y, p.z, 1}, Vec2{at.x, at.y}, i + 1);
  }
  const OrderedJson list = report.report()["explanations"];
  REQUIRE(list.size() == 1);
  CHECK(list[0]["mistake"] == "pixel-order");
  CHECK(list[0]["pairs"] == "give line 2 the pixel of line 4, line 4 the pixel of line 2");
  // The first of a column of pixels is lost.
  PairReport shifted(fileOf(document), 0.1);
  for (std::size_t i = 0; i < 5; ++i) {
    const ScreenPoint at = i < 4 ? worldToScreen(cameraOf(document), points[i + 1]) : ScreenPoint{7, 7};
    shifted.add({points[i].x, points[i].y, points[i].z, 1}, Vec2{at.x, at.y}, i + 1);
  }
  const OrderedJson one = shifted.report()["explanations"];
  REQUIRE(one.size() == 1);
  CHECK(one[0]["wrongPairs"] == OrderedJson{1});
  CHECK(one[0]["pairs"] == "give each line the pixel of the line before it");
}

TEST_CASE("Normalized image coordinates have neither focal lengths nor a lens") {
  for (unsigned trial = 0; trial < 4; ++trial) {
    Random random(trial);
    const Json given = documentOf(random, trial % 2 ? bent : vision);
    Json plane = given;
    plane["projection"].update({{"fx", 1}, {"fy", 1}, {"cx", 0}, {"cy", 0}});
    plane.erase("distortion");
    std::vector<Pair> pairs;
    for (const Vec3& p : pointsOf(random, cameraOf(given), 6)) {
      const ScreenPoint at = worldToScreen(cameraOf(plane), p);
      pairs.push_back({{p.x, p.y, p.z, 1}, {at.x, trial < 2 ? at.y : -at.y}});
    }
    const std::vector<Explanation> found = explain(fileOf(given), pairs, 0.1);
    REQUIRE(found.size() == 1);
    CHECK(found[0].hypothesis.mistake == "image-coordinates");
    CHECK(found[0].largest < 1e-6);
  }
}

TEST_CASE("A line is wrong where it misses by several times what the others do, not where it exceeds the tolerance") {
  int disagreed = 0;
  for (unsigned trial = 0; trial < 100; ++trial) {
    Random random(trial);
    const CameraFile file = fileOf(documentOf(random, look));
    const Camera camera = makeCamera(file);
    PairReport noisy(file, 0.6), wrong(file, 0.6);
    std::size_t line = 0;
    for (const Vec3& p : pointsOf(random, camera, 4 + static_cast<int>(trial % 9))) {
      const ScreenPoint at = worldToScreen(camera, p);
      const Vec2 near{at.x + random.uniform(-0.5, 0.5), at.y + random.uniform(-0.5, 0.5)};
      noisy.add({p.x, p.y, p.z, 1}, near, ++line);
      wrong.add({p.x, p.y, p.z, 1}, line == 3 ? Vec2{near.x + 8, near.y} : near, line);
    }
    const OrderedJson report = noisy.report();
    CAPTURE(trial, report.dump());
    disagreed += report["agrees"] == false;
    CHECK(report["wrongPairs"].empty());
    CHECK(report["explanations"].empty());
    CHECK(wrong.report()["wrongPairs"] == OrderedJson{3});
  }
  CHECK(disagreed > 20);
}

TEST_CASE("A report counts every pair, tells the misses, and names wrong pairs before the camera") {
  Random random(3);
  const CameraFile file = fileOf(documentOf(random, look));
  const Camera camera = makeCamera(file);
  PairReport few(file, 0.1), many(file, 0.1);
  std::size_t line = 1;
  for (const Vec3& p : pointsOf(random, camera, 10)) {
    const ScreenPoint at = worldToScreen(camera, p);
    few.add({p.x, p.y, p.z, 1}, Vec2{at.x + (line == 7 ? 3 : 0), at.y + (line == 7 ? 4 : 0)}, line);
    ++line;
  }
  const Vec3 eye = camera.pose().eye(), ahead = camera.pose().forward(), behind = sum(eye, -1, ahead);
  few.add({behind.x, behind.y, behind.z, 1}, std::nullopt, 11);  // it has none, and ours has none either
  OrderedJson report = few.report();
  CHECK(report["records"] == 11);
  CHECK(report["noPixel"] == 0);
  CHECK(std::fabs(report["rmsMiss"].get<double>() - std::sqrt(2.5)) < 1e-9);
  CHECK(std::fabs(report["meanMiss"].get<double>() - 0.5) < 1e-9);
  CHECK(report["medianMiss"].get<double>() < 1e-9);
  CHECK(std::fabs(report["miss95"].get<double>() - 5) < 1e-9);
  CHECK(report["worst"] == 7);
  CHECK(report["wrongPairs"] == OrderedJson{7});
  CHECK(report["explanations"].empty());
  CHECK(report["verdict"].is_null());
  few.add({behind.x, behind.y, behind.z, 1}, Vec2{1, 1}, 12);
  CHECK(few.report()["noPixel"] == 1);
  // A point that is hidden in the other program: no camera is blamed for it.
  PairReport hidden(file, 0.1);
  line = 1;
  for (const Vec3& p : pointsOf(random, camera, 7)) {
    const ScreenPoint at = worldToScreen(camera, p);
    hidden.add({p.x, p.y, p.z, 1}, line == 4 ? std::nullopt : std::optional(Vec2{at.x, at.y}), line);
    ++line;
  }
  report = hidden.report();
  CHECK(report["agrees"] == false);
  CHECK(report["wrongPairs"] == OrderedJson{4});
  CHECK(report["explanations"].empty());

  // A hundred thousand pixels that are 0 to 2 pixels to the right.
  for (std::size_t i = 0; i < 100'000; ++i) {
    const Vec3 p = sum(eye, 1 + static_cast<double>(i % 17), ahead);
    const ScreenPoint at = worldToScreen(camera, p);
    many.add({p.x, p.y, p.z, 1}, Vec2{at.x + 2e-5 * static_cast<double>(i), at.y}, i + 1);
  }
  report = many.report();
  CHECK(report["judged"] == 3125);
  CHECK(std::fabs(report["medianMiss"].get<double>() - 1) < 0.002);
  CHECK(std::fabs(report["miss95"].get<double>() - 1.9) < 0.003);
  CHECK(report["worst"] == 100'000);
}
