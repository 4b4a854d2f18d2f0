// The camera document: what each form of a pose and a projection means, what patches displace, what is refused.
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "formats/open.hpp"
#include "parts.hpp"
#include "text/error.hpp"
#include "viewproj/matrices.hpp"
#include "viewproj/screen.hpp"

using namespace viewproj;
using namespace viewproj::cmd;
using Patches = std::vector<std::string>;

namespace {

/// "--near 1" is an option, "projection.near=1" a --set.
Document laid(const std::string& document, const Patches& patches) {
  CameraPatches all;
  for (const std::string& text : patches) {
    const std::size_t blank = text.find(' ');
    if (!text.starts_with("--")) all.patches.push_back(setPatch(text));
    for (const Field& field : kFields)
      if (blank != std::string::npos && field.option == text.substr(0, blank))
        all.patches.push_back(optionPatch(field, text.substr(blank + 1)));
  }
  REQUIRE(all.patches.size() == patches.size());
  requireConsistent(all.patches);
  return openCameras(document, {.option = "C"}, all)->document(0);
}

Camera cameraOf(const std::string& document, const Patches& patches = {}) {
  return makeCamera(readCamera(laid(document, patches), {}));
}

/// A unit at distance 1 is 50 pixels, and the middle of the picture is at 100, 50.
Camera posed(const std::string& pose) {
  return cameraOf("{" + pose + R"(, "projection": {"type": "perspective", "fovY": 90, "near": 0.1},
                               "viewport": {"width": 200, "height": 100, "pixelCenter": 0.5}})");
}

Camera seeing(const std::string& projection, const Patches& patches = {}) {
  return cameraOf(R"({"position": [0, 0, 0], "direction": [0, 0, -1], "up": [0, 1, 0], "projection": {)" + projection +
                      R"(}, "viewport": {"width": 200, "height": 100}})",
                  patches);
}

std::string message(const std::string& document, const Patches& patches) {
  try {
    (void)cameraOf(document, patches);
  } catch (const std::exception& e) {
    return e.what();
  }
  return "";
}

/// A document with the members of the other in place of its own.
std::string with(const char* members) {
  nlohmann::json document = {{"position", {3, 2, 5}},
                             {"target", {0, 0, 0}},
                             {"projection", {{"type", "perspective"}, {"fovY", 60}, {"near", 0.1}, {"far", 1000}}},
                             {"viewport", {{"width", 1280}, {"height", 720}}}};
  document.merge_patch(nlohmann::json::parse(members));
  return document.dump();
}

}  // namespace

TEST_CASE("A point two ahead, one to the right and one above is seen there, however the pose is written") {
  // On the equator at longitude 0, right, up and forward are among east (y), up (x) and north (z).
  const std::string earth = R"("position": {"lat": 0, "lon": 0, "height": 0}, )";
  const std::pair<std::string, Vec3> rows[] = {
      {R"("position": {"x": 1, "y": 2, "z": 3}, "direction": [0, 0, -2])", {2, 3, 1}},
      {R"("eye": [1, 2, 3], "lookAt": [1, 2, 0], "up": [0, 5, 7])", {2, 3, 1}},
      // Forward -x, right -z, up y: a quarter turn to the left.
      {R"("position": [1, 2, 3], "direction": [-1, 0, 0])", {-1, 3, 2}},
      {R"("position": [1, 2, 3], "rotation": [0, 3, 0, 3])", {-1, 3, 2}},
      {R"("position": [1, 2, 3], "euler": {"order": "YXZ", "degrees": [90, 0, 0]})", {-1, 3, 2}},
      {R"("position": [1, 2, 3], "rotation": [3, 0, -3, 0], "cameraAxes": "RDF")", {-1, 3, 2}},
      {R"("worldFromCamera": [[0, 0, 1, 1], [0, 1, 0, 2], [-1, 0, 0, 3], [0, 0, 0, 1]])", {-1, 3, 2}},
      {R"("worldFromCamera": [[0, 0, 1, 9], [0, 1, 0, 9], [-1, 0, 0, 9]], "position": [1, 2, 3])", {-1, 3, 2}},
      {R"("worldFromCamera": {"rotation": [0, 1, 0, 1], "translation": [1, 2, 3]})", {-1, 3, 2}},
      {R"("cameraFromWorld": [[0, 0, -1, 3], [0, 1, 0, -2], [1, 0, 0, -1]])", {-1, 3, 2}},
      {R"("cameraFromWorld": {"rotation": [[0, 0, -1], [0, 1, 0], [1, 0, 0]], "translation": [3, -2, -1]})",
       {-1, 3, 2}},
      {R"("cameraFromWorld": {"rotation": [0, -1, 0, 1], "translation": [9, 9, 9]}, "position": [1, 2, 3])",
       {-1, 3, 2}},
      // Presets: the world's handedness, up, and the axes that a rotation turns.
      {R"("convention": "d3d", "position": [1, 2, 3], "direction": [0, 0, 1])", {2, 3, 5}},
      {R"("convention": "unreal", "position": [1, 2, 3], "direction": [1, 0, 0])", {3, 3, 4}},
      {R"("convention": "unreal", "position": [1, 2, 3], "rotation": [0, 0, 0, 1])", {3, 3, 4}},
      {R"("convention": "opencv", "position": [1, 2, 3], "direction": [0, 0, 1])", {2, 1, 5}},
      {R"("convention": "opencv", "position": [1, 2, 3], "rotation": [0, 0, 0, 1])", {2, 1, 5}},
      {R"("convention": "ps2", "position": [1, 2, 3], "target": [1, 2, 4])", {2, 1, 5}},
      {R"("position": [1, 2, 3], "rotation": [0, 0, 0, 1], "cameraAxes": "FLU")", {3, 1, 4}},
      {R"("position": [1, 2, 3], "rotation": [0, 0, 0, 1], "cameraAxes": "FRD")", {3, 3, 2}},
      {R"("world": "enu", "position": [1, 2, 3], "heading": 0)", {2, 4, 4}},
      {R"("world": "enu", "position": [1, 2, 3], "heading": "90deg", "pitch": 0)", {3, 1, 4}},
      {R"("world": "enu", "position": [1, 2, 3], "pitch": -180)", {2, 0, 2}},
      {R"("world": "enu", "position": [1, 2, 3], "target": [1, 9, 3])", {2, 4, 4}},
      {earth + R"("heading": 0)", {6378138, 1, 2}},
      {earth + R"("heading": "90deg")", {6378138, 2, -1}},
      {earth + R"("pitch": 90)", {6378139, 1, -1}},
      {earth + R"("roll": 90)", {6378136, 1, 2}},
      {R"("world": "ecef", "position": [6378137, 0, 0], "direction": [0, 0, 1])", {6378138, 1, 2}},
  };
  for (const auto& [pose, point] : rows) {
    INFO(pose);
    const ScreenPoint p = worldToScreen(posed(pose), point);
    CHECK(p.x == Approx(125).epsilon(1e-13));
    CHECK(p.y == Approx(25).epsilon(1e-13));
    CHECK(p.viewDistance == Approx(2).epsilon(1e-13));
  }
}

TEST_CASE("Turned poses put points where fifty digits put them") {
  const auto check = [](const std::string& pose, const Vec3& point, double x, double y) {  // x, y: mpmath's
    INFO(pose);
    const ScreenPoint p = worldToScreen(posed(pose), point);
    CHECK(p.x == Approx(x).epsilon(1e-14));
    CHECK(p.y == Approx(y).epsilon(1e-14));
  };
  const std::string eye = R"("position": [1, 2, 3], )", euler = eye + R"("euler": {"order": )";
  check(euler + R"("YXZ", "degrees": [20, "30deg", 40]})", {-0.6, 6.4, 0.1}, 109.98914526097067, 30.189194714473295);
  check(euler + R"("XYZ", "degrees": [20, 30, 40]})", {-1.9, 5.4, -0.1}, 110.13504811931999, 30.52510808376565);
  check(euler + R"("ZXZ", "degrees": [20, 30, 40]})", {-1, 5.9, -0.2}, 109.85227972515592, 29.678760229593202);
  check(eye + R"("rotation": [1, -2, 3, 4])", {0.9, 6.7, 0.1}, 109.86754966887418, 29.66887417218543);
  check(R"("worldFromCamera": {"rotationVector": [3, -40, 5], "translation": [1, 2, 3]})", {1.6, 5.2, 7.4},
        110.1966732188475, 29.272242373917493);
  check(R"("worldFromCamera": {"rotationVector": [0.5, -0.25, 2], "translation": [1, 2, 3]})", {-2.4, 3.8, -0.9},
        110.4442793307578, 29.654925172690852);
  check(R"("cameraFromWorld": {"rotationVector": [-0.5, 0.25, -2],
                               "translation": [-2.5490393628330166, 1.6961047826854332, -2.1507270614560667]})",
        {-2.4, 3.8, -0.9}, 110.4442793307578, 29.654925172690852);
}

TEST_CASE("Projections as focal lengths and principal point, in pixels") {
  const auto check = [](const std::string& projection, const Patches& patches, const Intrinsics& expected) {
    INFO(projection);
    const Intrinsics found = seeing(projection, patches).intrinsics();
    CHECK(found.fx == Approx(expected.fx).epsilon(1e-15));
    CHECK(found.fy == Approx(expected.fy).epsilon(1e-15));
    CHECK(found.cx == Approx(expected.cx).epsilon(1e-15));
    CHECK(found.cy == Approx(expected.cy).epsilon(1e-15).margin(1e-13));
  };
  check(R"("type": "perspective", "fovX": "90deg", "aspect": "2:1")", {}, {100, 100, 100, 50});
  check(R"("type": "perspective", "fovY": 90, "shift": [0.5, 0.5])", {}, {50, 50, 150, 25});
  check(R"("type": "perspective", "nearWidth": 4, "nearHeight": 2, "near": 1)", {}, {50, 50, 100, 50});
  check(R"("type": "perspective", "focalLength": 18, "sensorWidth": 36)", {}, {100, 100, 100, 50});
  const std::string frustum = R"("type": "frustum", "left": -1, "right": 3, "bottom": -2, "top": 0, "near": 1)";
  check(frustum, {}, {50, 50, 50, 0});
  check(frustum, {"--near 2"}, {100, 100, 50, 0});
  // Pixels of a picture that is twice as large, counted from its corner and from the middle of its first pixel.
  const std::string pinhole = R"("type": "intrinsics", "fx": 900, "fy": 800, "cx": 300, "cy": 90)";
  const std::string larger = pinhole + R"(, "pixels": [400, 200])";
  check(larger, {}, {450, 400, 150, 45});
  check(larger, {"viewport.pixelCenter=0"}, {450, 400, 149.75, 44.75});
  check(larger, {"viewport.origin=bottom-left", "viewport.width=null", "viewport.height=null"}, {900, 800, 300, 90});
  check(pinhole, {R"(viewport.crop={"x": 10, "y": 20, "width": 50, "height": 60})"}, {900, 800, 290, 70});
}

TEST_CASE("Angles and ratios are rounded once, and far may be infinite") {
  const std::string gltf =
      R"({"asset": {"version": "2.0"}, "nodes": [{"camera": 0}], "cameras": [{"type": "perspective",
    "perspective": {"yfov": 1.0471975511965976, "aspectRatio": 2, "znear": 0.1}}]})";
  const std::string typed = R"("type": "perspective", "fovY": "1.0471975511965976rad", "near": 0.1, "far": "inf")";
  const Projection ours = seeing(typed).projection(),
                   theirs = cameraOf(gltf, {"viewport={\"width\": 200, \"height\": 100}"}).projection();
  CHECK(ours.top() == 0.5773502691896257);  // mpmath
  for (const Projection& p : {ours, theirs}) {
    CHECK(p.right() == ours.right());
    CHECK(p.top() == ours.top());
    CHECK(p.zFar() == kInfiniteFar);
  }
  const std::string wide = R"("type": "perspective", "fovY": 60, "aspect": "16:9")";
  CHECK(seeing(wide, {"viewport.width=1600", "viewport.height=900"}).projection().right() == 1.0264004785593346);
}

TEST_CASE("A projection matrix in any preset is the projection it was written of") {
  const Projection projections[] = {perspective(50, 2.0, 0.1, 100), shifted(perspective(50, 2.0, 0.1), 0.25, -0.5),
                                    orthographic(-4, 4, -2, 2, -1, 30)};
  for (const ConventionPreset& preset : conventionPresets())
    for (const Projection& projection : projections)
      for (const bool isFlat : {false, true}) {
        const Mat4 matrix = clipFromView(projection, preset);
        const Json rows = isFlat ? Json(inStorageOrder(matrix, preset)) : Json(laidOut(matrix, preset).m);
        INFO(preset.name << rows.dump());
        const Projection found =
            seeing(R"("type": "matrix", "matrix": )" + rows.dump(), {"convention=" + std::string(preset.name)})
                .projection();
        for (const auto side : {&Projection::left, &Projection::right, &Projection::bottom, &Projection::top})
          CHECK((found.*side)() == Approx((projection.*side)()).epsilon(1e-15));
        CHECK(found.zNear() == Approx(projection.zNear()).epsilon(1e-13));
        CHECK((found.zFar() == projection.zFar() || found.zFar() == Approx(projection.zFar()).epsilon(1e-12)));
      }
}

TEST_CASE("An option and --set displace what contradicts them and leave the rest") {
  const std::string base = with("{}");
  const std::string matrixPose = with(R"({"position": null, "target": null,
    "worldFromCamera": [[1, 0, 0, 9], [0, 1, 0, 8], [0, 0, 1, 7]]})");
  const std::string pinhole = with(R"({"projection": {"type": "intrinsics", "fovY": null, "fx": 900, "fy": 900,
    "cx": 640, "cy": 360, "pixels": [1280, 720], "shift": [0.1, 0]}})");
  const auto check = [](const std::string& document, const Patches& patches, const char* changes) {  // null: gone
    INFO(document << " " << patches.front());
    nlohmann::json expected = nlohmann::json::parse(document);
    expected.merge_patch(nlohmann::json::parse(changes));
    CHECK(*laid(document, patches).root == expected);
    CHECK(message(document, patches) == "");
  };
  check(base, {"--fov-x 70"}, R"({"projection": {"fovY": null, "fovX": 70}})");
  check(base, {"--near 2", "--far inf"}, R"({"projection": {"near": 2, "far": "inf"}})");
  check(base, {"--direction 0,0,-1"}, R"({"target": null, "direction": [0, 0, -1]})");
  check(base, {"position.0=7", "--up 0,0,1"}, R"({"position": [7, 2, 5], "up": [0, 0, 1]})");
  check(base, {"rotation=[0,0,0,1]"}, R"({"target": null, "rotation": [0, 0, 0, 1]})");
  check(base, {"projection.fovX=70", "projection.fovY=50"}, R"({"projection": {"fovY": 50}})");
  // --set counts last wherever it stands, and of two the later.
  check(base, {"--fov-y 70", "projection.fovY=50"}, R"({"projection": {"fovY": 50}})");
  check(base, {"projection.fovX=50", "--fov-y 70"}, R"({"projection": {"fovY": null, "fovX": 50}})");
  check(base, {"projection.height=4", "projection.type=perspective", "projection.fovX=40"},
        R"({"projection": {"fovY": null, "fovX": 40}})");
  check(pinhole, {"projection.type=perspective", "--fov-y 60"}, R"({"projection": {"type": "perspective", "fovY": 60,
    "fx": null, "fy": null, "cx": null, "cy": null, "pixels": null}})");
  // The short forms of options.
  check(base, {"position=7,2,5", "name=5", "viewport.origin=bottom-left", "projection.far=inf"},
        R"({"position": [7, 2, 5], "name": "5", "viewport": {"origin": "bottom-left"}, "projection": {"far": "inf"}})");
  check(base, {"euler=YXZ:1,2,3"}, R"({"target": null, "euler": {"order": "YXZ", "degrees": [1, 2, 3]}})");
  check(
      base, {"worldFromCamera.rotation=[0,0,0,1]", "worldFromCamera.translation=1,2,3"},
      R"({"position": null, "target": null, "worldFromCamera": {"rotation": [0, 0, 0, 1], "translation": [1, 2, 3]}})");
  check(base, {"--ortho-height 4"}, R"({"projection": {"type": "orthographic", "fovY": null, "height": 4}})");
  check(pinhole, {"--fov-y 60"}, R"({"projection": {"type": "perspective", "fovY": 60, "fx": null, "fy": null,
    "cx": null, "cy": null, "pixels": null}})");
  check(matrixPose, {"--position 1,2,3"}, R"({"position": [1, 2, 3]})");
  check(matrixPose, {"--target 0,0,0"}, R"({"worldFromCamera": null, "position": [9, 8, 7], "target": [0, 0, 0]})");
}

TEST_CASE("A refusal of each kind") {
  const auto check = [](const char* members, const Patches& patches, const char* expected) {
    INFO(members);
    CHECK(message(with(members), patches) == expected);
  };
  const auto of = [&](const char* members, const char* expected) { check(members, {}, expected); };
  of(R"({"projection": {"fovy": 60}})", "C: projection.fovy: is not known; did you mean 'fovY'?");
  of(R"({"position": null, "target": null, "worldFromCamera": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 2, 3, 1]})",
     "C: worldFromCamera: expected 4 rows of 4 numbers, as in [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, "
     "1]]");
  of(R"({"eye": [1, 2, 3]})", "C: eye: is another name of position, which is there too; keep one");
  of(R"({"projection": {"fov": 60}})",
     "C: projection.fov: does not say which angle: fovY is from bottom to top (OpenGL, Direct3D, Unity, three.js), "
     "fovX from left to right (Unreal) (is 60)");
  of(R"({"rotation": [0, 0, 0, 1]})", "C: target and rotation both orient the camera; keep one");
  of(R"({"projection": {"left": 1}})", "C: projection.left: is not a field of the type perspective (is 1)");
  of(R"({"target": null})", "C: position: needs a target, direction, rotation, euler or heading beside it");
  of(R"({"viewport": {"width": null}})", "C: viewport: needs width; --viewport WIDTHxHEIGHT gives it");
  of(R"({"position": [1, 2]})", "C: position: expected x, y, z, or lat, lon, height");
  of(R"({"up": [3, 2, 5]})",
     "C: up: is parallel to the viewing direction, so it does not say which way is up; give another");
  of(R"({"projection": {"aspect": "4/3"}})",
     "C: projection.aspect: the aspect is 1.33333, but the viewport's is 1.77778; change it by --aspect "
     "or give --allow-stretch (is '4/3')");
  of(R"({"projection": {"near": 0}})", "C: projection.near: expected a number above 0, got 0");
  of(R"({"projection": {"near": 5, "far": 2}})",
     "C: projection.far: must be greater than near, 5; for reversed depth keep near < far and set reverseZ (is 2)");
  check("{}", {"--fov-y 200"}, "--fov-y: expected an angle between 0 and 180 degrees, got 200");
  check("{}", {"--position lat=x,lon=8,height=0"},
        "--position: lat: expected a number of degrees, \"60deg\" or \"1.0472rad\", got 'x'");
  check("{}", {"--target 0,0,0", "--direction 0,0,1"}, "--target and --direction both orient the camera; keep one");
  check("{}", {"--fov-y 60", "--ortho-height 5"}, "--fov-y and --ortho-height both say what the camera sees; keep one");
  of(R"({"from": [1, 2, 3]})", "C: from: is not known; did you mean 'position'?");
  of(R"({"world": "enu", "position": {"lat": 1, "lon": 2, "height": 3}})",
     "C: position: is a place on the Earth; in the world \"enu\" expected [x, y, z]: east, north, up");
  of(R"({"world": "enu", "convention": "d3d"})",
     "C: the convention's world is left-handed, but east, north and up are right-handed; --convention says how to "
     "write");
  check("{}", {"projection.fvY=null"}, "--set projection.fvY: is not known; did you mean 'projection.fovY'?");
  check("{}", {R"(viewport={"width": "x"})"}, "--set viewport: width: expected a number, got 'x'");
  check(
      R"({"position": null, "target": null, "cameraFromWorld": [[1, 0, 0, 9], [0, 1, 0, 8], [0, 0, 1, 7]], "convention": "opngl"})",
      {"--target 0,0,0"}, "C: convention.preset: is not known; did you mean 'opengl'? (is 'opngl')");
}

TEST_CASE("What came from the command line and is wrong is a usage error, what the file holds is not") {
  const auto isUsage = [](const std::string& document, const Patches& patches) {
    try {
      (void)cameraOf(document, patches);
    } catch (const UsageError&) {
      return true;
    } catch (const InputError&) {
      return false;
    }
    FAIL("it is read");
    return false;
  };
  const std::string base = with("{}");
  CHECK(isUsage(base, {"projection.fovY=abc"}));
  CHECK(isUsage(base, {"projection.near=5", "projection.far=2"}));
  CHECK(isUsage(base, {"projection.focalLength=35"}));
  CHECK(isUsage(base, {"target=3,2,5"}));
  CHECK(isUsage(base, {"bogus=1"}));
  CHECK(isUsage("{}", {"--fov-y 60", "--near 3", "--far 2", "viewport.width=2", "viewport.height=2"}));
  CHECK_FALSE(isUsage(with(R"({"projection": {"far": 0.01}})"), {"projection.fovY=50"}));
  CHECK_FALSE(isUsage(with(R"({"fov": 3})"), {"projection.fovY=50"}));
}

TEST_CASE("A set has the cameras of its list, each laid over the members that they share") {
  const std::string text = R"({"convention": "opencv", "target": [0, 0, 0], "projection": {"near": 0.1},
    "viewport": {"width": 200, "height": 100}, "cameras": [
      {"name": "left", "eye": [1, 0, 5], "projection": {"type": "perspective", "fovY": 90}},
      {"name": "cam/right", "position": [2, 0, 5], "rotation": [0, 0, 0, 1],
       "projection": {"type": "intrinsics", "fx": 50, "fy": 60, "cx": 100, "cy": 50}, "viewport": {"pixelCenter": 0.5}},
      {"name": "cam/top", "position": [2, 0, 5], "target": null, "projection": {"type": "perspective", "fovY": 90}}]})";
  CameraPatches patches;
  patches.patches = {setPatch("projection.near=0.25")};
  const auto set = openCameras(text, {.option = "C"}, patches);
  REQUIRE(set->size() == 3);
  CHECK(set->choose("left") == 0);
  CHECK(set->choose("1") == 1);
  CHECK(set->chooseAll("cam/*") == std::vector<std::size_t>{1, 2});
  CHECK(set->chooseAll(std::nullopt).size() == 3);
  CHECK(set->find("cam/right") == std::size_t{1});
  CHECK(set->find("2") == std::size_t{2});
  CHECK_FALSE(set->find("middle"));
  const auto cameraOf = [&](std::size_t which) { return makeCamera(readCamera(set->document(which), {})); };
  const Camera left = cameraOf(0);
  CHECK(left.pose().eye() == Vec3{1, 0, 5});
  CHECK(left.intrinsics().fy == Approx(50));
  CHECK(left.projection().zNear() == 0.25);
  const Camera right = cameraOf(1);
  CHECK(right.pose().forward() == Vec3{0, 0, 1});  // the rotation displaces the target
  CHECK(right.intrinsics().fy == 60);
  CHECK(right.viewport().pixelCenter == 0.5);
  CHECK_THROWS_AS(cameraOf(2), InputError);  // its target is taken away
  const auto fault = [](const std::string& document) -> std::string {
    try {
      const auto bad = openCameras(document, {.option = "C"}, {});
      (void)bad->document(bad->size() - 1);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  CHECK(fault(R"({"target": [0, 0, 0], "cameras": []})") == "C: holds no camera");
  CHECK(fault(R"({"cameras": [{"position": [0, 0, 0]}, {"cameras": []}]})") ==
        "C: cameras.1: cameras: is inside a camera");
  CHECK(fault(R"({"cameras": 5, "target": [0, 0, 0]})") == "");
  CHECK(fault(R"({"cameras": [{"K": 1}]})").starts_with("C: is not a camera file of a known kind"));
}
