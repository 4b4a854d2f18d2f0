// Pictures of phones and drones. Sources: ARKit, whose pixels count centres; DJI's XMP tags.
#include <cmath>
#include <nlohmann/json.hpp>

#include "formats/format.hpp"
#include "formats/value.hpp"

namespace viewproj::cmd {
namespace devices {

/// The picture's side, of a focal length and the projection's entry for it: 2 f / m, whole but for float's rounding.
double sideOf(const Node& projection, double focal, double entry) {
  const double side = 2 * focal / entry;
  if (!(std::fabs(side - std::round(side)) < 1e-3 * side) || !(side >= 1))
    projection.fail("does not fit the intrinsics");
  return std::round(side);
}

/// A frame of the 3D Scanner App.
Json frameOf(const Node& root) {
  const Node k = root.require("intrinsics"), projection = root.require("projectionMatrix");
  const std::array<double, 4> intrinsics = intrinsicsOf(k, numbersOf(k, 9));
  const std::vector<double> p = numbersOf(projection, 16);
  std::vector<double> m = numbersOf(root.require("cameraPoseARFrame"), 16);
  for (double& entry : m) entry /= m[15] == 0 ? 1 : m[15];
  Json camera = pinholeCamera(
      intrinsics, std::array{sideOf(projection, intrinsics[0], p[0]), sideOf(projection, intrinsics[1], p[5])});
  setPose(camera, "worldFromCamera", rowsOf(m, 4));
  camera["cameraAxes"] = "RUB";
  return camera;
}

Import openFrame(const Node& root) {
  Import result;
  result.add("", "", [root] { return frameOf(root); });
  return result;
}

/// A number of a row; nothing where the cell is empty.
std::optional<double> cellOf(const Node& row, std::string_view name) {
  const auto cell = row.find(name);
  if (!cell || cell->json() == "") return std::nullopt;
  const auto number = numbersIn(cell->json());
  if (!number || number->size() != 1) cell->fail("is no plain number; exiftool writes them with -n");
  return number->front();
}

/// A row of exiftool's table.
Json pictureOf(const Node& row) {
  const auto cell = [&](std::string_view name) {
    const auto number = cellOf(row, name);
    if (!number) row.fail("needs " + std::string(name));
    return *number;
  };
  Json camera{
      {"position", {{"lat", cell("GPSLatitude")}, {"lon", cell("GPSLongitude")}, {"height", cell("AbsoluteAltitude")}}},
      {"heading", cell("GimbalYawDegree")},
      {"pitch", cell("GimbalPitchDegree")},
      {"roll", cellOf(row, "GimbalRollDegree").value_or(0)}};
  const auto w = cellOf(row, "ImageWidth"), h = cellOf(row, "ImageHeight");
  if (w && h) camera["viewport"] = {{"width", *w}, {"height", *h}};
  if (const auto dewarp = cellOf(row, "DewarpFlag"); dewarp && *dewarp == 0 && row.find("DewarpData"))
    row.find("DewarpData")->fail("is the lens of these pictures, which is not read; dewarp them, or leave it out");
  // From options otherwise: FocalLengthIn35mmFormat is a whole number, and 2 % off at 24.
  const auto f = cellOf(row, "CalibratedFocalLength"), x = cellOf(row, "CalibratedOpticalCenterX"),
             y = cellOf(row, "CalibratedOpticalCenterY");
  if (f && x && y) {
    camera["projection"] = {{"type", "intrinsics"}, {"fx", *f}, {"fy", *f}, {"cx", *x}, {"cy", *y}};
    if (w && h) camera["projection"]["pixels"] = {*w, *h};
  }
  return camera;
}

Import openPictures(const Node& root) {
  Import result;
  for (std::size_t i = 0; i < root.size(); ++i) {
    const std::string file = textAt(root[i], "FileName");
    result.add(file.empty() ? textAt(root[i], "SourceFile") : file, "", [row = root[i]] { return pictureOf(row); });
  }
  return result;
}

}  // namespace devices

extern const Format kScanner{"scanner-app", "a frame of the 3D Scanner App",
                             "cameraPoseARFrame intrinsics:9 projectionMatrix:16", devices::openFrame, "*"};
extern const Format kExif{"exiftool", "a drone table of exiftool -n", ":list *.GPSLatitude *.GimbalYawDegree",
                          devices::openPictures, "*"};

}  // namespace viewproj::cmd
