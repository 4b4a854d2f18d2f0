// The fields of a camera document, one row each, and the kinds of values. The reader's checks, --set, the options with
// their placeholders, help, the schema and the order of a written camera use these rows. To add a field, add a row
// here, and use it in read_pose.cpp or read_projection.cpp. To add a kind, add a row here, and read it in values.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "camera/names.hpp"

namespace viewproj::cmd {

enum class Kind : std::uint8_t {
  text,
  word,  ///< one of the row's words
  flag,
  number,
  positive,  ///< a number above 0
  far,       ///< a number or "inf"
  zero,      ///< a number that must be 0
  ratio,     ///< a number above 0, "16/9" or "16:9"
  angle,     ///< between 0 and 180 degrees; every angle is a number of degrees, "60deg" or "1.0472rad"
  pitch,     ///< from -180 to 180 degrees
  turn,      ///< degrees
  pair,      ///< two numbers
  range,     ///< two numbers that differ
  size,      ///< two numbers above 0
  direction,
  place,
  quaternion,
  euler,
  rigid,
  matrix,
  lens,
};

/// What a kind looks like on the command line, in help, in a file and in the schema.
struct KindRow {
  Kind kind;
  std::string_view placeholder;   ///< of an option
  std::string_view form;          ///< in a file; of a word, the field's words
  const char* schema;             ///< what depends on other fields, and ranges, the reader alone checks
  bool isList = false;            ///< an option's text may be 1,2,3 or lat=1,lon=2
  std::string_view members = {};  ///< of an object, in the order in which they are written
};
// clang-format off
inline constexpr KindRow kKinds[] = {  // in the order of Kind
    {Kind::text, "TEXT", "text", R"({"type": "string"})"},
    {Kind::word, "NAME", "", "{}"},
    {Kind::flag, "N", "true or false", R"({"type": "boolean"})"},
    {Kind::number, "N", "number", R"({"type": "number"})"},
    {Kind::positive, "N", "number above 0", R"({"type": "number", "exclusiveMinimum": 0})"},
    {Kind::far, "N", "number or \"inf\"", R"({"anyOf": [{"type": "number"}, {"const": "inf"}]})"},
    {Kind::zero, "N", "0", R"({"const": 0})"},
    {Kind::ratio, "W/H", "number or \"16/9\"", R"({"anyOf": [{"type": "number"}, {"type": "string", "pattern": "[/:]"}]})"},
    {Kind::angle, "DEGREES", "0 to 180 degrees", R"({"$ref": "#/$defs/angle"})"},
    {Kind::pitch, "DEGREES", "-180 to 180 degrees", R"({"$ref": "#/$defs/angle"})"},
    {Kind::turn, "DEGREES", "degrees", R"({"$ref": "#/$defs/angle"})"},
    {Kind::pair, "X,Y", "[a, b]", R"({"$ref": "#/$defs/xy"})", true},
    {Kind::range, "A,B", "[a, b]", R"({"$ref": "#/$defs/xy"})", true},
    {Kind::size, "W,H", "[a, b]", R"({"$ref": "#/$defs/xy"})", true},
    {Kind::direction, "X,Y,Z", "[x, y, z]", R"({"$ref": "#/$defs/xyz"})", true},
    {Kind::place, "X,Y,Z|lat=..,lon=..,height=..", "[x, y, z] or {lat, lon, height}",
     R"({"anyOf": [{"$ref": "#/$defs/xyz"}, {"type": "object", "required": ["lat", "lon"],
         "anyOf": [{"required": ["height"]}, {"required": ["altitude"]}]}]})", true, "lat lon height altitude"},
    {Kind::quaternion, "X,Y,Z,W", "[x, y, z, w]", R"({"$ref": "#/$defs/xyzw"})", true},
    {Kind::euler, "YXZ:A,B,C", "{order, degrees}", R"({"type": "object", "required": ["order", "degrees"]})", false,
     "order degrees"},
    {Kind::rigid, "M", "4 rows of 4, {rotation, translation}, or a list of poses",
     R"({"anyOf": [{"$ref": "#/$defs/rows"}, {"type": "object", "required": ["translation"]},
         {"type": "array", "minItems": 1, "items": {"anyOf": [{"type": "object"}, {"type": "array"}]}}]})", false,
     "rotation rotationVector euler translation"},
    {Kind::matrix, "M", "16 numbers", R"({"anyOf": [{"$ref": "#/$defs/rows"}, {"$ref": "#/$defs/sixteen"}]})", true},
    {Kind::lens, "JSON", "{model, k, p, xi, alpha, beta, omega}",
     R"({"type": "object", "required": ["model"], "additionalProperties": false, "properties": {
         "model": {"enum": ["brown", "fisheye", "unified", "double-sphere", "omni", "fov"]},
         "k": {"type": "array", "items": {"type": "number"}, "maxItems": 6}, "p": {"$ref": "#/$defs/pair"},
         "xi": {"type": "number", "exclusiveMinimum": -1}, "alpha": {"type": "number"},
         "beta": {"type": "number", "exclusiveMinimum": 0},
         "omega": {"type": "number", "exclusiveMinimum": 0, "exclusiveMaximum": 3.15},
         "limit": {"type": "object"}}})", false, "model k p xi alpha beta omega limit"},
};
// clang-format on
constexpr const KindRow& rowOf(Kind kind) { return kKinds[static_cast<std::size_t>(kind)]; }

/// The types of a projection, as bits. A field has the bits of the types it belongs to.
enum Types : std::uint8_t {
  kPerspective = 1,
  kFrustum = 2,
  kIntrinsics = 4,
  kOrthographic = 8,
  kPs2 = 16,
  kMatrix = 32,
  kScreen = 64
};
inline constexpr std::uint8_t kAllTypes = 127;
inline constexpr NameRow<std::uint8_t> kTypeNames[] = {{"perspective", kPerspective},
                                                       {"frustum", kFrustum},
                                                       {"intrinsics", kIntrinsics},
                                                       {"orthographic", kOrthographic},
                                                       {"ps2", kPs2},
                                                       {"matrix", kMatrix},
                                                       {"screen", kScreen}};

/// Fields of one group contradict each other unless they share a bit of `sets`.
enum class Group : std::uint8_t { none, pose, lens };

struct Field {
  std::string_view path;
  Kind kind;
  std::string_view help;         ///< one line: meaning and default
  std::string_view option = {};  ///< "--fov-y"
  Group group = Group::none;
  std::uint16_t sets = 0;
  std::uint8_t types = 0;       ///< for fields of the projection
  Words words = nullptr;        ///< for words
  std::string_view alias = {};  ///< another name in a file
  std::string_view hints = {};  ///< names in other programs, separated by blanks: not read, but suggested
  bool isLength = false;        ///< a number in units of the world
};

consteval Field wordField(std::string_view path, Words words, std::string_view help, std::uint8_t types = 0) {
  return {path, Kind::word, help, "", Group::none, 0, types, words};
}
consteval Field poseField(std::string_view path, Kind kind, std::uint16_t sets, std::string_view option,
                          std::string_view help, Words words = nullptr, std::string_view alias = "",
                          std::string_view hints = "") {
  return {path, kind, help, option, Group::pose, sets, 0, words, alias, hints};
}
/// Without sets, the field contradicts nothing.
consteval Field lensField(std::string_view path, Kind kind, std::uint8_t types, std::uint16_t sets,
                          std::string_view option, std::string_view help, bool isLength = false) {
  return {path, kind, help, option, sets ? Group::lens : Group::none, sets, types, nullptr, "", "", isLength};
}

inline constexpr Field kFields[] = {
    {"$schema", Kind::text, "Location of the schema, for editors."},
    {"name", Kind::text, "Name of the camera."},
    wordField("convention.preset", presetNames, "The preset that the other axes change. Default: opengl."),
    wordField("convention.world", wordsOf<kWorldNames>, "Handedness of the world."),
    wordField("convention.view", wordsOf<kViewNames>, "Axes of view space."),
    wordField("convention.ndcZ", wordsOf<kNdcZNames>, "Range of NDC z."),
    {"convention.reverseZ", Kind::flag, "Swaps near and far in depth: true or false."},
    wordField("convention.ndcY", wordsOf<kNdcYNames>, "Direction of NDC y in the picture."),
    wordField("convention.vectors", wordsOf<kVectorsNames>, "M v for column, v M for row."),
    wordField("convention.storage", wordsOf<kStorageNames>, "Order in memory."),
    wordField("world", wordsOf<kWorlds>, "enu: x, y, z are east, north, up."),
    poseField("position", Kind::place, 127, "--position", "Position: x,y,z or lat=..,lon=..,height=..", nullptr, "eye",
              "from origin location center"),
    poseField("target", Kind::place, 1, "--target", "Point to look at.", nullptr, "lookAt", "at to"),
    poseField("direction", Kind::direction, 2, "--direction", "Viewing direction (any length).", nullptr, "",
              "forward"),
    poseField("up", Kind::direction, 3, "--up", "Up in the picture. Default: the convention's."),
    poseField("rotation", Kind::quaternion, 4, "--rotation", "x,y,z,w, camera to world.", nullptr, "",
              "quaternion orientation"),
    poseField("euler", Kind::euler, 8, "--euler",
              "rpy:ROLL,PITCH,YAW blender|godot|unity:X,Y,Z YXZ:A,B,C unreal:PITCH,YAW,ROLL opk:OMEGA,PHI,KAPPA"),
    poseField("worldFromCamera", Kind::rigid, 16, "", "Pose: 4 rows, {rotation, translation}, or a list."),
    poseField("cameraFromWorld", Kind::rigid, 32, "", "The inverse: a view matrix for column vectors."),
    poseField("heading", Kind::turn, 64, "--heading", "Degrees clockwise from north."),
    poseField("pitch", Kind::pitch, 64, "--pitch", "Degrees above the horizon. Default: 0."),
    poseField("roll", Kind::turn, 64, "--roll", "Degrees, right side down. Default: 0."),
    poseField("cameraAxes", Kind::word, 60, "", "Of rotations.", wordsOf<kCameraAxesNames>),
    wordField("projection.type", wordsOf<kTypeNames>, "Which fields apply.", kAllTypes),
    lensField("projection.fovY", Kind::angle, kPerspective, 1, "--fov-y",
              "Angle of view: vertical, horizontal or diagonal."),
    lensField("projection.fovX", Kind::angle, kPerspective, 2, "--fov-x",
              "Angle of view: vertical, horizontal or diagonal."),
    lensField("projection.fovDiagonal", Kind::angle, kPerspective, 4, "--fov-diagonal",
              "Angle of view: vertical, horizontal or diagonal."),
    lensField("projection.nearWidth", Kind::positive, kPerspective, 8, "", "Size of the window on the near plane.",
              true),
    lensField("projection.nearHeight", Kind::positive, kPerspective, 8, "", "Size of the window on the near plane.",
              true),
    lensField("projection.focalLength", Kind::positive, kPerspective, 16 | 256, "--focal-length",
              "In the sensor's unit, such as millimetres."),
    lensField("projection.sensorWidth", Kind::positive, kPerspective, 16, "--sensor-width",
              "Sensor's size; diagonal of 35 mm equivalents 43.27."),
    lensField("projection.sensorHeight", Kind::positive, kPerspective, 16, "--sensor-height",
              "Sensor's size; diagonal of 35 mm equivalents 43.27."),
    lensField("projection.sensorDiagonal", Kind::positive, kPerspective, 256, "--sensor-diagonal",
              "Sensor's size; diagonal of 35 mm equivalents 43.27."),
    lensField("projection.left", Kind::number, kFrustum | kOrthographic, 32, "--left",
              "Window edge; in frustum, on the near plane.", true),
    lensField("projection.right", Kind::number, kFrustum | kOrthographic, 32, "--right",
              "Window edge; in frustum, on the near plane.", true),
    lensField("projection.bottom", Kind::number, kFrustum | kOrthographic, 32, "--bottom",
              "Window edge; in frustum, on the near plane.", true),
    lensField("projection.top", Kind::number, kFrustum | kOrthographic, 32, "--top",
              "Window edge; in frustum, on the near plane.", true),
    lensField("projection.width", Kind::positive, kOrthographic, 64, "--ortho-width", "Size of the window.", true),
    lensField("projection.height", Kind::positive, kOrthographic, 64, "--ortho-height", "Size of the window.", true),
    lensField("projection.aspect", Kind::ratio, kPerspective | kOrthographic, 1 | 2 | 4 | 16 | 64 | 256, "--aspect",
              "Width over height. Default: the viewport's."),
    lensField("projection.fx", Kind::positive, kIntrinsics, 128, "--fx", "Focal length in pixels. Default of fy: fx."),
    lensField("projection.fy", Kind::positive, kIntrinsics, 128, "--fy", "Focal length in pixels. Default of fy: fx."),
    lensField("projection.scrz", Kind::positive, kPs2, 128, "", "Distance of the screen."),
    lensField("projection.ax", Kind::positive, kPs2, 128, "", "Shape of a pixel, across and down."),
    lensField("projection.ay", Kind::positive, kPs2, 128, "", "Shape of a pixel, across and down."),
    lensField("projection.cx", Kind::number, kIntrinsics | kPs2, 128, "--cx",
              "Screen position of the axis. Default: the middle."),
    lensField("projection.cy", Kind::number, kIntrinsics | kPs2, 128, "--cy",
              "Screen position of the axis. Default: the middle."),
    lensField("projection.skew", Kind::zero, kIntrinsics, 128, "", "Only 0 is read."),
    lensField("projection.pixels", Kind::size, kIntrinsics, 128, "",
              "Size of the picture measured. Default: viewport."),
    lensField("projection.zMin", Kind::number, kPs2, 128, "", "Depth at far and at near."),
    lensField("projection.zMax", Kind::number, kPs2, 128, "", "Depth at far and at near."),
    lensField("projection.matrix", Kind::matrix, kMatrix, 128, "", "4 rows as on paper, or 16 numbers as in memory."),
    lensField("projection.bottomLeft", Kind::place, kScreen, 128, "", "Corners of the screen in the world."),
    lensField("projection.bottomRight", Kind::place, kScreen, 128, "", "Corners of the screen in the world."),
    lensField("projection.topLeft", Kind::place, kScreen, 128, "", "Corners of the screen in the world."),
    lensField("projection.near", Kind::number, kAllTypes, 0, "--near", "Near plane. Absent: none, and no depth.", true),
    lensField("projection.far", Kind::far, kAllTypes, 0, "--far", "Far plane. Absent: infinite.", true),
    lensField("projection.shift", Kind::pair, kAllTypes, 0, "--shift", "Moves the picture right, up, by half sizes."),
    {"distortion", Kind::lens, "{model, its numbers}: brown, fisheye, unified, ...", "--distortion"},
    {"viewport.width", Kind::positive, "Size of the picture, in pixels."},
    {"viewport.height", Kind::positive, "Size of the picture, in pixels."},
    {"viewport.x", Kind::number, "Screen position of its corner. Default: 0."},
    {"viewport.y", Kind::number, "Screen position of its corner. Default: 0."},
    {"viewport.depthRange", Kind::range, "Depth at near, far; reverseZ swaps. Default: 0, 1."},
    wordField("viewport.origin", wordsOf<kOriginNames>, "Of y: Unity's is bottom-left. Default: top-left."),
    {"viewport.pixelCenter", Kind::number, "0.5, as COLMAP, NeRF; opencv 0: ROS, KITTI, Kalibr."},
    {"viewport.crop.x", Kind::number, "A tile of the viewport, in its pixels."},
    {"viewport.crop.y", Kind::number, "A tile of the viewport, in its pixels."},
    {"viewport.crop.width", Kind::positive, "A tile of the viewport, in its pixels."},
    {"viewport.crop.height", Kind::positive, "A tile of the viewport, in its pixels."},
};

/// The row with a path, or null.
constexpr const Field* findField(std::string_view path) {
  for (const Field& field : kFields)
    if (field.path == path) return &field;
  return nullptr;
}

/// A field, named by its path; a path that no row has does not compile.
class FieldId {
 public:
  consteval FieldId(const char* path) : field_(findField(path)) {  // NOLINT(google-explicit-constructor)
    if (!field_) throw "no such field";
  }
  const Field* operator->() const { return field_; }
  const Field& operator*() const { return *field_; }

 private:
  const Field* field_;
};

/// "fovY" for projection.fovY, "position" for position, "convention.view" for convention.view.
std::string_view shortName(const Field& field);
/// The member at the top of the document that holds a field.
std::string_view topName(const Field& field);
/// The members of an object in the order of the table. "" is the document.
std::vector<std::string_view> namesUnder(std::string_view path);
/// Words that are separated by blanks.
std::vector<std::string_view> wordsIn(std::string_view text);

/// Whether a document cannot have both fields.
bool contradict(const Field& a, const Field& b);
std::string contradictionMessage(std::string_view first, std::string_view second, Group group);

}  // namespace viewproj::cmd
