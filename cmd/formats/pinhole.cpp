// What many formats have in common: a K, a 3x4 matrix, numbers that are texts.
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "camera/fields.hpp"
#include "camera/split_matrix.hpp"
#include "formats/format.hpp"
#include "formats/value.hpp"
#include "text/number.hpp"
#include "viewproj/camera.hpp"

namespace viewproj::cmd {

using namespace detail;

std::array<double, 4> intrinsicsOf(const Node& k, std::span<const double> m) {
  const std::size_t columns = m.size() == 9 ? 3 : 4;
  const auto at = [&](std::size_t i, std::size_t j) { return m[i * columns + j]; };
  const bool isByColumns = at(0, 2) == 0 && at(1, 2) == 0 && at(2, 2) == 1;
  if (at(2, 0) != 0 || at(2, 1) != 0 || at(2, 2) != 1)
    k.fail(std::string("the last row is not 0 0 1") + (isByColumns ? "; transpose the matrix" : ""));
  if (at(0, 1) != 0 || at(1, 0) != 0)
    k.fail("has a skew of " + formatNumber(at(0, 1) != 0 ? at(0, 1) : at(1, 0)) +
           "; pixels of a skewed grid are not supported; --parts 'K=" + k.path() +
           (columns == 3 ? "[0,4,2,5]" : "[0,5,2,6]") + ", …' leaves it out");
  if (columns == 4 && (at(0, 3) != 0 || at(1, 3) != 0 || at(2, 3) != 0))
    k.fail("has a fourth column that is not 0 0 0");
  if (m.size() == 16 && (at(3, 0) != 0 || at(3, 1) != 0 || at(3, 2) != 0 || at(3, 3) != 1))
    k.fail("the last row is not 0 0 0 1");
  return {at(0, 0), at(1, 1), at(0, 2), at(1, 2)};
}

double fovOfEquivalent(double focalLength) {
  return 2 * std::atan2(kFilmDiagonal / 2, focalLength) * (180 / std::numbers::pi);
}

Json pinholeCamera(std::span<const double> intrinsics, const PictureSize& size, double pixelCenter) {
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
  if (pixelCenter != 0) camera["viewport"]["pixelCenter"] = pixelCenter;
  return camera;
}

void setPose(Json& camera, std::string_view field, Json pose) {
  camera.erase("position");
  camera.erase("rotation");
  camera[field] = std::move(pose);
}

Json rowsOf(std::span<const double> numbers, std::size_t columns) {
  Json rows = Json::array();
  for (std::size_t i = 0; i + columns <= numbers.size(); i += columns)
    rows.push_back(std::vector<double>(numbers.begin() + static_cast<std::ptrdiff_t>(i),
                                       numbers.begin() + static_cast<std::ptrdiff_t>(i + columns)));
  return rows;
}

Json cameraOfMatrix(const Node& node, std::span<const double> p, const PictureSize& size) {
  try {
    const SplitMatrix split = splitMatrix(p);
    requireNoSkew(split);
    const double intrinsics[] = {rounded(split.fx), rounded(split.fy), rounded(split.cx), rounded(split.cy)};
    const Vec3 x = rounded(split.columns[0]), y = rounded(split.columns[1]), z = rounded(split.columns[2]),
               eye = rounded(split.eye);
    Json camera = pinholeCamera(intrinsics, size);
    setPose(
        camera, "worldFromCamera",
        {{"rotation", {{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}}}, {"translation", {eye.x, eye.y, eye.z}}});
    return camera;
  } catch (const CameraError& e) {
    node.fail(e.message());
  }
}

Json cameraBehind(const Node& node, std::span<const double> p, const PictureSize& size, Json poses) {
  const std::vector<double> left{p[0], p[1], p[2], p[4], p[5], p[6], p[8], p[9], p[10]};
  const auto [fx, fy, cx, cy] = intrinsicsOf(node, left);
  Json camera = pinholeCamera(std::array{fx, fy, cx, cy}, size);
  // [K | p] = K [I | K^-1 p]
  const DoubleDouble z = p[11], x = (DoubleDouble(p[3]) - DoubleDouble(cx) * z) / DoubleDouble(fx),
                     y = (DoubleDouble(p[7]) - DoubleDouble(cy) * z) / DoubleDouble(fy);
  poses.insert(poses.begin(), Json{{1, 0, 0, rounded(x)}, {0, 1, 0, rounded(y)}, {0, 0, 1, rounded(z)}});
  setPose(camera, "cameraFromWorld", std::move(poses));
  return camera;
}

std::vector<double> numbersOf(const Node& node, std::size_t count) {
  const auto numbers = numbersIn(node.json());
  if (!numbers || (count != 0 && numbers->size() != count))
    node.fail("expected " + (count == 0 ? "numbers" : count == 1 ? "a number" : std::to_string(count) + " numbers"));
  node.mark();
  return *numbers;
}

double numberOf(const Node& node) { return numbersOf(node, 1).front(); }

double numberAt(const Node& node, std::string_view member, double otherwise) {
  const auto found = node.find(member);
  return found ? numberOf(*found) : otherwise;
}

std::string textAt(const Node& node, std::string_view member) {
  const auto found = node.json().is_object() ? node.find(member) : std::nullopt;
  if (!found) return "";
  found->mark();
  const Json& value = contentOf(found->json());
  return value.is_string() ? value.get<std::string>() : value.dump();
}

std::vector<Node> itemsAt(const Node& node, std::string_view member) {
  const auto list = node.json().is_object() ? node.find(member) : std::nullopt;
  if (!list || list->json() == "") return {};  // as boost writes a list of none
  if (!list->json().is_array()) return {*list};
  std::vector<Node> items;
  for (std::size_t i = 0; i < list->size(); ++i) items.push_back((*list)[i]);
  return items;
}

void refuse(const Node& node, std::string_view members, std::string_view why) {
  for (const std::string_view name : wordsIn(members)) {
    const auto member = node.find(name);
    if (!member) continue;
    const Json& value = member->json();
    const bool isNothing = value.is_number()    ? value.get<double>() == 0
                           : value.is_boolean() ? !value.get<bool>()
                           : value.is_string()  ? value.get_ref<const std::string&>().empty()
                                                : value.empty();
    if (!isNothing) member->fail(std::string(why));
    member->mark();
  }
}

}  // namespace viewproj::cmd
