// Lenses by the names that other programs give them.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "formats/format.hpp"
#include "formats/words.hpp"

namespace viewproj::cmd {
namespace {

struct LensNames {
  std::string_view model;  ///< in our document; empty: a pinhole if all coefficients are 0, otherwise not supported
  std::string_view words;
  std::string_view order;   ///< of the coefficients
  std::string_view counts;  ///< how many of them make sense
};
/// OpenCV's own list has no name, and 12 or 14 numbers with those of thin prisms and a tilt.
constexpr LensNames kLenses[] = {
    {"brown",
     "plumb_bob rational_polynomial radtan radtan8 pinhole_radtan8 radial_tangential radialtangential brown "
     "brown_conrady opencv full_opencv radial simple_radial perspective rectilinear opencv4 opencv5 opencv8 "
     "pinhole_full standard rational thin_prism tilted",
     "k1 k2 p1 p2 k3 k4 k5 k6", "1 2 4 5 8 12 14"},
    {"fisheye",
     "fisheye equidistant equi kannala_brandt kannala_brandt4 kannala_brandt8 kannalabrandt8 kb4 kb8 opencv_fisheye "
     "simple_fisheye radial_fisheye simple_radial_fisheye",
     "k1 k2 k3 k4", "0 1 2 3 4"},
    {"double-sphere", "ds double_sphere doublesphere", "xi alpha", "2"},
    {"unified", "ucm eucm unified extended_unified", "alpha beta", "1 2"},
    {"omni", "omni mei omnidirectional omni_radtan", "xi k1 k2 p1 p2 k3", "1 3 5 6"},
    {"fov", "fov atan ftheta", "omega", "1"},
    {"", "none pinhole simple_pinhole modified_brown_conrady inverse_brown_conrady", "k1 k2 p1 p2 k3", ""}};

/// "distortion.Inverse Brown Conrady" in the spelling of the table.
std::string spelled(std::string_view name) {
  std::string normalized = lowered(name.substr(name.rfind('.') + 1));
  for (char& c : normalized)
    if (c == ' ' || c == '-') c = '_';
  constexpr std::string_view kFront = "lensmodel_";
  return normalized.starts_with(kFront) ? normalized.substr(kFront.size()) : normalized;
}

/// The row of a model. An empty name is OpenCV's own list.
const LensNames* lensNamed(std::string_view model) {
  const std::string name = spelled(model);
  const auto* const row = std::find_if(std::begin(kLenses), std::end(kLenses),
                                       [&](const LensNames& lens) { return isAmong(name, lens.words); });
  return row != std::end(kLenses) ? row : name.empty() ? std::begin(kLenses) : nullptr;
}

const LensNames& requireLens(const Node& where, std::string_view model) {
  if (const LensNames* const lens = lensNamed(model)) return *lens;
  where.fail("lens model " + std::string(model) + " is not supported");
}

/// The document's lens of coefficients in the order of its row.
Json documentOf(const LensNames& lens, const std::vector<double>& c) {
  Json document{{"model", lens.model}}, k = Json::array(), p = Json::array();
  std::size_t i = 0;
  for (const std::string_view name : wordsIn(lens.order)) {
    if (i == c.size()) break;
    if (name[0] == 'k' || name[0] == 'p')
      (name[0] == 'k' ? k : p).push_back(c[i]);
    else
      document[std::string(name)] = c[i];
    ++i;
  }
  const bool isBareOmni = lens.model == "omni" && areZero(std::span(c).subspan(1));
  if (lens.model == "fisheye" || (!k.empty() && !isBareOmni)) document["k"] = k;
  if (!p.empty() && !isBareOmni) document["p"] = p;
  return document;
}

}  // namespace

bool mayBePinhole(std::string_view model) {
  const LensNames* const lens = lensNamed(model);
  return lens && (lens->model == "brown" || lens->model.empty());
}

void setLens(Json& camera, const Node& where, std::string_view model, std::vector<double> c) {
  const LensNames& lens = requireLens(where, model);
  // RealSense's ftheta without a distortion is a pinhole too.
  if ((mayBePinhole(model) || lens.model == "fov") && areZero(c)) return;
  const std::size_t most = lens.model == "fov" ? 1 : lens.model == "fisheye" ? 4 : c.size();
  while (c.size() > most && c.back() == 0) c.pop_back();
  Json& distortion = camera["distortion"];
  if (lens.model.empty()) {  // its reader refuses it
    distortion = {{"model", spelled(model)}, {"k", c}};
    return;
  }
  const bool isUnclear = model.empty() && c.size() < 4;
  if (isUnclear || !isAmong(std::to_string(c.size()), lens.counts)) {
    if (lens.model == "brown")
      where.fail("expected 4, 5 or 8 coefficients in OpenCV's order, k1, k2, p1, p2, k3 to k6");
    where.fail("expected the coefficients " + std::string(lens.order) + " of " + std::string(lens.model) + ", got " +
               std::to_string(c.size()) + " numbers");
  }
  distortion = c.size() > 8 && !areZero(std::span(c).subspan(8)) ? Json{{"model", "thin prism or tilt"}, {"k", c}}
                                                                 : documentOf(lens, c);
}

void setLens(Json& camera, const Node& where, std::string_view model, const NamedNumbers& named) {
  const auto has = [&](std::string_view name) {
    return std::any_of(named.begin(), named.end(), [&](const auto& each) { return each.first == name; });
  };
  const auto valueOf = [&](std::string_view name) {
    const auto found = std::find_if(named.begin(), named.end(), [&](const auto& each) { return each.first == name; });
    return found == named.end() ? 0 : found->second;
  };
  if (model.empty()) {
    if (valueOf("xi") != 0) model = "omni";
    if (valueOf("k4") != 0 && !has("k5") && !has("p1"))
      where.fail(
          "k1 to k4 may be a fisheye's, or brown's without p1 and p2; add camera_model to the file, \"fisheye\" or "
          "\"brown\"");
  }
  const LensNames& lens = requireLens(where, model);
  for (const auto& [name, value] : named)
    if (value != 0 && name != "rpmax" && !isAmong(name, lens.order))
      where.fail(model.empty() ? name + " is of a lens whose model the file does not name; add camera_model"
                               : name + " does not belong to a lens of the model " + std::string(model));
  std::vector<double> c;
  for (const std::string_view name : wordsIn(lens.order)) c.push_back(valueOf(name));
  if (lens.model == "unified" && !has("beta")) c.pop_back();
  if (lens.model == "brown" && areZero(std::span(c).subspan(5))) c.resize(5);
  setLens(camera, where, model, c);
  if (const double radius = valueOf("rpmax"); lens.model == "brown" && radius > 0 && camera.contains("distortion"))
    camera["distortion"]["limit"] = {{"radius", radius}};
}

}  // namespace viewproj::cmd
