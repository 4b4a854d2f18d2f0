#include "camera/importers/importer.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

namespace viewproj::cmd {

extern const Importer kGltf, kThreeJs, kNerf, kSplats, kOpen3d, kRealSense, kKalibr, kRos, kKitti, kOpenCv,
    kProjectionMatrix;

namespace {

// The order matters: Open3D's and ROS's files have members of OpenCV's calibrations, and these may have a P.
constexpr const Importer* kImporters[] = {&kGltf,      &kThreeJs,          &kNerf,    &kSplats, &kOpen3d,
                                          &kRealSense, &kColmap,           &kKalibr,  &kRos,    &kKitti,
                                          &kOpenCv,    &kProjectionMatrix, &kMatrices};

/// Lens models. The empty name is OpenCV's own list of coefficients, which names no model.
constexpr std::string_view kBrown[] = {"",
                                       "plumb_bob",
                                       "rational_polynomial",
                                       "radtan",
                                       "radial_tangential",
                                       "brown_conrady",
                                       "opencv",
                                       "full_opencv",
                                       "radial",
                                       "simple_radial",
                                       "perspective"};
constexpr std::string_view kFisheye[] = {"fisheye",        "equidistant",     "equi",
                                         "kannala_brandt", "kannala_brandt4", "opencv_fisheye",
                                         "simple_fisheye", "radial_fisheye",  "simple_radial_fisheye"};
constexpr std::string_view kFov[] = {"fov", "ftheta"};
/// Pinholes if all coefficients are 0, otherwise not supported.
constexpr std::string_view kPinhole[] = {"none", "pinhole", "simple_pinhole", "modified_brown_conrady",
                                         "inverse_brown_conrady"};

template <class Range, class Value>
bool contains(const Range& range, const Value& value) {
  return std::find(std::begin(range), std::end(range), value) != std::end(range);
}

/// "distortion.Inverse Brown Conrady" in the spelling of the tables.
std::string normalizedModel(std::string_view name) {
  std::string normalized(name.substr(name.rfind('.') + 1));
  for (char& c : normalized)
    c = c == ' ' || c == '-' ? '_' : c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return normalized;
}

bool areZero(std::span<const double> numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double number) { return number == 0; });
}

}  // namespace

std::span<const Importer* const> importers() { return kImporters; }

void refuse(const Node& node, std::initializer_list<std::string_view> members, std::string_view why) {
  for (const std::string_view name : members) {
    const auto member = node.find(name);
    if (!member) continue;
    const Json& value = member->json();
    const bool isNothing = value.is_number()    ? value.get<double>() == 0
                           : value.is_boolean() ? !value.get<bool>()
                           : value.is_string()  ? value.get_ref<const std::string&>().empty()
                                                : value.empty();
    if (!isNothing) member->fail(std::string(why));
  }
}

bool mayBePinhole(std::string_view model) {
  const std::string name = normalizedModel(model);
  return contains(kBrown, name) || contains(kPinhole, name);
}

Json distortionOf(const Node& coefficients, std::string_view model) {
  const std::string name = normalizedModel(model);
  std::vector<double> c = coefficients.numbers();
  if (contains(kFisheye, name)) {
    while (c.size() > 4 && c.back() == 0) c.pop_back();
    return {{"model", "fisheye"}, {"k", c}};
  }
  if (contains(kFov, name)) {
    if (c.empty() || !areZero(std::span(c).subspan(1))) coefficients.fail("expected one number, omega");
    return c[0] == 0 ? Json() : Json{{"model", "fov"}, {"omega", c[0]}};
  }
  if (!mayBePinhole(model)) coefficients.fail("lens model " + std::string(model) + " is not supported");
  if (areZero(c)) return nullptr;
  if (contains(kPinhole, name)) return {{"model", name}, {"k", c}};
  if (!contains(std::array{4, 5, 8, 12, 14}, std::ssize(c)))
    coefficients.fail("expected 4, 5 or 8 coefficients in OpenCV's order, k1, k2, p1, p2, k3 to k6");
  if (c.size() > 8 && !areZero(std::span(c).subspan(8))) return {{"model", "thin prism or tilt"}, {"k", c}};
  std::vector<double> k(c.begin(), c.begin() + 2);
  k.insert(k.end(), c.begin() + 4, c.begin() + std::min<std::ptrdiff_t>(8, std::ssize(c)));
  return {{"model", "brown"}, {"k", k}, {"p", {c[2], c[3]}}};
}

Json rowsOf(const Mat4& matrix) { return matrix.m; }

}  // namespace viewproj::cmd
