// Lenses by the names that other programs give them.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "formats/format.hpp"
#include "formats/value.hpp"

namespace viewproj::cmd {
namespace {

struct LensNames {
  std::string_view model;  ///< in our document; empty: a pinhole if all coefficients are 0, otherwise not supported
  std::string_view words, order;
};
/// The first words are OpenCV's own list of coefficients, which has no name, and those of its meaning.
constexpr LensNames kLenses[] = {
    {"brown",
     " plumb_bob rational_polynomial radtan radtan8 pinhole_radtan8 radial_tangential radialtangential brown "
     "brown_conrady "
     "opencv full_opencv radial simple_radial perspective rectilinear opencv4 opencv5 opencv8 pinhole_full",
     "k1 k2 p1 p2 k3 k4 k5 k6"},
    {"fisheye",
     "fisheye equidistant equi kannala_brandt kannala_brandt4 kannala_brandt8 kannalabrandt8 kb4 kb8 opencv_fisheye "
     "simple_fisheye radial_fisheye simple_radial_fisheye",
     "k1 k2 k3 k4"},
    {"double-sphere", "ds double_sphere doublesphere", "xi alpha"},
    {"unified", "ucm eucm unified extended_unified", "alpha beta"},
    {"omni", "omni mei omnidirectional omni_radtan", "xi k1 k2 p1 p2 k3"},
    {"fov", "fov atan ftheta", "omega"},
    {"", "none pinhole simple_pinhole modified_brown_conrady inverse_brown_conrady", "k1 k2 p1 p2 k3"}};

/// "distortion.Inverse Brown Conrady" in the spelling of the table.
std::string spelled(std::string_view name) {
  std::string normalized(name.substr(name.rfind('.') + 1));
  for (char& c : normalized)
    c = c == ' ' || c == '-' ? '_' : c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  for (const std::string_view front : {"lensmodel_"})
    if (normalized.starts_with(front)) normalized.erase(0, front.size());
  return normalized;
}

std::vector<std::string_view> listOf(std::string_view text) {
  std::vector<std::string_view> words;
  while (true) {
    const std::size_t end = text.find(' ');
    words.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return words;
    text.remove_prefix(end + 1);
  }
}

const LensNames* lensNamed(std::string_view model) {
  const std::string name = spelled(model);
  for (const LensNames& lens : kLenses) {
    const std::vector<std::string_view> words = listOf(lens.words);
    if (std::find(words.begin(), words.end(), name) != words.end()) return &lens;
  }
  return nullptr;
}

bool areZero(std::span<const double> numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double number) { return number == 0; });
}

/// Whether this many coefficients make sense; the lists of OpenCV have 4, 5, 8, 12 or 14.
bool isCount(const LensNames& lens, std::string_view model, std::size_t count) {
  const auto isOne = [&](std::initializer_list<std::size_t> counts) {
    return std::find(counts.begin(), counts.end(), count) != counts.end();
  };
  if (lens.model == "brown") return isOne({4, 5, 8, 12, 14}) || (!model.empty() && isOne({1, 2}));
  if (lens.model == "fisheye") return count <= 4;
  if (lens.model == "double-sphere") return count == 2;
  if (lens.model == "unified") return isOne({1, 2});
  if (lens.model == "omni") return isOne({1, 3, 5, 6});
  if (lens.model == "fov") return count == 1;
  return true;
}

/// The document's lens of coefficients in the order of its row.
Json documentOf(const LensNames& lens, std::vector<double> c) {
  if (lens.model == "fisheye") return {{"model", lens.model}, {"k", c}};
  if (lens.model == "double-sphere") return {{"model", lens.model}, {"xi", c[0]}, {"alpha", c[1]}};
  if (lens.model == "fov") return {{"model", lens.model}, {"omega", c[0]}};
  if (lens.model == "unified") {
    Json unified{{"model", lens.model}, {"alpha", c[0]}};
    if (c.size() > 1) unified["beta"] = c[1];
    return unified;
  }
  Json document{{"model", lens.model}};
  if (lens.model == "omni") {
    document["xi"] = c[0];
    c.erase(c.begin());
    if (areZero(c)) return document;
  }
  std::vector<double> k(c.begin(), c.begin() + std::min<std::ptrdiff_t>(2, std::ssize(c)));
  k.insert(k.end(), c.begin() + std::min<std::ptrdiff_t>(4, std::ssize(c)),
           c.begin() + std::min<std::ptrdiff_t>(8, std::ssize(c)));
  document["k"] = k;
  if (c.size() > 3) document["p"] = {c[2], c[3]};
  return document;
}

}  // namespace

bool mayBePinhole(std::string_view model) {
  const LensNames* const lens = lensNamed(model);
  return lens && (lens->model == "brown" || lens->model.empty());
}

Json lensOf(const Node& where, std::string_view model, std::vector<double> c) {
  const LensNames* const lens = lensNamed(model);
  if (!lens) where.fail("lens model " + std::string(model) + " is not supported");
  if (mayBePinhole(model) && areZero(c)) return nullptr;
  if (lens->model == "fov" && areZero(c)) return nullptr;  // RealSense's ftheta without a distortion
  if (lens->model == "fov" && c.size() > 1 && areZero(std::span(c).subspan(1))) c.resize(1);
  while (lens->model == "fisheye" && c.size() > 4 && c.back() == 0) c.pop_back();
  if (lens->model.empty()) return {{"model", spelled(model)}, {"k", c}};  // its reader refuses or ignores it
  if (!isCount(*lens, model, c.size())) {
    if (lens->model == "brown")
      where.fail("expected 4, 5 or 8 coefficients in OpenCV's order, k1, k2, p1, p2, k3 to k6");
    where.fail("expected the coefficients " + std::string(lens->order) + " of " + std::string(lens->model) + ", got " +
               std::to_string(c.size()) + " numbers");
  }
  if (c.size() > 8 && !areZero(std::span(c).subspan(8))) return {{"model", "thin prism or tilt"}, {"k", c}};
  return documentOf(*lens, c);
}

Json lensOf(const Node& where, std::string_view model, const std::vector<std::pair<std::string, double>>& named) {
  const auto has = [&](std::string_view name) {
    return std::find_if(named.begin(), named.end(), [&](const auto& each) { return each.first == name; });
  };
  const auto valueOf = [&](std::string_view name) {
    const auto found = has(name);
    return found == named.end() ? 0 : found->second;
  };
  if (model.empty()) {
    if (valueOf("xi") != 0) model = "omni";
    if (valueOf("k4") != 0 && has("k5") == named.end() && has("p1") == named.end())
      where.fail(
          "k1 to k4 may be a fisheye's, or brown's without p1 and p2; add camera_model to the file, \"fisheye\" or "
          "\"brown\"");
  }
  const LensNames* const lens = lensNamed(model);
  if (!lens) where.fail("lens model " + std::string(model) + " is not supported");
  std::vector<double> c;
  for (const std::string_view name : listOf(lens->order)) c.push_back(valueOf(name));
  for (const auto& [name, value] : named) {
    const std::vector<std::string_view> order = listOf(lens->order);
    if (value != 0 && name != "rpmax" && std::find(order.begin(), order.end(), name) == order.end())
      where.fail(model.empty() ? name + " is of a lens whose model the file does not name; add camera_model"
                               : name + " does not belong to a lens of the model " + std::string(model));
  }
  if (mayBePinhole(model) && areZero(c)) return nullptr;
  if (lens->model == "unified" && has("beta") == named.end()) c.pop_back();
  const bool hasRational = valueOf("k4") != 0 || valueOf("k5") != 0 || valueOf("k6") != 0;
  if (lens->model == "brown" && !hasRational) c.resize(5);
  if (lens->model.empty()) return {{"model", spelled(model)}, {"k", c}};
  Json document = documentOf(*lens, c);
  if (const double radius = valueOf("rpmax"); lens->model == "brown" && radius > 0)
    document["limit"] = {{"radius", radius}};
  return document;
}

}  // namespace viewproj::cmd
