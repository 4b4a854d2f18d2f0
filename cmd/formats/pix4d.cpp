// The lens of a Pix4D project, *_calibrated_internal_camera_parameters.cam: in millimetres of a sensor that a comment
// tells, without the picture's size. Its poses are a row.
#include <nlohmann/json.hpp>

#include "formats/format.hpp"
#include "text/names.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {
namespace pix4d {

/// "12.8x8.5" of "Focal Length mm assuming a sensor width of 12.8x8.5mm".
std::array<double, 2> sensorOf(const Node& root) {
  constexpr std::string_view kBefore = "sensor width of ";
  const std::string text = root.document().text ? *root.document().text : "";
  if (const std::size_t at = text.find(kBefore); at != std::string::npos) {
    const std::string_view rest = std::string_view(text).substr(at + kBefore.size());
    const std::vector<std::string_view> sides = partsOf(rest.substr(0, rest.find("mm")), "x");
    const double width = sides.empty() ? 0 : parseNumber(sides.front()).value_or(0),
                 height = sides.size() == 2 ? parseNumber(sides.back()).value_or(0) : 0;
    if (width > 0 && height > 0) return {width, height};
  }
  root.fail("tells no sensor, as in '#Focal Length mm assuming a sensor width of 12.8x8.5mm'");
}

Json lensOf(const Node& root) {
  const auto number = [&](const char* name) {
    const Node node = root.require(name);
    node.mark();
    return node.number();
  };
  const auto [width, height] = sensorOf(root);
  Json camera{{"convention", "opencv"},
              {"position", {0, 0, 0}},
              {"rotation", {0, 0, 0, 1}},
              {"viewport", {{"pixelCenter", 0.5}}},
              {"projection",
               {{"type", "perspective"},
                {"focalLength", number("F")},
                {"sensorWidth", width},
                {"sensorHeight", height},
                {"shift", {2 * number("Px") / width - 1, 1 - 2 * number("Py") / height}}}}};
  setLens(camera, root, "",
          NamedNumbers{{"k1", number("K1")},
                       {"k2", number("K2")},
                       {"p1", number("T1")},
                       {"p2", number("T2")},
                       {"k3", number("K3")}});
  return camera;
}

Import open(const Node& root) {
  return Import::one([root] { return lensOf(root); });
}

}  // namespace pix4d

extern const Format kPix4d{"pix4d", "", "Pix4D_camera_calibration_file F Px Py K1 K2 K3 T1 T2", pix4d::open,
                           "Pix4D_camera_calibration_file"};

}  // namespace viewproj::cmd
