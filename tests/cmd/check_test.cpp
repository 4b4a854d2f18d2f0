// Every mistake of the table is found in pixels that a textbook's projection made with it, and nothing is found in
// pixels that no single mistake makes. The threads from which the mistakes are taken stand beside their rows.
#include "camera/check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "catch.hpp"
#include "commands/pair_check.hpp"
#include "random.hpp"

using namespace viewproj;
using namespace viewproj::cmd;

namespace {

double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Vec3 minus(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec3 unit(const Vec3& a) {
  const double length = std::sqrt(dot(a, a));
  return {a.x / length, a.y / length, a.z / length};
}

/// A camera as a textbook has it: right-handed, y down from the picture's top, pixels from their corner.
struct Scene {
  Vec3 eye, target, up;
  double degrees, width, height;

  Vec3 forward() const { return unit(minus(target, eye)); }
  Vec3 right() const { return unit(cross(forward(), up)); }
  Vec3 above() const { return cross(right(), forward()); }
  double focal() const { return height / 2 / std::tan(degrees * std::numbers::pi / 360); }

  Vec3 inView(const Vec3& p) const {
    const Vec3 d = minus(p, eye);
    return {dot(d, right()), dot(d, above()), dot(d, forward())};
  }
  Vec2 pixel(const Vec3& p) const {
    const Vec3 v = inView(p);
    return {width / 2 + focal() * v.x / v.z, height / 2 - focal() * v.y / v.z};
  }
  /// The pixel that other focal lengths give, so many times these.
  Vec2 stretched(const Vec2& q, double x, double y) const {
    return {width / 2 + x * (q.x - width / 2), height / 2 + y * (q.y - height / 2)};
  }
  Vec3 point(double x, double y, double distance) const {  // x, y from -1 to 1 across the picture
    const double a = x * width / 2 / focal() * distance, b = y * height / 2 / focal() * distance;
    const Vec3 r = right(), u = above(), f = forward();
    return {eye.x + r.x * a + u.x * b + f.x * distance, eye.y + r.y * a + u.y * b + f.y * distance,
            eye.z + r.z * a + u.z * b + f.z * distance};
  }
  /// x, y, z, w of the rotation from right, up, back to the world (Shepperd's method, by the largest of four).
  std::array<double, 4> rotation() const {
    const Vec3 x = right(), y = above(), f = forward(), z{-f.x, -f.y, -f.z};
    const double m[3][3] = {{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}};
    const double trace = m[0][0] + m[1][1] + m[2][2];
    std::array<double, 4> q{m[0][0] - m[1][1] - m[2][2], m[1][1] - m[0][0] - m[2][2], m[2][2] - m[0][0] - m[1][1],
                            trace};
    const auto most = static_cast<std::size_t>(std::max_element(q.begin(), q.end()) - q.begin());
    const double s = 2 * std::sqrt(1 + q[most]);
    if (most == 3) return {(m[2][1] - m[1][2]) / s, (m[0][2] - m[2][0]) / s, (m[1][0] - m[0][1]) / s, s / 4};
    const std::size_t i = most, j = (i + 1) % 3, k = (i + 2) % 3;
    q[i] = s / 4;
    q[j] = (m[j][i] + m[i][j]) / s;
    q[k] = (m[k][i] + m[i][k]) / s;
    q[3] = (m[k][j] - m[j][k]) / s;
    return q;
  }
};

Json arrayOf(const Vec3& v) { return {v.x, v.y, v.z}; }

Json lookDocument(const Scene& s) {
  return {{"position", arrayOf(s.eye)},
          {"target", arrayOf(s.target)},
          {"up", arrayOf(s.up)},
          {"projection", {{"type", "perspective"}, {"fovY", s.degrees}, {"near", 0.1}}},
          {"viewport", {{"width", s.width}, {"height", s.height}}}};
}
Json rotationDocument(const Scene& s) {
  Json document = lookDocument(s);
  document.erase("target");
  document.erase("up");
  document["rotation"] = s.rotation();
  return document;
}
Json intrinsicsDocument(const Scene& s) {
  Json document = rotationDocument(s);
  document["projection"] = {{"type", "intrinsics"}, {"fx", s.focal()},    {"fy", s.focal()},
                            {"cx", s.width / 2},    {"cy", s.height / 2}, {"near", 0.1}};
  return document;
}

constexpr double kLensK1 = 0.1;
Json lensDocument(const Scene& s) {
  Json document = lookDocument(s);
  document["distortion"] = {{"model", "brown"}, {"k", {kLensK1}}};
  return document;
}
/// A pixel of the pinhole through that lens.
Vec2 bent(const Scene& s, const Vec2& pixel) {
  const double x = pixel.x - s.width / 2, y = pixel.y - s.height / 2;
  const double factor = 1 + kLensK1 * (x * x + y * y) / s.focal() / s.focal();
  return {s.width / 2 + x * factor, s.height / 2 + y * factor};
}

/// A camera and six points in its view.
struct Trial {
  Scene scene;
  std::vector<Vec3> points;
};
Trial randomTrial(std::uint64_t seed) {
  Random random(seed);
  Trial trial;
  Scene& s = trial.scene;
  s.eye = random.direction(random.logUniform(3, 30));
  s.target = random.direction(random.uniform(0.1, 1));
  s.up = random.coin() ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
  s.degrees = random.uniform(25, 90);
  s.width = 640 + 8.0 * static_cast<double>(random.below(160));
  s.height = 360 + 8.0 * static_cast<double>(random.below(30));
  for (int i = 0; i < 6; ++i) {  // drawn in one order, whatever the compiler
    const double x = random.uniform(-0.9, 0.9), y = random.uniform(-0.9, 0.9), distance = random.logUniform(2, 20);
    trial.points.push_back(s.point(x, y, distance));
  }
  return trial;
}

/// Nothing where the mistake leaves no camera.
std::optional<OrderedJson> checked(const Json& document, const Trial& trial,
                                   const std::function<Vec2(const Vec3&)>& pixelOf,
                                   const std::function<Vec3(const Vec3&)>& pointOf, double within) {
  Document file{"camera.json", std::make_shared<Json>(document)};
  normalize(file);
  const ReadOptions reading;
  std::optional<Camera> camera;
  try {
    camera = makeCamera(readCamera(file, reading));
  } catch (const std::exception&) {
    return std::nullopt;
  }
  PairCheck check(*camera, hypotheses(file, reading), within);
  for (std::size_t i = 0; i < trial.points.size(); ++i) {
    const Vec3 p = pointOf ? pointOf(trial.points[i]) : trial.points[i];
    check.add({p.x, p.y, p.z, 1}, pixelOf(trial.points[i]), i + 1);
  }
  return check.report();
}

struct Case {
  const char* name;
  const char* mistake;
  Json (*document)(const Scene&);
  Vec2 (*pixel)(const Scene&, const Vec2&);  ///< made of the right one
  Vec3 (*point)(const Vec3&) = nullptr;
  bool noise = true;
};

Vec2 right(const Scene&, const Vec2& q) { return q; }
template <class Change>
Json changed(Json document, const Change& change) {
  change(document);
  return document;
}

const Case kCases[] = {
    // sceneview PR#93, camera-picking-ray#1, antvis/G PR#1778, bevy-mouse-tracking PR#33; H - 1 - y: libgdx PR#7469,
    // thunder#350, cesium#12751, mrirecon/view PR#7
    {"y from the bottom", "y-flipped", lookDocument,
     [](const Scene& s, const Vec2& q) {
       return Vec2{q.x, s.height - q.y};
     }},
    {"y from the bottom, intrinsics", "y-flipped", intrinsicsDocument,
     [](const Scene& s, const Vec2& q) {
       return Vec2{q.x, s.height - q.y};
     }},
    {"y from the bottom as an index", "y-flipped-index", lookDocument,
     [](const Scene& s, const Vec2& q) {
       return Vec2{q.x, s.height - 1 - q.y};
     }},
    {"x mirrored", "x-mirrored", lookDocument,
     [](const Scene& s, const Vec2& q) {
       return Vec2{s.width - q.x, q.y};
     }},
    {"z of the points negated", "x-mirrored", lookDocument, right,
     [](const Vec3& p) {
       return Vec3{p.x, p.y, -p.z};
     }},
    {"centres at whole numbers", "pixel-centre", lookDocument,
     [](const Scene&, const Vec2& q) {
       return Vec2{q.x - 0.5, q.y - 0.5};
     }},
    {"centres at whole numbers, intrinsics", "pixel-centre", intrinsicsDocument,
     [](const Scene&, const Vec2& q) {
       return Vec2{q.x - 0.5, q.y - 0.5};
     }},
    // x3dom#612, three.js PR#7272, gl-mesh3d PR#9, megaplot#49, playcanvas/engine#328, TouchFree PR#250
    {"device pixels", "pixel-ratio", lookDocument,
     [](const Scene&, const Vec2& q) {
       return Vec2{2 * q.x, 2 * q.y};
     }},
    {"CSS pixels", "pixel-ratio", lookDocument,
     [](const Scene&, const Vec2& q) {
       return Vec2{q.x / 1.5, q.y / 1.5};
     }},
    // bevy_mod_raycast#93
    {"the crop's corner left in", "viewport-offset",
     [](const Scene& s) {
       return changed(lookDocument(s), [&](Json& d) {
         d["viewport"]["crop"] = {{"x", 40}, {"y", 25}, {"width", s.width - 80}, {"height", s.height - 60}};
       });
     },
     right},
    {"the viewport's corner left out", "viewport-offset",
     [](const Scene& s) {
       return changed(lookDocument(s), [](Json& d) { d["viewport"].update({{"x", 64}, {"y", 48}}); });
     },
     right},
    {"intrinsics of a picture 1.75 times as wide", "picture-size",
     [](const Scene& s) {
       return changed(intrinsicsDocument(s), [](Json& d) {
         for (const char* key : {"fx", "fy", "cx", "cy"})
           d["projection"][key] = 1.75 * d["projection"][key].get<double>();
       });
     },
     right},
    // fovY in three.js and GLM, fovX in Unreal and Magnum
    {"fovY that is fovX", "fov-axis",
     [](const Scene& s) {
       return changed(lookDocument(s), [&](Json& d) {
         d["projection"]["fovY"] = 360 / std::numbers::pi * std::atan(s.width / 2 / s.focal());
       });
     },
     right},
    {"fovX for fovY", "fov-axis",
     [](const Scene& s) {
       return changed(lookDocument(s), [&](Json& d) {
         d["projection"].erase("fovY");
         d["projection"]["fovX"] = s.degrees;
       });
     },
     right},
    {"aspect 1, as of two integers divided", "aspect", lookDocument,
     [](const Scene& s, const Vec2& q) { return s.stretched(q, s.width / s.height, 1); }},
    {"aspect inverted", "aspect", lookDocument,
     [](const Scene& s, const Vec2& q) { return s.stretched(q, s.width * s.width / (s.height * s.height), 1); }},
    {"radians as degrees", "radians",
     [](const Scene& s) {
       return changed(lookDocument(s), [&](Json& d) { d["projection"]["fovY"] = s.degrees * std::numbers::pi / 180; });
     },
     right},
    {"degrees as radians", "radians", lookDocument,
     [](const Scene& s, const Vec2& q) {
       const double times = s.height / 2 / std::tan(s.degrees / 2) / s.focal();
       return s.stretched(q, times, times);
     },
     nullptr, false},
    {"a direction as target", "direction-as-target",
     [](const Scene& s) {
       return changed(lookDocument(s), [&](Json& d) { d["target"] = arrayOf(minus(s.target, s.eye)); });
     },
     right},
    {"a target as direction", "direction-as-target",
     [](const Scene& s) {
       return changed(lookDocument(s), [&](Json& d) {
         d.erase("target");
         d["direction"] = arrayOf(s.target);
       });
     },
     right},
    {"points with z up", "up-axis", lookDocument, right,
     [](const Vec3& p) {
       return Vec3{p.x, -p.z, p.y};
     }},
    {"up of another axis", "up-axis",
     [](const Scene& s) {
       return changed(lookDocument(s), [&](Json& d) { d["up"] = s.up.y == 1 ? Json{0, 0, 1} : Json{0, 1, 0}; });
     },
     right},
    // nerfplusplus#41, HouseCat6D#9, kalibr#751, RenderMe-360#6
    {"world to camera as camera to world", "pose-inverted",
     [](const Scene& s) {
       return changed(rotationDocument(s), [&](Json& d) {
         const Vec3 r = s.right(), u = s.above(), f = s.forward(), e = s.eye;
         d.erase("position");
         d.erase("rotation");
         d["worldFromCamera"] = {
             {r.x, r.y, r.z, -dot(r, e)}, {u.x, u.y, u.z, -dot(u, e)}, {-f.x, -f.y, -f.z, dot(f, e)}, {0, 0, 0, 1}};
       });
     },
     right},
    {"rotation inverted", "pose-inverted",
     [](const Scene& s) {
       return changed(rotationDocument(s), [&](Json& d) {
         const auto q = s.rotation();
         d["rotation"] = {-q[0], -q[1], -q[2], q[3]};
       });
     },
     right},
    // Align3R#11, IsaacLab-Arena PR#673, colmap#2934
    {"w first", "quaternion-order",
     [](const Scene& s) {
       return changed(rotationDocument(s), [&](Json& d) {
         const auto q = s.rotation();
         d["rotation"] = {q[3], q[0], q[1], q[2]};
       });
     },
     right},
    {"w first, each number by its name", "quaternion-order",
     [](const Scene& s) {
       return changed(rotationDocument(s), [&](Json& d) {
         const auto q = s.rotation();
         d["rotation"] = {{"x", q[3]}, {"y", q[0]}, {"z", q[1]}, {"w", q[2]}};
       });
     },
     right},
    // gaussian-splatting PR#111, nerfstudio#1504, instant-ngp#1486, 4DGaussians#191
    {"OpenCV's axes as OpenGL's", "camera-axes",
     [](const Scene& s) { return changed(rotationDocument(s), [](Json& d) { d["cameraAxes"] = "RDF"; }); }, right},
    {"a distortion left out", "distortion-ignored", lensDocument, right},
    {"a distortion twice", "distortion-twice", lensDocument,
     [](const Scene& s, const Vec2& q) { return bent(s, bent(s, q)); }},
    {"pixels undistorted twice", "distortion-twice", lensDocument,
     [](const Scene& s, const Vec2& q) {  // halving finds the radius that the lens puts at q's
       const double x = q.x - s.width / 2, y = q.y - s.height / 2, put = std::hypot(x, y) / s.focal();
       double low = 0, high = put;
       for (int i = 0; i < 60; ++i) {
         const double r = (low + high) / 2;
         (r * (1 + kLensK1 * r * r) < put ? low : high) = r;
       }
       return Vec2{s.width / 2 + x / put * low, s.height / 2 + y / put * low};
     },
     nullptr, false},
    {"0..1 for pixels", "normalized", lookDocument,
     [](const Scene& s, const Vec2& q) {
       return Vec2{q.x / s.width, q.y / s.height};
     },
     nullptr, false},
    {"NDC for pixels", "ndc", lookDocument,
     [](const Scene& s, const Vec2& q) {
       return Vec2{2 * q.x / s.width - 1, 1 - 2 * q.y / s.height};
     },
     nullptr, false},
};

std::string mistakesOf(const OrderedJson& report) {
  std::string names;
  for (const OrderedJson& one : report["explanations"]) names += one["mistake"].get<std::string>() + " ";
  return names;
}

}  // namespace

TEST_CASE("Pixels made with a mistake are explained by it, and hardly ever by another as well") {
  std::size_t others = 0, trials = 0;
  for (const Case& each : kCases) {
    std::size_t found = 0;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
      const Trial trial = randomTrial(seed);
      Random noise(seed);
      CAPTURE(each.name, seed, each.document(trial.scene).dump());
      const auto pixelOf = [&](const Vec3& p) {
        const Vec2 pixel = each.pixel(trial.scene, trial.scene.pixel(p));
        // A mend that scales the pixels scales their noise.
        const double size = each.noise ? 0.05 : 0;
        return Vec2{pixel.x + noise.uniform(-size, size), pixel.y + noise.uniform(-size, size)};
      };
      const auto report = checked(each.document(trial.scene), trial, pixelOf, each.point, 0.2);
      if (!report || (*report)["agrees"]) continue;
      INFO(report->dump());
      const std::string names = mistakesOf(*report);
      ++found;
      ++trials;
      if (names == std::string(each.mistake) + " ") continue;
      ++others;
      CHECK(names.find(each.mistake) != std::string::npos);
    }
    CAPTURE(each.name, found);
    CHECK(found >= 80);
  }
  CAPTURE(others, trials);
  CHECK(others * 100 < trials);
}

TEST_CASE("Pixels that no single mistake makes are explained by none") {
  std::size_t visited = 0;
  for (std::uint64_t seed = 0; seed < 10000; ++seed) {
    const Trial trial = randomTrial(seed);
    Random random(seed);
    Json (*const forms[])(const Scene&) = {lookDocument, rotationDocument, intrinsicsDocument};
    const auto report = checked(
        forms[seed % 3](trial.scene), trial,
        [&](const Vec3& p) {
          const Vec2 pixel = trial.scene.pixel(p);
          return Vec2{pixel.x + random.uniform(-200, 200), pixel.y + random.uniform(-200, 200)};
        },
        nullptr, 0.1);
    REQUIRE(report);
    INFO(report->dump());
    CHECK(!(*report)["agrees"]);
    CHECK((*report)["explanations"].empty());
    ++visited;
  }
  CHECK(visited == 10000);
}

TEST_CASE("Two mistakes at once have no explanation") {
  std::size_t visited = 0;
  for (const Case& document : kCases)
    for (const Case& pixels : kCases) {
      // One is a mistake of the document, the other of the pixels.
      if (document.pixel != right || document.point || pixels.pixel == right || pixels.document != lookDocument)
        continue;
      const std::string_view a = document.mistake, b = pixels.mistake;
      if (a == b || (a == "fov-axis" && b == "aspect")) continue;  // which are one: aspect 1 of the other axis
      if (a == "viewport-offset" && (b == "normalized" || b == "ndc")) continue;  // which no corner changes
      for (std::uint64_t seed = 0; seed < 5; ++seed) {
        const Trial trial = randomTrial(seed);
        CAPTURE(document.name, pixels.name, seed);
        const auto report = checked(
            document.document(trial.scene), trial,
            [&](const Vec3& p) { return pixels.pixel(trial.scene, trial.scene.pixel(p)); }, nullptr,
            0.01);  // at 0.1 a target taken for a direction, far away, and a flip pass for the other flip
        if (!report) continue;
        INFO(report->dump());
        CHECK(!(*report)["agrees"]);
        CHECK((*report)["explanations"].empty());
        ++visited;
      }
    }
  CHECK(visited > 500);
}

// A mouse that counts from the window's corner and not from the canvas's: vwf PR#268.
TEST_CASE("What no mistake explains and is the same everywhere is the offset of the fit") {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Trial trial = randomTrial(seed);
    const auto report = checked(
        lookDocument(trial.scene), trial,
        [&](const Vec3& p) {
          const Vec2 pixel = trial.scene.pixel(p);
          return Vec2{pixel.x + 300, pixel.y + 56};
        },
        nullptr, 0.1);
    REQUIRE(report);
    const OrderedJson& fit = (*report)["fit"];
    CHECK((*report)["explanations"].empty());
    CHECK(fit["offset"][0].get<double>() == Approx(300).epsilon(1e-12));
    CHECK(fit["offset"][1].get<double>() == Approx(56).epsilon(1e-12));
    CHECK(fit["offsetRms"] < 1e-9);
  }
}

TEST_CASE("The fit of offset and scale is that of least squares") {
  // given = [2 x + 3, 5 - y] of what is computed; reference: by hand.
  const Trial trial = randomTrial(1);
  const auto report = checked(
      lookDocument(trial.scene), trial,
      [&](const Vec3& p) {
        const Vec2 pixel = trial.scene.pixel(p);
        return Vec2{2 * pixel.x + 3, 5 - pixel.y};
      },
      nullptr, 0.1);
  REQUIRE(report);
  const OrderedJson& fit = (*report)["fit"];
  CHECK(fit["scale"][0].get<double>() == Approx(2).epsilon(1e-12));
  CHECK(fit["scale"][1].get<double>() == Approx(-1).epsilon(1e-12));
  CHECK(fit["scaleOffset"][0].get<double>() == Approx(3).epsilon(1e-9));
  CHECK(fit["scaleOffset"][1].get<double>() == Approx(5).epsilon(1e-9));
  CHECK(fit["scaleRms"] < 1e-9);
  CHECK((*report)["worst"] >= 1);
}
