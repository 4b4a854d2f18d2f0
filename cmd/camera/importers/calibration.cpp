#include "camera/importers/calibration.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "text/number.hpp"

namespace viewproj::cmd {

bool holds(const Json& object, Names members, std::size_t count) {
  static const Document kNone;
  return object.is_object() && std::any_of(members.begin(), members.end(), [&](std::string_view name) {
           const auto member = object.find(name);
           return member != object.end() && Node(kNone, *member, "").holdsNumbers(count);
         });
}

bool holdsCameras(const Json& root, bool (*isCamera)(const Json&)) {
  return isCamera(root) || (root.is_object() && std::any_of(root.begin(), root.end(), isCamera));
}

Import openCameras(const Node& root, bool (*isCamera)(const Json&), Json (*document)(const Node&)) {
  if (isCamera(root.json())) return {std::vector<CameraEntry>(1), [=](std::size_t) { return document(root); }};
  std::vector<CameraEntry> cameras;
  for (const auto& [name, member] : root.json().items())
    if (isCamera(member)) cameras.push_back({name, ""});
  return {cameras, [=](std::size_t which) { return document(root.require(cameras[which].name)); }};
}

std::optional<Node> oneOf(const Node& object, Names names) {
  std::optional<Node> found;
  for (const std::string_view name : names) {
    const auto member = object.find(name);
    if (found && member && found->json() != member->json())
      member->fail("differs from " + found->path() + ", another name of it");
    if (!found) found = member;
  }
  return found;
}

std::vector<double> matrixOf(const Node& node, std::size_t rows, std::size_t columns) {
  const std::vector<double> numbers = node.numbers(rows * columns);
  const Json& value = node.json();
  double height = 1, width = 1;
  if (value.is_array() && value.front().is_array()) {
    height = static_cast<double>(value.size());
    width = static_cast<double>(value.front().size());
  } else if (value.is_object()) {
    if (const auto declared = node.find("rows")) height = declared->number();
    if (const auto declared = node.find("cols")) width = declared->number();
  }
  if (height != 1 && width != 1 && (height != static_cast<double>(rows) || width != static_cast<double>(columns)))
    node.fail("expected " + std::to_string(rows) + " x " + std::to_string(columns) + " numbers, got " +
              formatNumber(height) + " x " + formatNumber(width));
  return numbers;
}

std::optional<Size> sizeOf(const Node& object, Names width, Names height) {
  const auto w = oneOf(object, width), h = oneOf(object, height);
  if (!w && !h) return std::nullopt;
  if (!w || !h) object.fail("needs both " + std::string(*width.begin()) + " and " + std::string(*height.begin()));
  return Size{w->number(), h->number()};
}

Json pinholeCamera(std::span<const double> intrinsics, const std::optional<Size>& size) {
  Json camera{{"convention", "opencv"},
              {"position", {0, 0, 0}},
              {"rotation", {0, 0, 0, 1}},
              {"projection",
               {{"type", "intrinsics"},
                {"fx", intrinsics[0]},
                {"fy", intrinsics[1]},
                {"cx", intrinsics[2]},
                {"cy", intrinsics[3]}}}};
  if (size) {
    camera["projection"]["pixels"] = *size;
    camera["viewport"] = {{"width", size->front()}, {"height", size->back()}};
  }
  return camera;
}

std::array<double, 4> intrinsicsOf(const Node& k, std::span<const double> m) {
  if (m[6] != 0 || m[7] != 0 || m[8] != 1)
    k.fail(std::string("the last row is not 0 0 1") +
           (m[2] == 0 && m[5] == 0 && m[8] == 1 ? "; transpose the matrix" : ""));
  if (m[1] != 0 || m[3] != 0)
    k.fail("has a skew of " + formatNumber(m[1] != 0 ? m[1] : m[3]) + "; pixels of a skewed grid are not supported");
  return {m[0], m[4], m[2], m[5]};
}

void setPose(Json& camera, std::string_view field, Json pose) {
  camera.erase("position");
  camera.erase("rotation");
  camera[field] = std::move(pose);
}

void setDistortion(Json& camera, const std::optional<Node>& coefficients, const std::optional<Node>& model) {
  const std::string name = model ? model->text() : "";
  if (!coefficients) {
    if (!mayBePinhole(name)) model->fail("needs the coefficients of this lens");
    return;
  }
  if (Json distortion = distortionOf(*coefficients, name); !distortion.is_null())
    camera["distortion"] = std::move(distortion);
}

}  // namespace viewproj::cmd
