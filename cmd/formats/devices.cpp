// Pictures of phones and drones, and views of headsets. Sources: ARKit, whose pixels count centres; DJI's XMP tags;
// XrView of OpenXR.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "camera/field_columns.hpp"
#include "camera/sea_level.hpp"
#include "formats/format.hpp"
#include "formats/value.hpp"
#include "text/error.hpp"
#include "text/names.hpp"
#include "text/number.hpp"

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
  return Import::one([root] { return frameOf(root); });
}

/// A column of exiftool's, which -G puts its group in front of: XMP-drone-dji:GimbalYawDegree. Of several groups
/// Composite counts, whose tags are made of all others; else they must agree.
std::optional<Node> columnOf(const Node& row, std::string_view name) {
  std::optional<Node> found = row.find("Composite:" + std::string(name));
  if (found && found->json() != "") return found;
  found.reset();
  for (const auto& [column, cell] : row.json().items()) {
    if (cell.is_null() || cell == "" || std::string_view(column).substr(column.rfind(':') + 1) != name) continue;
    if (found && found->json() != cell)
      row.find(column)->fail("differs from " + found->path() + "; leave one of them out");
    found = row.find(column);
  }
  return found;
}

/// A number as exiftool prints it without -n: 8.8 mm, 548.3 m Below Sea Level, 46 deg 31' 12.46" N, 46.52 N.
std::optional<double> printedNumber(std::string_view text) {
  const std::vector<std::string_view> words = partsOf(text, " '\"");
  const auto number = words.empty() ? std::nullopt : parseNumber(words.front());
  if (!number || words.size() == 1) return number;
  const bool isNegative = isAmong(words.back(), "S W") || (words.size() > 2 && words[2] == "Below");
  if (words[1] != "deg")
    return isAmong(words[1], "mm m N E S W") ? std::optional(isNegative ? -*number : *number) : std::nullopt;
  const auto minutes = words.size() > 2 ? parseNumber(words[2]) : std::nullopt,
             seconds = words.size() > 3 ? parseNumber(words[3]) : std::nullopt;
  const double degrees = *number + minutes.value_or(0) / 60 + seconds.value_or(0) / 3600;
  return isNegative ? -degrees : degrees;
}

/// A number of a row; nothing where the cell is empty.
std::optional<double> cellOf(const Node& row, std::string_view name) {
  const auto cell = columnOf(row, name);
  if (!cell) return std::nullopt;
  const auto numbers = numbersIn(cell->json());
  const auto number = numbers && numbers->size() == 1 ? std::optional(numbers->front())
                      : cell->json().is_string()      ? printedNumber(cell->text())
                                                      : std::nullopt;
  if (!number) cell->fail("is no plain number; exiftool writes them with -n");
  cell->mark();
  return number;
}

std::string fileOf(const Node& row) {
  const auto file = columnOf(row, "FileName");
  const std::string name = file ? file->text() : textAt(row, "SourceFile");
  return name.starts_with("./") ? name.substr(2) : name;  // as exiftool writes those of the folder .
}

/// A number with the sign of what is named beside it, which the group EXIF has without one: south, west, and below,
/// which is 1 or 3 too.
double signedOf(const Node& row, double number, const std::string& name) {
  const auto ref = columnOf(row, name + "Ref");
  const std::string side = !ref ? "" : ref->json().is_number() ? formatNumber(ref->number()) : ref->text();
  return !side.empty() && std::string_view("SWB13").find(side[0]) != std::string_view::npos ? -std::fabs(number)
                                                                                            : number;
}

/// What would move pixels, and is not known to be in the other numbers.
void requirePlain(const Node& row) {
  const auto turn = columnOf(row, "Orientation");
  if (turn && turn->json() != 1 && turn->json() != "1" && turn->json() != "Horizontal (normal)")
    turn->fail("turns the picture when it is shown; expected 1: turn the file, or leave this out");
  if (const auto zoom = cellOf(row, "DigitalZoomRatio"); zoom && *zoom > 1)
    columnOf(row, "DigitalZoomRatio")->fail("may be in the focal length or not; expected 1, or leave it out");
}

/// What a turn of the camera is called: by DJI, by Parrot, and in DJI's notes of the maker.
constexpr const char* kTurns[][3] = {{"GimbalYawDegree", "GimbalPitchDegree", "GimbalRollDegree"},
                                     {"CameraYawDegree", "CameraPitchDegree", "CameraRollDegree"},
                                     {"CameraYaw", "CameraPitch", "CameraRoll"}};

bool isPicture(const Node& row) {
  return row.json().is_object() && columnOf(row, "GPSLatitude") &&
         std::any_of(std::begin(kTurns), std::end(kTurns), [&](const auto& turn) { return columnOf(row, turn[0]); });
}

bool holdsPictures(const Node& root) {
  for (std::size_t i = 0; root.json().is_array() && i < root.size(); ++i)
    if (isPicture(root[i])) return true;
  return false;
}

constexpr const char *kAbsolute = "AbsoluteAltitude", *kRelative = "RelativeAltitude";

/// A row of exiftool's table. isRelative: heights are above the take-off.
Json pictureOf(const Node& row, bool isRelative) {
  const auto cell = [&](std::string_view name, const std::string& otherwise = "") {
    const auto number = cellOf(row, name);
    if (!number)
      throw InputError(row.document().name + ": " + fileOf(row) + ": needs " + std::string(name) + otherwise);
    return *number;
  };
  requirePlain(row);
  const auto altitude = cellOf(row, isRelative ? kRelative : kAbsolute);
  const auto* turn =
      std::find_if(std::begin(kTurns), std::end(kTurns), [&](const auto& t) { return columnOf(row, t[0]); });
  if (turn == std::end(kTurns)) turn = std::begin(kTurns);
  Json camera{{"position",
               {{"lat", signedOf(row, cell("GPSLatitude"), "GPSLatitude")},
                {"lon", signedOf(row, cell("GPSLongitude"), "GPSLongitude")},
                {hasGeoid() && !isRelative ? "altitude" : "height",
                 altitude     ? *altitude
                 : isRelative ? cell(kRelative)
                              : signedOf(row, cell("GPSAltitude", " or AbsoluteAltitude"), "GPSAltitude")}}},
              {"heading", cell((*turn)[0])},
              {"pitch", cell((*turn)[1])},
              {"roll", cellOf(row, (*turn)[2]).value_or(0)}};
  const bool isInExif = !columnOf(row, "ImageWidth");
  const auto w = cellOf(row, isInExif ? "ExifImageWidth" : "ImageWidth"),
             h = cellOf(row, isInExif ? "ExifImageHeight" : "ImageHeight");
  if (w && h) camera["viewport"] = {{"width", *w}, {"height", *h}};
  if (const auto dewarp = cellOf(row, "DewarpFlag"); dewarp && *dewarp == 0 && columnOf(row, "DewarpData"))
    columnOf(row, "DewarpData")->fail("is the lens of these pictures, which is not read; dewarp them, or leave it out");
  const auto f = cellOf(row, "CalibratedFocalLength"), x = cellOf(row, "CalibratedOpticalCenterX"),
             y = cellOf(row, "CalibratedOpticalCenterY");
  if (f && x && y) {
    camera["projection"] = {{"type", "intrinsics"}, {"fx", *f}, {"fy", *f}, {"cx", *x}, {"cy", *y}};
    if (w && h) camera["projection"]["pixels"] = {*w, *h};
  } else if (const auto equivalent = cellOf(row, "FocalLengthIn35mmFormat"); equivalent && *equivalent > 0) {
    const auto focal = cellOf(row, "FocalLength");
    camera["projection"] = {{"type", "perspective"}};
    if (focal && *focal > 0)  // so that --sensor-width goes with it
      camera["projection"].update({{"focalLength", *focal}, {"sensorDiagonal", kFilmDiagonal * *focal / *equivalent}});
    else
      camera["projection"]["fovDiagonal"] = fovOfEquivalent(*equivalent);
  }
  return camera;
}

Import openPictures(const Node& root) {
  Import result;
  const char* const altitude = columnOf(root[0], kAbsolute) ? kAbsolute : "GPSAltitude";
  const auto absolute = cellOf(root[0], kAbsolute), relative = cellOf(root[0], kRelative);
  const bool isRelative = relative && !columnOf(root[0], altitude);
  if (isRelative)
    result.notes.emplace_back("heights are RelativeAltitude, above the take-off: --height 0 is the ground there");
  else if (columnOf(root[0], altitude))
    result.notes.push_back(seaLevelNote(altitude));
  if (absolute && relative) {
    const std::string ground = formatDigits(*absolute - *relative, 9);
    result.notes.push_back(fileOf(root[0]) + " took off at " + ground + ", AbsoluteAltitude less RelativeAltitude: " +
                           (hasGeoid() ? "--altitude " : "--height ") + ground + " is the ground there");
  }
  if (!columnOf(root[0], "CalibratedFocalLength") && columnOf(root[0], "FocalLengthIn35mmFormat"))
    result.notesUnlessSet.emplace_back(
        "projection",
        std::string("the lens is of FocalLengthIn35mmFormat, a whole number, to 2 %") +
            (columnOf(root[0], "DewarpData") ? "; --fx and --fy are the first numbers behind the date of DewarpData"
                                             : ""));
  for (std::size_t i = 0; i < root.size(); ++i)
    result.add(fileOf(root[i]), "", [row = root[i], isRelative] { return pictureOf(row, isRelative); });
  return result;
}

/// An XrView. The window of an eye need not be symmetric.
Json viewOf(const Node& view) {
  const Node fov = view.require("fov");
  const auto tangent = [&](const char* angle) { return std::tan(numberOf(fov.require(angle))); };
  const double left = tangent("angleLeft"), right = tangent("angleRight"), down = tangent("angleDown"),
               up = tangent("angleUp");
  const double width = right - left, height = up - down;
  if (!(width > 0 && height > 0)) fov.fail("expected angleLeft below angleRight and angleDown below angleUp");
  Json camera{{"convention", "opengl"},
              {"projection",
               {{"type", "perspective"},
                {"fovY", formatNumber(2 * std::atan(height / 2)) + "rad"},
                {"aspect", width / height},
                {"shift", {-(left + right) / width, -(down + up) / height}}}}};
  const auto pose = view.find("pose");
  camera["position"] = pose ? Json(numbersOf(pose->require("position"), 3)) : Json{0, 0, 0};
  camera["rotation"] = pose ? Json(numbersOf(pose->require("orientation"), 4)) : Json{0, 0, 0, 1};
  return camera;
}

Import openViews(const Node& root) {
  const Node views = root.json().is_object() ? root.find("views").value_or(root) : root;
  Import result{.mayLackPose = true, .ownNames = {{"projection.aspect", "fov"}}};
  const auto add = [&](const std::string& name, const Node& view) {
    result.add(
        name, "", [view] { return viewOf(view); }, view);
  };
  if (views.json().is_array())
    for (std::size_t i = 0; i < views.size(); ++i) add("", views[i]);
  else if (views.find("fov"))
    add("", views);
  else
    for (const auto& [name, view] : views.json().items()) add(name, views.require(name));
  return result;
}

/// A camera as an engine's editor shows or prints it. turn: its turns in degrees, or a quaternion. fov: the field that
/// its angle of view is.
Import openShown(const std::string& engine, const std::vector<double>& place, const std::vector<double>& turn,
                 const Node& root, const char* fov) {
  Json camera{{"convention", engine}, {"position", place}};
  if (turn.size() == 4)
    camera["rotation"] = turn;
  else
    camera["euler"] = {{"order", engine}, {"degrees", turn}};
  for (const char* name : {"fieldOfView", "FieldOfView", "FOV", "fov"})
    if (const auto angle = root.find(name)) camera["projection"] = {{"type", "perspective"}, {fov, numberOf(*angle)}};
  for (const auto& [name, field] :
       {std::pair{"nearClipPlane", "near"}, {"farClipPlane", "far"}, {"AspectRatio", "aspect"}})
    if (const auto distance = root.find(name)) camera["projection"][field] = numberOf(*distance);
  return Import::one([camera] { return camera; });
}

Import openUnity(const Node& root) {
  Node at = root;  // or what the editor copies as a world transform
  for (const char* name : {"UnityEditor", "TransformWorldPlacementJSON"}) at = at.find(name).value_or(at);
  const auto turns = at.find("eulerAngles");
  const auto turn = turns ? numbersOf(*turns, 3) : numbersOf(at.require("rotation"), 4);
  return openShown("unity", numbersOf(at.require("position"), 3), turn, at, "fovY");
}

/// Location: X=1 Y=2 Z=3, Rotation: P=-20 Y=30 R=0, as FVector and FRotator are printed; or the names whole, as the
/// editor copies an actor.
Import openUnreal(const Node& root) {
  const auto numbersAt = [&](const std::string& object, std::string_view names) {
    const Node node = *root.findAny({object, "Relative" + object});
    std::vector<double> numbers;
    for (const std::string_view name : wordsIn(names))
      numbers.push_back(numberOf(node.require(node.find(name) ? name : name.substr(0, 1))));
    return numbers;
  };
  return openShown("unreal", numbersAt("Location", "X Y Z"), numbersAt("Rotation", "Pitch Yaw Roll"), root, "fovX");
}

}  // namespace devices

extern const Format kScanner{"scanner-app", "a frame of the 3D Scanner App",
                             "cameraPoseARFrame intrinsics:9 projectionMatrix:16", devices::openFrame, "*"};
extern const Format kOpenXr{"openxr", "views of OpenXR",
                            "fov.angleLeft|views.*.fov.angleLeft|*.fov.angleLeft|/0.fov.angleLeft !camera_path",
                            devices::openViews, "type next viewState*"};
extern const Format kUnity{
    "unity", "a transform of Unity",
    "position:3|TransformWorldPlacementJSON.position:3|UnityEditor.TransformWorldPlacementJSON.position:3 "
    "eulerAngles:3|TransformWorldPlacementJSON.rotation:4|UnityEditor.TransformWorldPlacementJSON.rotation:4",
    devices::openUnity, "rotation local* lossyScale scale"};
extern const Format kUnreal{"unreal", "a transform of Unreal",
                            "Location.X|RelativeLocation.X Rotation.P|Rotation.Pitch|RelativeRotation.Pitch",
                            devices::openUnreal, "Scale RelativeScale3D"};
extern const Format kExif{"exiftool", "a drone table of exiftool -n", "", devices::openPictures,
                          "*",        devices::holdsPictures};

}  // namespace viewproj::cmd
