// Cameras: every form of file, with patches and a pick behind it. What was read is used and written, and what was
// written is read again.
#include <algorithm>
#include <cmath>

#include "camera/write_camera.hpp"
#include "formats/open.hpp"
#include "fuzz.hpp"
#include "output/matrix_text.hpp"
#include "targets.hpp"
#include "text/error.hpp"
#include "viewproj/matrices.hpp"
#include "viewproj/screen.hpp"

namespace viewproj::fuzz {

namespace {

using namespace cmd;

/// A point in front of the camera, and back.
void project(const Camera& camera) {
  const double near = camera.projection().zNear();
  const double distance = near > 0 ? 2 * near : hasDepth(camera.projection()) ? near : 1;
  const Vec3 eye = camera.pose().eye(), forward = camera.pose().forward();
  const Vec3 ahead{eye.x + distance * forward.x, eye.y + distance * forward.y, eye.z + distance * forward.z};
  const ScreenPoint p = worldToScreen(camera, ahead);
  if (!p.visible()) return;
  const Viewport& v = camera.viewport();
  const bool inside = p.x >= v.x && p.x <= v.x + v.width && p.y >= v.y && p.y <= v.y + v.height;
  if (!inside && v.pixelCenter == 0.5) found("a visible point lies outside of the picture");
  const Ray ray = screenToRay(camera, {p.x, p.y});
  const double length = std::hypot(ray.direction.x, ray.direction.y, ray.direction.z);
  if (std::isfinite(length) && !(std::fabs(length - 1) < 1e-12)) found("a ray's direction is not of unit length");
}

void writeAll(const CameraFile& file) {
  MatrixSet set;
  set.convention = file.convention;
  const Convention& c = file.convention;
  const Camera camera = cameraIn(c, file.pose, file.projection, file.viewport);
  const auto add = [&](const char* name, Space to, Space from) {
    set.matrices.push_back({name, matrix(camera, to, from)});
  };
  if (file.pose) {
    set.eye = file.pose->eye();
    add("view", Space::view, Space::world);
    add("viewInverse", Space::world, Space::view);
  }
  const bool hasClip = file.projection && hasDepth(*file.projection);
  if (hasClip) {
    add("projection", Space::clip, Space::view);
    add("projectionInverse", Space::view, Space::clip);
  }
  if (hasClip && file.viewport) add("baked", Space::screen, Space::view);
  if (file.viewport) add("viewport", Space::screen, Space::ndc);
  if (set.matrices.empty()) return;
  requireJson(writeMatrices(set, "json", "the fuzzer"), "matrix");
  requireJson(writeMatrices(set, "flat", "the fuzzer"), "matrix --to flat");
}

/// As `convert --to camera` does, and the file that it writes read as any other.
void writeAndReadAgain(const CameraFile& file) {
  const std::string written = writeCamera(file, *file.preset, file.convention);
  requireJson(written, "convert --to camera");
  try {
    const CameraFile again = readCamera(load(written, "the file written"), file.reading);
    if (file.pose.has_value() != again.pose.has_value() ||
        file.projection.has_value() != again.projection.has_value() ||
        file.viewport.has_value() != again.viewport.has_value())
      found("a camera that was written has other parts when it is read: " + written);
    const auto sameEye = [](const Vec3& a, const Vec3& b) { return a.x == b.x && a.y == b.y && a.z == b.z; };
    if (file.pose && !(sameEye(file.pose->eye(), again.pose->eye()) && sameEye(file.pose->up(), again.pose->up())))
      found("a camera that was written stands elsewhere when it is read: " + written);
    if (file.projection &&
        (file.projection->left() != again.projection->left() || file.projection->top() != again.projection->top()))
      found("a camera that was written sees something else when it is read: " + written);
  } catch (const InputError& e) {
    found(std::string("a camera that was written cannot be read: ") + e.what() + ": " + written);
  }
}

/// "#NAME" picks a camera, "--fov-x 60" is an option, and "projection.near=1" of --set. Between NULs, after the file.
void readAndUse(std::string_view input) {
  const bool isGlb = input.starts_with("glTF");
  const std::size_t end = isGlb ? input.size() : std::min(input.find('\0'), input.size());
  giveInput(input.substr(0, end));
  std::optional<std::string> pick;
  CameraPatches patches;
  for (std::size_t at = end; at < input.size();) {
    const std::size_t next = std::min(input.find('\0', at + 1), input.size());
    const std::string part(input.substr(at + 1, next - at - 1));
    const std::size_t blank = std::min(part.find(' '), part.size());
    if (part.starts_with('#')) pick = part.substr(1);
    if (part.starts_with('-'))
      for (const Field& field : kFields)
        if (!field.option.empty() && part.substr(0, blank) == field.option && blank < part.size())
          patches.patches.push_back(optionPatch(field, part.substr(blank + 1)));
    if (part.find('=') < blank) patches.patches.push_back(setPatch(part));
    at = next;
  }
  requireConsistent(patches.patches);
  const auto cameras = openCameras("-", {.option = "--camera", .pick = pick}, patches);
  for (std::size_t i = 0; i < std::min<std::size_t>(cameras->size(), 8); ++i)
    if (cameras->choose(cameras->pickOf(i)) != i) found("a camera's pick picks another");
  const Document document = cameras->document(cameras->choose(pick));
  const CameraFile file = readCamera(document, {.allowStretch = true, .ignoreDistortion = true});
  writeAll(file);
  writeAndReadAgain(file);
  project(makeCamera(file));
}

}  // namespace

void fuzzCamera(std::string_view input) { succeeds(readAndUse, input); }

}  // namespace viewproj::fuzz
