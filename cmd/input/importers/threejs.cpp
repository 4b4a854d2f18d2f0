// three.js cameras as Object3D.toJSON writes them, alone or in a scene. Formulas: updateProjectionMatrix of
// PerspectiveCamera and OrthographicCamera, three.js r187; matrixWorldInverse there leaves scales out too.
#include <nlohmann/json.hpp>

#include "camera/camera.hpp"
#include "input/importers/importer.hpp"
#include "input/placement.hpp"
#include "numbers/degrees.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

constexpr std::string_view kPerspective = "PerspectiveCamera", kOrthographic = "OrthographicCamera";

bool isObject3D(const nlohmann::json& file) {
  const auto object = file.is_object() ? file.find("object") : file.end();
  if (object == file.end() || !object->is_object()) return false;
  const auto type = object->find("type");
  return type != object->end() && type->is_string();
}

/// Where the editor's app.json has files of their own.
constexpr const char* kParts[] = {"camera", "scene"};

bool isApp(const nlohmann::json& root) {
  const auto camera = root.find(kParts[0]);
  return camera != root.end() && isObject3D(*camera);
}

bool recognises(const nlohmann::json& root) { return isObject3D(root) || isApp(root); }

/// A camera and what it hangs from, outermost first.
using Branch = std::vector<ObjectReader>;

/// Calls visit with the branch of each camera of the file.
template <class Visit>
void eachCamera(Branch& branch, const Visit& visit) {
  const std::string_view type = branch.back().text("type").value_or("");
  if (type == kPerspective || type == kOrthographic) visit(branch);
  for (const ObjectReader& child : branch.back().objects("children")) {
    branch.push_back(child);
    eachCamera(branch, visit);
    branch.pop_back();
  }
}

template <class Visit>
void eachCamera(const Document& document, const Visit& visit) {
  const ObjectReader root(document, document.root(), {});
  const auto eachOf = [&](const ObjectReader& file) {
    Branch branch{*file.object("object")};
    eachCamera(branch, visit);
  };
  if (isObject3D(document.root())) return eachOf(root);
  for (const char* const part : kParts)
    if (const nlohmann::json* const file = root.find(part); file && isObject3D(*file)) eachOf(*root.object(part));
}

std::vector<HeldCamera> list(const Document& document) {
  std::vector<HeldCamera> result;
  eachCamera(document, [&](const Branch& branch) {
    const ObjectReader& camera = branch.back();
    const bool perspective = camera.text("type") == kPerspective;
    HeldCamera held{camera.text("name").value_or(""),
                    "",
                    std::to_string(result.size()),
                    camera.text("uuid").value_or(""),
                    perspective ? "perspective" : "orthographic",
                    ""};
    held.note = perspective ? shortNumbers(camera, {"fov", "aspect", "zoom", "near", "far"})
                            : shortNumbers(camera, {"left", "right", "top", "bottom", "zoom", "near", "far"});
    if (!held.note.empty()) held.note.erase(0, 2);
    result.push_back(held);
  });
  if (result.empty())
    document.fail(isApp(document.root()) ? Path{} : Path{"object"},
                  "has no PerspectiveCamera and no OrthographicCamera");
  return result;
}

PlacedNode placed(const ObjectReader& object) {
  PlacedNode node{object, readColumnMajor(object, "matrix"), {}, {}, {}};
  if (node.matrix) return node;
  if (object.has("rotation")) object.fail("rotation", "is not read: a matrix or a quaternion is expected");
  node.translation = object.vec3("position");
  node.scale = object.vec3("scale");
  if (const auto q = object.numbers("quaternion", 4, 4)) node.rotation = Quaternion{(*q)[0], (*q)[1], (*q)[2], (*q)[3]};
  return node;
}

/// A tile of a larger picture.
struct View {
  double fullWidth, fullHeight, offsetX, offsetY, width, height;
};

std::optional<View> readView(const ObjectReader& camera) {
  // As three.js has it: a view that does not say so is not enabled.
  const auto view = camera.object("view");
  if (!view || !view->flag("enabled").value_or(false)) return std::nullopt;
  const auto positive = [&](const char* key) {
    const double number = view->requireNumber(key);
    if (!(number > 0)) view->fail(key, "must be above 0");
    return number;
  };
  return View{positive("fullWidth"),        positive("fullHeight"), view->numberOr("offsetX", 0),
              view->numberOr("offsetY", 0), positive("width"),      positive("height")};
}

double readZoom(const ObjectReader& camera) {
  const double zoom = camera.numberOr("zoom", 1);
  if (!(zoom > 0)) camera.fail("zoom", "must be above 0");
  return zoom;
}

/// Infinity is null in JSON.
double readFar(const ObjectReader& camera) {
  if (!camera.json().contains("far")) camera.fail("needs far; null is infinite");
  return camera.number("far").value_or(kInfiniteFar);
}

/// The window of the whole picture to that of the view.
struct Window {
  DoubleDouble left, right, bottom, top;

  /// By its middle, which stays exactly where it is for a part in the middle.
  Window part(const View& view) const {
    const DoubleDouble x = (right - left) / DoubleDouble(2 * view.fullWidth);
    const DoubleDouble y = (top - bottom) / DoubleDouble(2 * view.fullHeight);
    const auto off = [](double offset, double size, double full) {
      return twoSum(offset, offset) + DoubleDouble(size) - DoubleDouble(full);
    };
    const DoubleDouble across = timesPowerOfTwo(left + right, 0.5) + x * off(view.offsetX, view.width, view.fullWidth);
    const DoubleDouble up = timesPowerOfTwo(bottom + top, 0.5) - y * off(view.offsetY, view.height, view.fullHeight);
    const DoubleDouble halfWidth = x * DoubleDouble(view.width), halfHeight = y * DoubleDouble(view.height);
    return {across - halfWidth, across + halfWidth, up - halfHeight, up + halfHeight};
  }
  DoubleDouble aspect() const { return (right - left) / (top - bottom); }
};

Window perspectiveOf(const ObjectReader& camera, const std::optional<View>& view,
                     const std::optional<ReadViewport>& viewport, const CameraReading& reading) {
  const auto ownAspect = camera.number("aspect"), wanted = ownAspect ? ownAspect : reading.aspect;
  if (ownAspect && !(*ownAspect > 0)) camera.fail("aspect", "must be above 0");
  if (!wanted && !viewport) camera.fail("has no aspect and needs a viewport; --viewport WIDTHxHEIGHT gives one");
  const DoubleDouble tangent = tanHalfDegrees(camera.requireNumber("fov"));
  if (!(tangent.hi > 0)) camera.fail("fov", "must be an angle between 0 and 180 degrees");
  const DoubleDouble aspect =
      wanted ? DoubleDouble(*wanted) : DoubleDouble(viewport->frame.width) / DoubleDouble(viewport->frame.height);
  const DoubleDouble height = tangent / DoubleDouble(readZoom(camera)), width = height * aspect;
  Window window{-width, width, -height, height};
  if (view) window = window.part(*view);
  if (const double offset = camera.numberOr("filmOffset", 0); offset != 0) {
    // In millimetres, as the film's width is: the gauge, or in a portrait format the part that is used.
    const double gauge = camera.numberOr("filmGauge", 35);
    if (!(gauge > 0)) camera.fail("filmGauge", "must be above 0");
    const DoubleDouble film = DoubleDouble(gauge) * (aspect.hi < 1 ? aspect : DoubleDouble(1));
    const DoubleDouble shift = DoubleDouble(offset) / film;
    window.left += shift;
    window.right += shift;
  }
  return window;
}

Window orthographicOf(const ObjectReader& camera, const std::optional<View>& view) {
  const double left = camera.requireNumber("left"), right = camera.requireNumber("right");
  const double top = camera.requireNumber("top"), bottom = camera.requireNumber("bottom");
  if (!(right > left)) camera.fail("right", "must be greater than left");
  if (!(top > bottom)) camera.fail("top", "must be greater than bottom");
  const DoubleDouble zoom = readZoom(camera);
  const DoubleDouble halfWidth = timesPowerOfTwo(twoDiff(right, left), 0.5) / zoom;
  const DoubleDouble halfHeight = timesPowerOfTwo(twoDiff(top, bottom), 0.5) / zoom;
  const DoubleDouble x = timesPowerOfTwo(twoSum(left, right), 0.5), y = timesPowerOfTwo(twoSum(bottom, top), 0.5);
  const Window window{x - halfWidth, x + halfWidth, y - halfHeight, y + halfHeight};
  return view ? window.part(*view) : window;
}

/// The objects on the way to a camera, whose paths are two steps apart: "children" and a number.
Branch branchTo(const Document& document, const Path& camera, std::size_t outermost) {
  Branch branch;
  const nlohmann::json* at = &document.root();
  for (std::size_t i = 0; i < camera.size(); ++i) {
    at = at->is_array() ? &(*at)[std::stoul(camera[i])] : &at->at(camera[i]);
    if (i + 1 >= outermost && (i + 1 - outermost) % 2 == 0)
      branch.emplace_back(document, *at, Path(camera.begin(), camera.begin() + static_cast<std::ptrdiff_t>(i) + 1));
  }
  return branch;
}

CameraFile read(const Branch& branch, const CameraReading& reading) {
  const Document& document = branch.front().document();
  const ObjectReader& camera = branch.back();
  const bool perspective = *camera.string("type") == kPerspective;
  const auto view = readView(camera);
  const auto viewport = importedViewport(
      document, view ? ViewportDefaults{.width = view->width, .height = view->height} : ViewportDefaults{});
  const Window window = perspective ? perspectiveOf(camera, view, viewport, reading) : orthographicOf(camera, view);
  const double near = camera.requireNumber("near"), far = readFar(camera);
  const Projection projection = located(camera, {{"near", "near"}, {"far", "far"}}, [&] {
    return perspective ? perspectiveWindow(window.left, window.right, window.bottom, window.top, near, far)
                       : orthographic(window.left, window.right, window.bottom, window.top, near, far);
  });
  if (viewport && !reading.allowStretch)
    requireShape(window.aspect(), viewport->frame, camera,
                 perspective ? "take the viewport's with --set " + dotted(camera.path()) + ".aspect=null, " : "");
  std::vector<PlacedNode> chain;
  for (const ObjectReader& object : branch) chain.push_back(placed(object));
  CameraFile file = imported(document, *conventionPreset("opengl"), poseAtEndOf(chain), projection, viewport);
  file.tookAspect = perspective && reading.aspect && !camera.number("aspect");
  return file;
}

CameraReader open(const Document& document) {
  struct Place {
    Path path;
    std::size_t outermost;
  };
  std::vector<Place> places;
  eachCamera(document, [&](const Branch& each) { places.push_back({each.back().path(), each.front().path().size()}); });
  return [&document, places = std::move(places)](std::size_t which, const CameraReading& reading) {
    return read(branchTo(document, places[which].path, places[which].outermost), reading);
  };
}

}  // namespace

const Importer kThreeJs{"threejs", "a three.js file", recognises, list, open};

}  // namespace viewproj::cmd
