// Tables of drone pictures, as exiftool -csv -n or -json -n writes them. Source: DJI's XMP tags.
#include <nlohmann/json.hpp>

#include "formats/format.hpp"
#include "formats/value.hpp"

namespace viewproj::cmd {
namespace exif {

/// A number of a row; nothing where the cell is empty.
std::optional<double> cellOf(const Node& row, std::string_view name) {
  const auto cell = row.find(name);
  if (!cell || (cell->json().is_string() && cell->json().get_ref<const std::string&>().empty())) return std::nullopt;
  const auto number = numbersIn(cell->json());
  if (!number || number->size() != 1) cell->fail("is no plain number; exiftool writes them with -n");
  return number->front();
}

double requireCell(const Node& row, std::string_view name) {
  if (const auto number = cellOf(row, name)) return *number;
  row.fail("needs " + std::string(name));
}

Json documentOf(const Node& row) {
  const auto place = [&](std::string_view name) { return requireCell(row, name); };
  Json camera{{"position",
               {{"lat", place("GPSLatitude")}, {"lon", place("GPSLongitude")}, {"height", place("AbsoluteAltitude")}}},
              {"heading", place("GimbalYawDegree")},
              {"pitch", place("GimbalPitchDegree")},
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

Import open(const Node& root) {
  Import result;
  for (const Json& row : root.json()) {
    std::string name;
    for (const char* column : {"FileName", "SourceFile"})
      if (name.empty() && row.is_object() && row.contains(column) && row[column].is_string())
        name = row[column].get<std::string>();
    result.cameras.push_back({name, ""});
  }
  result.document = [root](std::size_t which) { return documentOf(root[which]); };
  return result;
}  // namespace exif

}  // namespace exif

extern const Format kExif{"exiftool", "a drone table of exiftool -n", ":list *.GPSLatitude *.GimbalYawDegree",
                          exif::open, "*"};

}  // namespace viewproj::cmd
