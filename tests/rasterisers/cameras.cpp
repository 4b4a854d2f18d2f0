#include "cameras.hpp"

#include <iterator>

namespace rasterisers {
namespace {

struct Base {
  const char* camera;
  bool relativeToEye;
};

// As small as shows every way to describe a camera. Those on the Earth and in large numbers are drawn relative to the
// eye.
constexpr Base kBases[] = {
    {R"({"convention": "d3d", "position": [-2, 3, -4], "target": [1, 0.5, 2],
         "projection": {"type": "perspective", "fovX": 75, "near": 1, "far": 60},
         "viewport": {"width": 317, "height": 201, "x": 7, "y": 5}})",
     false},
    {R"({"convention": "d3d-rh", "position": [0.5, 1, 2], "direction": [1, -0.25, -2],
         "projection": {"type": "frustum", "left": -0.3, "right": 0.5, "bottom": -0.2, "top": 0.25, "near": 0.5, "far": 50},
         "viewport": {"width": 320, "height": 180}})",
     false},
    {R"({"convention": "metal", "position": [4, 1, 0], "target": [0, 2, 1],
         "projection": {"type": "perspective", "fovY": 45, "near": 1, "far": 200, "shift": [0.25, -0.5]},
         "viewport": {"width": 256, "height": 256, "origin": "bottom-left", "x": 3, "y": 9}})",
     false},
    {R"({"convention": "vulkan", "position": [1, 0.5, -1], "target": [3, 1, 4],
         "projection": {"type": "perspective", "fovY": 40, "near": 2, "far": 90},
         "viewport": {"width": 960, "height": 540, "crop": {"x": 600, "y": 90, "width": 200, "height": 160}}})",
     false},
    {R"({"convention": "opengl", "position": [2, 3, 4], "target": [0, 0, 1],
         "projection": {"type": "orthographic", "left": -6, "right": 10, "bottom": -5, "top": 3, "near": -5, "far": 20},
         "viewport": {"width": 320, "height": 160}})",
     false},
    {R"({"convention": "d3d", "position": [1, 1, -7], "direction": [1, -1, 3],
         "projection": {"type": "orthographic", "width": 12, "height": 9, "near": 1, "far": 30, "shift": [-0.3, 0.1]},
         "viewport": {"width": 240, "height": 180, "depthRange": [0.1, 0.7]}})",
     false},
    {R"({"convention": "opencv", "cameraFromWorld": [[0.8, 0, -0.6, 0.5], [0, 1, 0, -1], [0.6, 0, 0.8, 2], [0, 0, 0, 1]],
         "projection": {"type": "intrinsics", "fx": 280, "fy": 250, "cx": 148.25, "cy": 131, "near": 0.5, "far": 40},
         "viewport": {"width": 320, "height": 240, "pixelCenter": 0}})",
     false},
    {R"({"convention": "opengl", "position": {"lat": 45.98333, "lon": 7.785, "height": 3185}, "heading": 198, "pitch": -4, "roll": 2,
         "projection": {"type": "perspective", "fovX": 70, "near": 1, "far": 30000},
         "viewport": {"width": 320, "height": 240}})",
     true},
    {R"({"convention": "unreal", "position": [637813700.25, -41231.5, 120000.125], "rotation": [0.1, -0.3, 0.5, 0.8], "cameraAxes": "FRU",
         "projection": {"type": "perspective", "fovX": 90, "near": 10, "far": 500000},
         "viewport": {"width": 320, "height": 180}})",
     true},
    {R"({"convention": "unity", "position": [2, 1, -3], "target": [0, 1, 0],
         "projection": {"type": "perspective", "fovDiagonal": 80, "near": 1, "far": 70},
         "viewport": {"width": 320, "height": 240, "depthRange": [1, 0]}})",
     false},
};
constexpr int kBaseCount = static_cast<int>(std::size(kBases));

constexpr const char* kPresets[] = {"opengl", "opengl-lh", "d3d",    "d3d-rh", "vulkan", "metal",
                                    "webgpu", "unity",     "unreal", "opencv", "ps2"};
constexpr int kPresetCount = static_cast<int>(std::size(kPresets));

}  // namespace

CameraCase cameraCase(int index) {
  // The counts of bases and presets have no common factor, so every pair comes up in time.
  const Base& base = kBases[index % kBaseCount];
  const int round = index / kPresetCount;
  CameraCase c;
  c.index = index;
  c.camera = nlohmann::json::parse(base.camera);
  c.preset = kPresets[index % kPresetCount];
  c.orthographic = c.camera["projection"]["type"] == "orthographic";
  c.reverseZ = round % 2 == 1;
  c.infinite = round / 2 % 2 == 1 && !c.orthographic;
  c.minusOneToOne = index % 9 < 2;
  c.otherWay = index % 7 == 5;
  c.relativeToEye = base.relativeToEye;
  c.product = index % 4 >= 2;
  c.mirrored = (index + round) % 2 == 1;
  constexpr DepthFormat formats[] = {DepthFormat::f32, DepthFormat::d24, DepthFormat::f32, DepthFormat::d16,
                                     DepthFormat::f32};
  c.format = formats[index % 5];
  c.camera["convention"] = {{"preset", c.camera["convention"]}, {"reverseZ", c.reverseZ}};
  if (c.infinite) c.camera["projection"].erase("far");
  return c;
}

std::string CameraCase::name() const {
  const bool writtenReversed = reverseZ != otherWay;
  return "camera " + std::to_string(index) + " as " + preset + (minusOneToOne ? ", -1..1" : "") +
         (writtenReversed ? ", reversed" : "") + (infinite ? ", infinite" : "") + ": " + camera.dump();
}

}  // namespace rasterisers
